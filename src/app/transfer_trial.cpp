#include "app/transfer_trial.hpp"

#include <algorithm>
#include <cmath>

#include "transfer/probe_points.hpp"
#include "transfer/spread.hpp"

namespace pliant {
namespace {

constexpr double substep_weights[] = {8.0 / 15, 2.0 / 15, 1.0 / 3};
constexpr std::size_t n_probed = 10;

// So little that the flow stays as it is, however many steps are taken and spheres overlap; the work is the same.
constexpr double marker_area = 1e-3;

template <class Location>
void fill(Field<Location>& field, const Grid& grid, double phase) {
  const auto f = field.view();
  for (int k = -1; k <= grid.nz(); ++k)
    for (int j = -1; j <= grid.ny(); ++j)
      for (int i = -1; i <= grid.nx(); ++i) {
        const double scrambled = 0.7548776662 * i + 0.5698402910 * j + 0.3247179572 * (k + grid.slab().begin) + phase;
        f(i, j, k) = scrambled - std::floor(scrambled);
      }
}

template <class Location>
double weighted_sum(ConstView<Location> f, const NodeSupport& s, const GenericStencil& weights) {
  double sum = 0;
  std::size_t n = 0;
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b < 3; ++b)
      for (int a = 0; a < 3; ++a) sum += weights[n++] * f(s.first[0] + a, s.first[1] + b, s.first[2] + c);
  return sum;
}

template <class Location>
void add_weighted(double amount, const NodeSupport& s, const GenericStencil& weights, View<Location> f) {
  std::size_t n = 0;
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b < 3; ++b)
      for (int a = 0; a < 3; ++a) f(s.first[0] + a, s.first[1] + b, s.first[2] + c) += amount * weights[n++];
}

template <class Location>
void forward_and_back(const GenericMethod& method, const Grid& grid, Vec3 x, int component, ConstView<Location> u,
                      double factor, View<Location> force, double& found) {
  const auto support = find_support(grid, x, component);
  if (!support.is_held(grid)) return;
  GenericStencil values;
  method.values(support, values);
  for (int substep = 0; substep < 3; ++substep) {
    found = weighted_sum(u, support, values);
    add_weighted(factor * found, support, values, force);
  }
}

template <class Location>
void find_gradient(const GenericMethod& method, const Grid& grid, Vec3 x, int component, ConstView<Location> u,
                   double* found) {
  const auto support = find_support(grid, x, component);
  if (!support.is_held(grid)) return;
  std::array<GenericStencil, 3> gradients;
  method.gradients(support, gradients);
  for (std::size_t d = 0; d < 3; ++d) found[d] = weighted_sum(u, support, gradients[d]);
}

}  // namespace

TransferTrial::TransferTrial(const Grid& grid, const BenchMarkers& markers)
    : grid_(grid),
      shape_(grid),
      u_(grid),
      v_(grid),
      w_(grid),
      p_(grid),
      markers_(grid),
      forces_(grid),
      forcing_(grid, 1.0),
      sampler_(grid, {&u_, &v_, &w_, &p_}, 1.0) {
  fill(u_, grid, 0.1);
  fill(v_, grid, 0.2);
  fill(w_, grid, 0.3);
  fill(p_, grid, 0.4);
  const auto keep_near = [&](const std::vector<Vec3>& points, std::vector<Vec3>& near) {
    for (Vec3 x : points) {
      shape_.bring_into_box(x);
      if (shape_.is_near(x.z)) near.push_back(x);
    }
  };
  keep_near(markers.positions, positions_);
  keep_near(markers.ends, ends_);
  const auto n = static_cast<long>(markers.ends.size());
  const long rank = grid.ranks().rank(), ranks = grid.ranks().size();
  asked_.assign(markers.ends.begin() + n * rank / ranks, markers.ends.begin() + n * (rank + 1) / ranks);
  samples_.resize(asked_.size());
  areas_.assign(positions_.size(), marker_area);
  velocities_.assign(positions_.size(), Vec3{0.5, 0.5, 0.5});
  place_markers();
  forces_.reach(markers_);
  for (Found* found : {&closed_, &generic_}) {
    found->velocities.assign(markers_.padded_size());
    found->probed.assign(n_probed * ends_.size(), 0.0);
  }
}

void TransferTrial::make_stencils() {
  markers_.for_each_block([&](const StencilBlock& block) { checksum_ += block.stencils[0].value[x_center][1][0]; });
}

void TransferTrial::interpolate_velocity() {
  interpolate(markers_, u_.view(), v_.view(), w_.view(), closed_.velocities);
}

void TransferTrial::spread_force() { spread(markers_, closed_.velocities, forces_); }

void TransferTrial::probe_flow() { probe_ends(closed_.probed); }

void TransferTrial::place_markers() { markers_.place(positions_, areas_); }

void TransferTrial::step() {
  for (int substep = 0; substep < 3; ++substep)
    markers_.for_each_block(
        [&](const StencilBlock& block) {
          interpolate(markers_, block, u_.view(), v_.view(), w_.view(), closed_.velocities);
          spread(markers_, block, closed_.velocities, forces_);
        },
        [&](const StencilBlock& block) {
          prefetch(block, u_.view(), v_.view(), w_.view());
          prefetch(block, forces_.x(), forces_.y(), forces_.z());
        });
  probe_ends(closed_.probed);
}

void TransferTrial::step_by(const GenericMethod& method) {
  for (std::size_t m = 0; m < static_cast<std::size_t>(markers_.size()); ++m) step_marker(method, m);
  for (std::size_t n = 0; n < ends_.size(); ++n) probe_end(method, n);
}

void TransferTrial::step_of_run() {
  forcing_.place(positions_, areas_, velocities_);
  for (int l = 0; l < 3; ++l) forcing_.apply({l, 0, 0, substep_weights[l]}, 1e-3, u_.view(), v_.view(), w_.view());
  sampler_.sample(asked_, samples_);
}

void TransferTrial::probe_ends(std::vector<double>& probed) {
  const ProbedFields fields{u_.view(), v_.view(), w_.view(), p_.view()};
  for_each_probe_batch(shape_, fields, ends_, [&](const ProbedPoints& batch) {
    ProbeBatch found;
    probe(fields, batch.stencils, batch.slopes, batch.count, found);
    for (int l = 0; l < batch.count; ++l) {
      double* out = probed.data() + n_probed * batch.indices[static_cast<std::size_t>(l)];
      if (batch.has_center[l]) out[0] = found.pressure[l];
      for (int c = 0; c < 3; ++c)
        if (c == 2 ? batch.has_face[l] : batch.has_center[l])
          for (int d = 0; d < 3; ++d) out[1 + 3 * c + d] = found.gradient[c][d][l];
    }
  });
}

void TransferTrial::step_marker(const GenericMethod& method, std::size_t m) {
  const Vec3 x = positions_[static_cast<std::size_t>(markers_.indices()[m])];
  auto& found = generic_.velocities;
  forward_and_back<FaceX>(method, grid_, x, 0, u_.view(), markers_.spreading(0)[m], forces_.x(), found[0][m]);
  forward_and_back<FaceY>(method, grid_, x, 1, v_.view(), markers_.spreading(1)[m], forces_.y(), found[1][m]);
  forward_and_back<FaceZ>(method, grid_, x, 2, w_.view(), markers_.spreading(2)[m], forces_.z(), found[2][m]);
}

void TransferTrial::probe_end(const GenericMethod& method, std::size_t n) {
  const Vec3 x = ends_[n];
  double* found = generic_.probed.data() + n_probed * n;
  if (const auto support = find_support(grid_, x, 3); support.is_held(grid_)) {
    GenericStencil values;
    method.values(support, values);
    found[0] = weighted_sum<Center>(p_.view(), support, values);
  }
  find_gradient<FaceX>(method, grid_, x, 0, u_.view(), found + 1);
  find_gradient<FaceY>(method, grid_, x, 1, v_.view(), found + 4);
  find_gradient<FaceZ>(method, grid_, x, 2, w_.view(), found + 7);
}

double TransferTrial::largest_difference() const {
  double difference = 0, largest = 0;
  const auto compare = [&](const std::vector<double>& a, const std::vector<double>& b) {
    for (std::size_t n = 0; n < a.size(); ++n) {
      difference = std::max(difference, std::abs(a[n] - b[n]));
      largest = std::max(largest, std::abs(a[n]));
    }
  };
  for (int c = 0; c < 3; ++c) compare(closed_.velocities[c], generic_.velocities[c]);
  compare(closed_.probed, generic_.probed);
  return grid_.ranks().max(difference) / grid_.ranks().max(largest);
}

}  // namespace pliant
