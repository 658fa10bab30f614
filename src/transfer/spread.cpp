#include "transfer/spread.hpp"

#include "transfer/mls_kernels.hpp"

namespace pliant {
namespace {

template <class Location>
void spread_component(const Markers& markers, int batch, int component, const MarkerVectors& forces,
                      View<Location> field) {
  const std::size_t at = static_cast<std::size_t>(batch) * mls_batch;
  const double* force = forces[component].data() + at;
  const double* factor = markers.spreading(component).data() + at;
  double amounts[mls_batch];
  for (int l = 0; l < mls_batch; ++l) amounts[l] = factor[l] * force[l];
  mls::spread(field, markers.stencils(batch), markers.count(batch), amounts);
}

}  // namespace

void spread(const Markers& markers, BatchRange batches, const MarkerVectors& forces, ForceFields& fields) {
  for (int b = batches.begin; b < batches.end; ++b) {
    spread_component(markers, b, 0, forces, fields.x());
    spread_component(markers, b, 1, forces, fields.y());
    spread_component(markers, b, 2, forces, fields.z());
  }
}

}  // namespace pliant
