#include "transfer/interpolate.hpp"

#include "transfer/mls_kernels.hpp"

namespace pliant {

void interpolate(const Markers& markers, const StencilBlock& block, ConstView<FaceX> u, ConstView<FaceY> v,
                 ConstView<FaceZ> w, MarkerVectors& velocities) {
  for (int b = 0; b < block.n_batches; ++b) {
    const auto& stencils = block.stencils[static_cast<std::size_t>(b)];
    const int batch = block.first_batch + b, count = markers.count(batch);
    const std::ptrdiff_t at = batch * mls_batch;
    mls::interpolate(u, stencils, count, velocities[0].data() + at);
    mls::interpolate(v, stencils, count, velocities[1].data() + at);
    mls::interpolate(w, stencils, count, velocities[2].data() + at);
  }
}

void prefetch(const StencilBlock& block, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w) {
  for (int b = 0; b < block.n_batches; ++b) {
    const auto& stencils = block.stencils[static_cast<std::size_t>(b)];
    mls::prefetch(u, stencils);
    mls::prefetch(v, stencils);
    mls::prefetch(w, stencils);
  }
}

void interpolate(const Markers& markers, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w,
                 MarkerVectors& velocities) {
  markers.for_each_block([&](const StencilBlock& block) { interpolate(markers, block, u, v, w, velocities); },
                         [&](const StencilBlock& block) { prefetch(block, u, v, w); });
}

void probe(const ProbedFields& fields, const StencilBatch& stencils, const SlopeBatch& slopes, int count,
           ProbeBatch& result) {
  mls::interpolate(fields.p, stencils, count, result.pressure);
  mls::gradient(fields.u, stencils, slopes, count, result.gradient[0]);
  mls::gradient(fields.v, stencils, slopes, count, result.gradient[1]);
  mls::gradient(fields.w, stencils, slopes, count, result.gradient[2]);
}

void probe_all(const ProbedFields& fields, const StencilBatch& stencils, const SlopeBatch& slopes, int count,
               ProbeBatch& result) {
  probe(fields, stencils, slopes, count, result);
  mls::interpolate(fields.u, stencils, count, result.velocity[0]);
  mls::interpolate(fields.v, stencils, count, result.velocity[1]);
  mls::interpolate(fields.w, stencils, count, result.velocity[2]);
}

}  // namespace pliant
