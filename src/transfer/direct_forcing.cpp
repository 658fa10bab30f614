#include "transfer/direct_forcing.hpp"

#include <algorithm>
#include <cmath>

#include "boundary/fill_ghosts.hpp"
#include "transfer/spread.hpp"

namespace pliant {
DirectForcing::DirectForcing(const Grid& grid, double density, int iterations)
    : markers_(grid),
      fields_(grid),
      halo_(grid.ranks(), grid.is_periodic(2) ? SlabHalo::Ends::periodic : SlabHalo::Ends::bounded, grid.nz()),
      density_(density),
      iterations_(iterations) {}

void DirectForcing::place(std::span<const Vec3> positions, std::span<const double> areas,
                          std::span<const Vec3> velocities) {
  markers_.place(positions, areas);
  fields_.reach(markers_);
  for (auto* vectors : {&wanted_, &found_, &impulse_}) vectors->assign(markers_.padded_size());
  set_velocities(velocities);
}

void DirectForcing::set_velocities(std::span<const Vec3> velocities) {
  const auto indices = markers_.indices();
  for (int c = 0; c < 3; ++c)
    for (std::size_t m = 0; m < indices.size(); ++m)
      wanted_[c][m] = velocities[static_cast<std::size_t>(indices[m])][c];
}

void DirectForcing::apply(const Substep& substep, double dt, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
  if (substep.index == 0) impulse_.assign(markers_.padded_size());
  for (int n = 0; n < iterations_; ++n) {
    if (n > 0) refill_ghosts(u, v, w);
    force_once(substep.alpha * density_, substep.alpha * dt, u, v, w);
  }
}

void DirectForcing::force_once(double weight, double dt_alpha, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
  fields_.clear();
  const double factor = 1 / dt_alpha;
  markers_.for_each_block([&](const StencilBlock& block) {
    interpolate(markers_, block, u, v, w, found_);
    const std::size_t begin = static_cast<std::size_t>(block.first_batch) * mls_batch;
    const std::size_t end = begin + static_cast<std::size_t>(block.n_batches) * mls_batch;
    for (int c = 0; c < 3; ++c) {
      const auto volume = markers_.volume(c);
      for (std::size_t m = begin; m < end; ++m) {
        found_[c][m] = factor * (wanted_[c][m] - found_[c][m]);
        impulse_[c][m] += weight * volume[m] * found_[c][m];
      }
    }
    spread(markers_, block, found_, fields_);
  });
  fields_.gather();
  fields_.add_to(dt_alpha, u, v, w);
}

// Supports hold no ghosts of bounded sides, so that the copies between ranks and periodic sides are all they need.
void DirectForcing::refill_ghosts(View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
  const Grid& grid = markers_.grid();
  for (int k = 0; k < grid.nz(); ++k) {
    fill_periodic_ghosts(u, grid, k);
    fill_periodic_ghosts(v, grid, k);
    fill_periodic_ghosts(w, grid, k);
  }
  halo_.fill({plane_stack(u), plane_stack(v), plane_stack(w)});
}

void DirectForcing::add_forces(std::span<Vec3> forces) const {
  const auto indices = markers_.indices();
  for (int c = 0; c < 3; ++c)
    for (std::size_t m = 0; m < indices.size(); ++m) forces[static_cast<std::size_t>(indices[m])][c] -= impulse_[c][m];
}

double DirectForcing::rms_slip(ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w) {
  interpolate(markers_, u, v, w, found_);
  double numbers[2] = {0, 0};  // sum of squares, markers
  for (int c = 0; c < 3; ++c) {
    const auto share = markers_.share(c);
    for (std::size_t m = 0; m < share.size(); ++m) {
      const double slip = wanted_[c][m] - found_[c][m];
      numbers[0] += share[m] * slip * slip;
      if (c == 0) numbers[1] += share[m];
    }
  }
  markers_.grid().ranks().sum(numbers);
  return numbers[1] > 0 ? std::sqrt(numbers[0] / numbers[1]) : 0;
}

double DirectForcing::largest_correction() const {
  double largest = 0;
  for (int c : {0, 2})
    for (double factor : markers_.spreading(c)) largest = std::max(largest, factor);
  return largest;
}

void DirectForcing::add_velocities(ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w,
                                   std::span<Vec3> velocities) {
  interpolate(markers_, u, v, w, found_);
  const auto indices = markers_.indices();
  for (int c = 0; c < 3; ++c)
    for (std::size_t m = 0; m < indices.size(); ++m)
      velocities[static_cast<std::size_t>(indices[m])][c] += found_[c][m];
}

}  // namespace pliant
