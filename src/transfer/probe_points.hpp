#pragma once
#include <array>
#include <span>
#include <utility>

#include "transfer/interpolate.hpp"

namespace pliant {

/// Some points at which the flow is asked for, with their stencils and what this rank can tell about them.
struct ProbedPoints {
  std::array<Vec3, mls_batch> points;
  std::array<std::size_t, mls_batch> indices;  ///< where among all points each of them stands
  int count = 0;
  StencilBatch stencils;
  SlopeBatch slopes;
  bool has_center[mls_batch], has_face[mls_batch];  ///< pressure, u and v are this rank's to tell; w is
};

/// Evaluates the stencils of a batch of points and begins to load the rows that they will read. Stencils that another
/// rank answers for read any planes of this rank.
void prepare(const MlsShape& shape, const ProbedFields& fields, ProbedPoints& batch);

/// visit(batch) for all points that are near this rank's slab, in their order; points must be in the box.
template <class Visit>
void for_each_probe_batch(const MlsShape& shape, const ProbedFields& fields, std::span<const Vec3> points,
                          Visit visit) {
  ProbedPoints batches[2];
  int filling = 0;  // the other one is prepared, and visited when this one is
  const auto turn = [&] {
    if (batches[filling].count > 0) prepare(shape, fields, batches[filling]);
    filling = 1 - filling;
    if (batches[filling].count > 0) visit(std::as_const(batches[filling]));
    batches[filling].count = 0;
  };
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (!shape.is_near(points[n].z)) continue;
    auto& batch = batches[filling];
    const auto lane = static_cast<std::size_t>(batch.count++);
    batch.points[lane] = points[n];
    batch.indices[lane] = n;
    if (batch.count == mls_batch) turn();
  }
  turn();
  turn();
}

}  // namespace pliant
