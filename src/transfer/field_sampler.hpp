#pragma once
#include "field/field.hpp"
#include "transfer/flow_sample.hpp"

namespace pliant {

/// The fields that a sampler reads, ghosts filled; they must outlive it.
struct SampledFields {
  const Field<FaceX>* u = nullptr;
  const Field<FaceY>* v = nullptr;
  const Field<FaceZ>* w = nullptr;
  const Field<Center>* p = nullptr;  ///< pressure over density
};

/// The flow between the nodes, from the solver's fields: in each direction the parabola through the three nodes of the
/// component's own staggered grid that are nearest to the point, on uniform and stretched grids alike.
///
///   q(x) = sum_abc a_a(x) b_b(y) c_c(z) q_abc,   dq/dx with a' in place of a, and so on.
///
/// Linear fields come out exact; in general the value is third and the gradient second order in the spacing, except in
/// the half cell next to a bounded side, where the linear ghosts leave second and first order. The pressure that comes
/// out is physical: density times the solver's.
///
/// In z each rank evaluates the points whose middle plane it holds, and a sum over the ranks, exact because all other
/// terms are zero, gives every rank the same samples, whatever the number of ranks. Points are brought back into the
/// box along periodic directions.
class FieldSampler : public FlowSampler {
 public:
  FieldSampler(const Grid& grid, SampledFields fields, double density);

  /// Throws RunError, on all ranks, if a point is not a number or lies outside the box beyond a bounded side.
  void sample(std::span<const Vec3> points, std::span<FlowSample> samples) const override;

 private:
  Grid grid_;
  SampledFields fields_;
  double density_;
};

}  // namespace pliant
