#include "transfer/direct_forcing.hpp"

#include <algorithm>
#include <cmath>

#include "transfer/spread.hpp"

namespace pliant {
DirectForcing::DirectForcing(const Grid& grid, double density, int iterations)
    : grid_(grid),
      sets_{Set(grid), Set(grid)},
      fields_(grid),
      copies_(grid),
      density_(density),
      iterations_(iterations) {}

void DirectForcing::place(std::span<const Vec3> positions, std::span<const double> areas,
                          std::span<const Vec3> velocities, MarkerGroup group) {
  Set& set = set_of(group);
  set.markers.place(positions, areas);
  if (group == MarkerGroup::fixed) fields_.reach_always(set.markers);
  fields_.reach(set_of(MarkerGroup::moving).markers);
  for (auto* vectors : {&set.wanted, &set.found, &set.impulse}) vectors->assign(set.markers.padded_size());
  set.complete = nullptr;
  set.carries = false;
  set_velocities(velocities, group);
}

void DirectForcing::set_sheets(std::span<const Vec3> normals, double viscosity, Completion complete,
                               MarkerGroup group) {
  Set& set = set_of(group);
  set.complete = std::move(complete);
  set.whole.resize(normals.size());
  const auto indices = set.markers.indices();
  set.normals.resize(indices.size());
  for (std::size_t m = 0; m < indices.size(); ++m) set.normals[m] = normals[static_cast<std::size_t>(indices[m])];
  set.resistance = set.markers.layers(normals);
  for (double& r : set.resistance) r /= 2 * viscosity;
}

void DirectForcing::carry(std::span<const Vec3> forces, MarkerGroup group) {
  Set& set = set_of(group);
  set.carries = true;
  set.carried.assign(set.markers.padded_size());
  const auto indices = set.markers.indices();
  for (int c = 0; c < 3; ++c) {
    const auto share = set.markers.share(c);
    for (std::size_t m = 0; m < indices.size(); ++m)
      if (share[m] != 0) set.carried[c][m] = forces[static_cast<std::size_t>(indices[m])][c];
  }
}

void DirectForcing::add_carried(std::span<Vec3> forces, MarkerGroup group) const {
  const Set& set = set_of(group);
  if (set.carries) add_shares(set, set.carried, forces);
}

// The components that this rank works on, by the caller's index.
void DirectForcing::add_shares(const Set& set, const MarkerVectors& vectors, std::span<Vec3> sums) {
  const auto indices = set.markers.indices();
  for (int c = 0; c < 3; ++c) {
    const auto share = set.markers.share(c);
    for (std::size_t m = 0; m < indices.size(); ++m)
      if (share[m] != 0) sums[static_cast<std::size_t>(indices[m])][c] += vectors[c][m];
  }
}

void DirectForcing::set_velocities(std::span<const Vec3> velocities, MarkerGroup group) {
  Set& set = set_of(group);
  const auto indices = set.markers.indices();
  for (int c = 0; c < 3; ++c)
    for (std::size_t m = 0; m < indices.size(); ++m)
      set.wanted[c][m] = velocities[static_cast<std::size_t>(indices[m])][c];
}

void DirectForcing::apply(const Substep& substep, double dt, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
  if (substep.index == 0)
    for (Set& set : sets_) set.impulse.assign(set.markers.padded_size());
  for (Set& set : sets_)
    if (set.complete) set.along.assign(set.normals.size(), Vec3{});
  bool is_touched = spread_carried(substep.alpha * density_, substep.alpha * dt, u, v, w);
  for (int n = 0; n < iterations_; ++n) {
    if (is_touched) copies_.fill(u, v, w);
    force_once(substep.alpha * density_, substep.alpha * dt, u, v, w);
    is_touched = true;
  }
}

// Returns whether the velocity was changed.
bool DirectForcing::spread_carried(double weight, double dt_alpha, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
  bool any = false;
  for (Set& set : sets_) {
    if (!set.carries) continue;
    any = true;
    for (int c = 0; c < 3; ++c) {
      const auto volume = set.markers.volume(c);
      for (std::size_t m = 0; m < volume.size(); ++m) set.impulse[c][m] += weight * volume[m] * set.carried[c][m];
    }
    if (set.complete) begin_along(set);
    set.markers.for_each_block([&](const StencilBlock& block) { spread(set.markers, block, set.carried, fields_); });
  }
  if (!any) return false;
  fields_.gather();
  fields_.move_to(dt_alpha, u, v, w);
  return true;
}

// What is carried counts among the forces along a sheet, which its layer's flow resists.
void DirectForcing::begin_along(Set& set) {
  const auto indices = set.markers.indices();
  std::fill(set.whole.begin(), set.whole.end(), Vec3{});
  add_shares(set, set.carried, set.whole);
  set.complete(set.whole);
  for (std::size_t m = 0; m < indices.size(); ++m) {
    if (set.resistance[m] <= 0) continue;
    const Vec3 n = set.normals[m], force = set.whole[static_cast<std::size_t>(indices[m])];
    set.along[m] = force - dot(force, n) * n;
  }
}

void DirectForcing::force_once(double weight, double dt_alpha, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
  // Planes are settled behind the last set of markers, when no other one reads them any more.
  Set& last = set_of(set_of(MarkerGroup::moving).markers.size() > 0 ? MarkerGroup::moving : MarkerGroup::fixed);
  for (Set& set : sets_)
    if (set.complete) force_sheets(set, weight, dt_alpha, u, v, w);
    else force_set(set, &set == &last, weight, dt_alpha, u, v, w);
  fields_.gather();
  fields_.move_to(dt_alpha, u, v, w);
}

void DirectForcing::force_set(Set& set, bool is_last, double weight, double dt_alpha, View<FaceX> u, View<FaceY> v,
                              View<FaceZ> w) {
  const double factor = 1 / dt_alpha;
  const auto expect = [&](const StencilBlock& block) {
    prefetch(block, u, v, w);
    prefetch(block, fields_.x(), fields_.y(), fields_.z());
  };
  const auto force = [&](const StencilBlock& block) {
    interpolate(set.markers, block, u, v, w, set.found);
    const std::size_t begin = static_cast<std::size_t>(block.first_batch) * mls_batch;
    const std::size_t end = begin + static_cast<std::size_t>(block.n_batches) * mls_batch;
    for (int c = 0; c < 3; ++c) {
      const auto volume = set.markers.volume(c);
      for (std::size_t m = begin; m < end; ++m) {
        set.found[c][m] = factor * (set.wanted[c][m] - set.found[c][m]);
        set.impulse[c][m] += weight * volume[m] * set.found[c][m];
      }
      if (set.carries)
        for (std::size_t m = begin; m < end; ++m) set.carried[c][m] += set.found[c][m];
    }
    spread(set.markers, block, set.found, fields_);
    if (is_last) fields_.settle(set.markers.lowest_plane_from(block.first_batch + block.n_batches), dt_alpha, u, v, w);
  };
  set.markers.for_each_block(force, expect);
}

// What acts along a sheet and what across it are mixtures of components, which may be found on two ranks.
void DirectForcing::force_sheets(Set& set, double weight, double dt_alpha, View<FaceX> u, View<FaceY> v,
                                 View<FaceZ> w) {
  const double factor = 1 / dt_alpha;
  const auto indices = set.markers.indices();
  interpolate(set.markers, u, v, w, set.found);
  std::fill(set.whole.begin(), set.whole.end(), Vec3{});
  add_shares(set, set.found, set.whole);
  set.complete(set.whole);
  for (std::size_t m = 0; m < indices.size(); ++m) {
    const Vec3 n = set.normals[m], wanted{set.wanted[0][m], set.wanted[1][m], set.wanted[2][m]};
    Vec3 force = factor * (wanted - set.whole[static_cast<std::size_t>(indices[m])]);
    if (const double r = factor * set.resistance[m]; r > 0) {
      const Vec3 across = dot(force, n) * n, along = (force - across - r * set.along[m]) / (1 + r);
      set.along[m] += along;
      force = across + along;
    }
    for (int c = 0; c < 3; ++c) {
      set.found[c][m] = force[c];
      set.impulse[c][m] += weight * set.markers.volume(c)[m] * force[c];
      if (set.carries) set.carried[c][m] += force[c];
    }
  }
  set.markers.for_each_block([&](const StencilBlock& block) { spread(set.markers, block, set.found, fields_); });
}

void DirectForcing::add_forces(std::span<Vec3> forces, MarkerGroup group) const {
  const Set& set = set_of(group);
  const auto indices = set.markers.indices();
  for (int c = 0; c < 3; ++c)
    for (std::size_t m = 0; m < indices.size(); ++m)
      forces[static_cast<std::size_t>(indices[m])][c] -= set.impulse[c][m];
}

double DirectForcing::rms_slip(ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w) {
  double numbers[2] = {0, 0};  // sum of squares, markers
  for (Set& set : sets_) {
    interpolate(set.markers, u, v, w, set.found);
    for (int c = 0; c < 3; ++c) {
      const auto share = set.markers.share(c);
      for (std::size_t m = 0; m < share.size(); ++m) {
        const double slip = set.wanted[c][m] - set.found[c][m];
        numbers[0] += share[m] * slip * slip;
        if (c == 0) numbers[1] += share[m];
      }
    }
  }
  grid_.ranks().sum(numbers);
  return numbers[1] > 0 ? std::sqrt(numbers[0] / numbers[1]) : 0;
}

double DirectForcing::largest_correction() const {
  double largest = 0;
  for (const Set& set : sets_)
    for (int c : {0, 2})
      for (double factor : set.markers.spreading(c)) largest = std::max(largest, factor);
  return largest;
}

void DirectForcing::add_velocities(ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w,
                                   std::span<Vec3> velocities, MarkerGroup group) {
  Set& set = set_of(group);
  interpolate(set.markers, u, v, w, set.found);
  const auto indices = set.markers.indices();
  for (int c = 0; c < 3; ++c)
    for (std::size_t m = 0; m < indices.size(); ++m)
      velocities[static_cast<std::size_t>(indices[m])][c] += set.found[c][m];
}

}  // namespace pliant
