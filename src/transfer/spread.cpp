#include "transfer/spread.hpp"

#include "transfer/mls_kernels.hpp"

namespace pliant {
namespace {

template <class Location>
void spread_component(const Markers& markers, const StencilBatch& stencils, int batch, int component,
                      const MarkerVectors& forces, View<Location> field) {
  const std::size_t at = static_cast<std::size_t>(batch) * mls_batch;
  const double* force = forces[component].data() + at;
  const double* factor = markers.spreading(component).data() + at;
  double amounts[mls_batch];
  for (int l = 0; l < mls_batch; ++l) amounts[l] = factor[l] * force[l];
  mls::spread(field, stencils, markers.count(batch), amounts);
}

}  // namespace

void spread(const Markers& markers, const StencilBlock& block, const MarkerVectors& forces, ForceFields& fields) {
  for (int b = 0; b < block.n_batches; ++b) {
    const auto& stencils = block.stencils[static_cast<std::size_t>(b)];
    spread_component(markers, stencils, block.first_batch + b, 0, forces, fields.x());
    spread_component(markers, stencils, block.first_batch + b, 1, forces, fields.y());
    spread_component(markers, stencils, block.first_batch + b, 2, forces, fields.z());
  }
}

void spread(const Markers& markers, const MarkerVectors& forces, ForceFields& fields) {
  markers.for_each_block([&](const StencilBlock& block) { spread(markers, block, forces, fields); });
}

}  // namespace pliant
