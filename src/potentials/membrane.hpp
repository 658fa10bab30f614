#pragma once
#include <span>
#include <variant>
#include <vector>

#include "potentials/shape_state.hpp"

namespace pliant {

/// Laws of a thin sheet, w per area of the reference with the principal stretches l1 and l2:
/// I1 = l1^2 + l2^2 - 2, I2 = l1^2 l2^2 - 1. Both are zero without strain.
struct NeoHookean {
  double shear = 0;  ///< G: w = G (I1 - 1 + 1 / (I2 + 1)) / 2; the area modulus is 3 G
};
struct Skalak {
  double shear = 0, ratio = 0;  ///< G, C: w = G (I1^2 + 2 I1 - 2 I2 + C I2^2) / 4; the area modulus is (1 + 2 C) G
};
using SheetLaw = std::variant<NeoHookean, Skalak>;

/// W = sum over faces of A0 w, each face strained evenly from its reference (constant-strain triangles).
struct Membrane {
  static constexpr const char* name = "membrane";
  SheetLaw law;
  /// Per face and vertex k, half the cotangent of the reference's angle opposite to its edge k, over A0:
  /// l1^2 + l2^2 = sum of weight times squared length.
  std::vector<std::array<double, 3>> weights;
  std::vector<double> reference_area;  ///< A0 per face

  static Membrane about_shape(const TriangleMesh& mesh, std::span<const Vec3> reference, const SheetLaw& law);

  double energy(const ShapeState& shape) const;
  void add_stress(const ShapeState& shape, InnerStress& stress) const;
  void add_forces(const ShapeState& shape, std::span<Vec3> forces) const;
};

}  // namespace pliant
