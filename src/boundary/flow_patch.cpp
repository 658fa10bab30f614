#include "boundary/flow_patch.hpp"

#include <fmt/format.h>

#include "config/patch_geometry.hpp"
#include "core/error.hpp"
#include "signals/make_signal.hpp"

namespace pliant {
namespace {
PatchPlane plane_of(const Grid& grid) {
  return {{grid.origin().x, grid.origin().y},
          {grid.size().x, grid.size().y},
          {grid.nx(), grid.ny()},
          {grid.is_periodic(0), grid.is_periodic(1)}};
}
}  // namespace

double FlowPatch::flow_rate(double time) const {
  if (!signal) return 0;
  if (phase) {
    const double now = signal->phase(time);
    if (now < (*phase)[0] || now >= (*phase)[1]) return 0;
  }
  return signal->value(time);
}

std::vector<FlowPatch> make_flow_patches(const std::vector<PatchConfig>& patches, const Grid& grid,
                                         const Signals& signals) {
  const auto plane = plane_of(grid);
  const auto owners = patch_of_faces(patches, plane);
  const double face = grid.dx() * grid.dy();
  std::vector<FlowPatch> made;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    FlowPatch patch;
    patch.name = patches[p].name;
    if (!patches[p].balance) patch.signal = make_signal_or_formula(patches[p].flow_rate, signals);
    patch.phase = patches[p].phase;
    double sum = 0;
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i) {
        if (owners[static_cast<std::size_t>(i) + static_cast<std::size_t>(j) * static_cast<std::size_t>(grid.nx())] !=
            static_cast<int>(p))
          continue;
        patch.faces.push_back({i, j});
        patch.weights.push_back(profile_at(patches[p], plane, plane.face_center(i, j)));
        sum += patch.weights.back();
      }
    if (patch.faces.empty())
      throw InputError(
          fmt::format("the patch \"{}\" holds the centre of no face of the grid; make it larger, or the grid "
                      "finer",
                      patch.name));
    for (double& weight : patch.weights) weight /= sum * face;
    patch.area = static_cast<double>(patch.faces.size()) * face;
    made.push_back(std::move(patch));
  }
  return made;
}

}  // namespace pliant
