#pragma once
#include <span>
#include <vector>

#include "potentials/shape_state.hpp"

namespace pliant {

/// W = sum over faces of k ((A - A0) / A0)^2 A0 / 2.
struct FaceAreaPenalty {
  static constexpr const char* name = "area";
  double stiffness = 0;                ///< k, force / length
  std::vector<double> reference_area;  ///< A0 per face

  double energy(const ShapeState& shape) const;
  void add_stress(const ShapeState& shape, InnerStress& stress) const;
  void add_forces(const ShapeState& shape, std::span<Vec3> forces) const;
};

/// W = k ((A - A0) / A0)^2 A0 / 2 with A the area of the whole surface.
struct TotalAreaPenalty {
  static constexpr const char* name = "total_area";
  double stiffness = 0;       ///< k, force / length
  double reference_area = 0;  ///< A0

  double energy(const ShapeState& shape) const;
  void add_stress(const ShapeState& shape, InnerStress& stress) const;
  void add_forces(const ShapeState& shape, std::span<Vec3> forces) const;
};

}  // namespace pliant
