#include "transfer/probe_points.hpp"

#include "transfer/mls_kernels.hpp"

namespace pliant {

void prepare(const MlsShape& shape, const ProbedFields& fields, ProbedPoints& batch) {
  StencilBatch& stencils = batch.stencils;
  shape.evaluate(std::span(batch.points).first(static_cast<std::size_t>(batch.count)), stencils, batch.slopes);
  for (int l = 0; l < mls_batch; ++l) {
    batch.has_center[l] = shape.is_held(stencils, z_center, l);
    batch.has_face[l] = shape.is_held(stencils, z_face, l);
    if (!batch.has_center[l]) stencils.first[z_center][l] = -1;
    if (!batch.has_face[l]) stencils.first[z_face][l] = -1;
  }
  mls::prefetch(fields.p, stencils);
  mls::prefetch(fields.u, stencils);
  mls::prefetch(fields.v, stencils);
  mls::prefetch(fields.w, stencils);
}

}  // namespace pliant
