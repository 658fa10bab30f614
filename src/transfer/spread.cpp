#include "transfer/spread.hpp"

#include "transfer/interpolate.hpp"
#include "transfer/mls_kernels.hpp"

namespace pliant {
namespace {

void amounts_of(const Markers& markers, int batch, int component, const MarkerVectors& forces, double* amounts) {
  const std::size_t at = static_cast<std::size_t>(batch) * mls_batch;
  const double* force = forces[component].data() + at;
  const double* factor = markers.spreading(component).data() + at;
  for (int l = 0; l < mls_batch; ++l) amounts[l] = factor[l] * force[l];
}

}  // namespace

void spread(const Markers& markers, const StencilBlock& block, const MarkerVectors& forces, ForceFields& fields) {
  for (int b = 0; b < block.n_batches; ++b) {
    const auto& stencils = block.stencils[static_cast<std::size_t>(b)];
    const int batch = block.first_batch + b;
    double amounts[3][mls_batch];
    for (int c = 0; c < 3; ++c) amounts_of(markers, batch, c, forces, amounts[c]);
    mls::RowFactors factors[3];
    mls::row_factors<FaceX>(stencils, factors[0]);
    mls::row_factors<FaceY>(stencils, factors[1]);
    mls::row_factors<FaceZ>(stencils, factors[2]);
    // Component by component within a marker: a row that the last marker has changed is not read again at once.
    for (int l = 0; l < markers.count(batch); ++l) {
      mls::spread_one(fields.x(), stencils, factors[0], l, amounts[0][l]);
      mls::spread_one(fields.y(), stencils, factors[1], l, amounts[1][l]);
      mls::spread_one(fields.z(), stencils, factors[2], l, amounts[2][l]);
    }
  }
}

void spread(const Markers& markers, const MarkerVectors& forces, ForceFields& fields) {
  markers.for_each_block([&](const StencilBlock& block) { spread(markers, block, forces, fields); },
                         [&](const StencilBlock& block) { prefetch(block, fields.x(), fields.y(), fields.z()); });
}

}  // namespace pliant
