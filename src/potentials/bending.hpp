#pragma once
#include <span>
#include <vector>

#include "potentials/shape_state.hpp"

namespace pliant {

/// W = sum over hinges of k (1 - cos(theta - theta0)), theta the angle between the normals of an edge's two faces,
/// positive where the surface is convex (paper's bending potential with a reference angle). Borders have no hinge.
struct Bending {
  static constexpr const char* name = "bending";
  std::vector<double> stiffness;       ///< k per edge, energy
  std::vector<double> cosine0, sine0;  ///< of theta0 per edge

  /// The same stiffness on every hinge; theta0 from the reference shape, which is then free of bending stress.
  static Bending about_shape(const TriangleMesh& mesh, std::span<const Vec3> reference, double stiffness);
  /// theta0 = 0: flat is free of stress.
  static Bending about_flat(const TriangleMesh& mesh, double stiffness);

  double energy(const ShapeState& shape) const;
  void add_stress(const ShapeState& shape, InnerStress& stress) const;
  void add_forces(const ShapeState& shape, std::span<Vec3> forces) const;
};

}  // namespace pliant
