#pragma once
#include <vector>

#include "field/field.hpp"
#include "transfer/flow_sample.hpp"
#include "transfer/mls_shape.hpp"
#include "transfer/point_router.hpp"

namespace pliant {

/// The fields that a sampler reads, ghosts filled; they must outlive it.
struct SampledFields {
  const Field<FaceX>* u = nullptr;
  const Field<FaceY>* v = nullptr;
  const Field<FaceZ>* w = nullptr;
  const Field<Center>* p = nullptr;  ///< pressure over density
};

/// The flow between the nodes, from the solver's fields: moving least squares over the 27 nodes of each component's own
/// staggered grid that are nearest to the point (MlsShape), on uniform and stretched grids alike.
///
/// Linear fields come out exact; in general the value is second and the gradient first order in the spacing. The
/// pressure that comes out is physical: density times the solver's.
///
/// Every rank asks for points of its own. They are evaluated by the ranks that hold the middle planes of their
/// stencils, and what these say is summed, exactly because all other terms are zero: the samples are the same for any
/// number of ranks. Points are brought back into the box along periodic directions.
class MlsSampler : public FlowSampler {
 public:
  MlsSampler(const Grid& grid, SampledFields fields, double density);

  /// Throws CollectiveError if a point is not a number or lies outside the box beyond a bounded side.
  void sample(std::span<const Vec3> points, std::span<FlowSample> samples) const override;

 private:
  void evaluate(std::span<const Vec3> points) const;  // into held_numbers_

  MlsShape shape_;
  SampledFields fields_;
  double density_;
  // Kept from call to call for their memory alone.
  mutable PointRouter router_;
  mutable std::vector<double> held_numbers_, numbers_;
};

}  // namespace pliant
