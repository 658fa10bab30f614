#pragma once
#include <span>
#include <vector>

#include "potentials/shape_state.hpp"

namespace pliant {

/// W = sum over edges of k (l - l0)^2 / 2 (paper's in-plane potential; prestress by l0 below the reference length).
struct EdgeSprings {
  static constexpr const char* name = "edge";
  std::vector<double> stiffness;    ///< k per edge, force / length
  std::vector<double> rest_length;  ///< l0 per edge; 0 is allowed

  /// The same stiffness on every edge; l0 = fraction * length in the reference.
  static EdgeSprings uniform(const TriangleMesh& mesh, std::span<const Vec3> reference, double stiffness,
                             double fraction);

  double energy(const ShapeState& shape) const;
  void add_stress(const ShapeState& shape, InnerStress& stress) const;
  void add_forces(const ShapeState& shape, std::span<Vec3> forces) const;
};

}  // namespace pliant
