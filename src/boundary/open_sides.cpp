#include "boundary/open_sides.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "signals/make_signal.hpp"

namespace pliant {
namespace {

/// The two directions along a side, in the order x, y, z.
constexpr std::array<std::array<int, 2>, 3> along{{{1, 2}, {0, 2}, {0, 1}}};

double coordinate(const Grid& grid, int direction, int component, int n) {
  const bool on_face = direction == component;
  if (direction == 0) return on_face ? grid.x_face(n) : grid.x_center(n);
  if (direction == 1) return on_face ? grid.y_face(n) : grid.y_center(n);
  return on_face ? grid.z_face()[n] : grid.z_center()[n];
}

}  // namespace

double OpenSides::towards(double old, double courant, double neighbour) {
  return old - std::clamp(courant, 0.0, 1.0) * (old - neighbour);
}

OpenSides::OpenSides(const Grid& grid, const BoundaryConfig& boundary, const Signals& signals)
    : grid_(grid), boundary_(boundary) {
  const std::array<int, 3> n{grid.nx(), grid.ny(), grid.nz()};
  for (int s = 0; s < 6; ++s) {
    const auto& spec = boundary_[static_cast<std::size_t>(s)];
    const auto* inflow = std::get_if<InflowSide>(&spec);
    const auto* patches = patches_of(spec);
    const bool has_patches = patches != nullptr && !patches->empty() && s >= 4;
    if (inflow == nullptr && !std::holds_alternative<OutflowSide>(spec) && !has_patches) continue;
    const auto d = static_cast<std::size_t>(s / 2);
    Side side;
    side.number = s;
    side.inflow = inflow;
    side.here = s < 4 || (s == 4 ? grid.has_bottom() : grid.has_top());
    side.na = n[static_cast<std::size_t>(along[d][0])];
    side.nb = n[static_cast<std::size_t>(along[d][1])];
    side.stride = side.na + 2;
    side.area = grid.volume() / grid.size()[s / 2];
    for (int c = 0; c < 3; ++c) {
      side.values[static_cast<std::size_t>(c)].resize(side.index(side.na, side.nb) + 1);
      side.changes[static_cast<std::size_t>(c)].resize(side.index(side.na, side.nb) + 1);
    }
    if (inflow != nullptr && !inflow->signal.empty()) side.signal = make_signal_or_formula(inflow->signal, signals);
    if (has_patches) {
      side.patches = make_flow_patches(*patches, grid, signals);
      const FlowPatch* balance = side.balance_patch();
      side.area = balance != nullptr ? balance->area : 0;
      // A free-slip side slips in its patches too.
      const bool slides = std::holds_alternative<WallSide>(spec);
      side.varies = {slides, slides, true};
      side.owners.assign(side.values[2].size(), -1);
      for (std::size_t p = 0; p < side.patches.size(); ++p)
        for (const auto& [i, j] : side.patches[p].faces) side.owners[side.index(i, j)] = static_cast<int>(p);
      // Beyond a bounded edge there is no face, beyond a periodic one the first.
      for (int j = 0; j < side.nb && grid.is_periodic(0); ++j)
        side.owners[side.index(side.na, j)] = side.owners[side.index(0, j)];
      for (int i = 0; i < side.na && grid.is_periodic(1); ++i)
        side.owners[side.index(i, side.nb)] = side.owners[side.index(i, 0)];
    }
    sides_.push_back(std::move(side));
  }
}

void OpenSides::lend_values(FieldRules& rules, int component) const {
  for (const Side& side : sides_) {
    if (!side.varies[static_cast<std::size_t>(component)]) continue;
    auto& rule = rules[static_cast<std::size_t>(side.number)];
    rule.values = side.values[static_cast<std::size_t>(component)].data() + side.index(0, 0);
    rule.values_stride = side.stride;
  }
}

SideChanges OpenSides::changes(int component) const {
  SideChanges changes;
  for (const Side& side : sides_) {
    if (!side.varies[static_cast<std::size_t>(component)]) continue;
    changes.values[static_cast<std::size_t>(side.number)] =
        side.changes[static_cast<std::size_t>(component)].data() + side.index(0, 0);
    changes.strides[static_cast<std::size_t>(side.number)] = side.stride;
  }
  return changes;
}

void OpenSides::start(const VelocityViews& velocity, double time) {
  for (Side& side : sides_) {
    // A Courant number of one puts the interior's value on the side.
    side.mean_outward = 1;
    set_side(side, velocity, time, std::numeric_limits<double>::infinity());
  }
  balance();
  for (Side& side : sides_)
    for (auto& changes : side.changes) std::fill(changes.begin(), changes.end(), 0.0);
}

void OpenSides::advance(const VelocityViews& velocity, double time, double dt_alpha) {
  for (Side& side : sides_) {
    side.changes = side.values;
    set_side(side, velocity, time, dt_alpha);
  }
  balance();
  for (Side& side : sides_)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < side.values[c].size(); ++i)
        side.changes[c][i] = side.values[c][i] - side.changes[c][i];
}

void OpenSides::set_side(Side& side, const VelocityViews& velocity, double time, double dt_alpha) const {
  if (side.inflow != nullptr) set_inflow(side, time);
  else if (side.is_outflow()) set_outflow(side, velocity, dt_alpha);
  else set_patches(side, velocity, time, dt_alpha);
  extend(side);
}

void OpenSides::set_inflow(Side& side, double time) const {
  const InflowSide& inflow = *side.inflow;
  const double phase = inflow.ramp > 0 ? std::clamp(time / inflow.ramp, 0.0, 1.0) : 1.0;
  const double growth = 0.5 * (1 - std::cos(std::numbers::pi * phase)) * (side.signal ? side.signal->value(time) : 1.0);
  const auto& directions = along[static_cast<std::size_t>(side.direction())];
  // Values at a boundary half a cell away enter its ghost twice.
  for (int c = 0; c < 3; ++c) {
    const double scale = growth * inflow.velocity[c] * (c == side.direction() ? 1 : 2);
    const auto shape = [&](int direction, int n) {
      if (inflow.profile == InflowProfile::uniform || grid_.is_periodic(direction)) return 1.0;
      const double s = std::clamp(
          (coordinate(grid_, direction, c, n) - grid_.origin()[direction]) / grid_.size()[direction], 0.0, 1.0);
      return 4 * s * (1 - s);
    };
    for (int b = 0; b < side.nb; ++b)
      for (int a = 0; a < side.na; ++a)
        side.values[static_cast<std::size_t>(c)][side.index(a, b)] =
            scale * shape(directions[0], a) * shape(directions[1], b);
  }
}

void OpenSides::set_outflow(Side& side, const VelocityViews& velocity, double dt_alpha) const {
  if (!side.here) return;
  const int d = side.direction();
  const std::array<int, 3> n{grid_.nx(), grid_.ny(), grid_.nz()};
  const bool upper = side.number % 2 == 1;
  const auto step = [&](auto field, int c) {
    const bool normal = c == d;
    // Layers of the side's own value and of the interior next to it.
    const int count = n[static_cast<std::size_t>(d)];
    const int outer = !upper ? -1 : normal ? count - 1 : count, inner = !upper ? 0 : outer - 1;
    const double spacing = d == 0   ? grid_.dx()
                           : d == 1 ? grid_.dy()
                           : normal ? grid_.dz_c()[upper ? count - 1 : 0]
                                    : grid_.dz_f()[upper ? count - 1 : -1];
    const double courant = std::clamp(side.mean_outward * dt_alpha / spacing, 0.0, 1.0);
    const auto at = [&](int layer, int a, int b) {
      return d == 0 ? field(layer, a, b) : d == 1 ? field(a, layer, b) : field(a, b, layer);
    };
    for (int b = 0; b < side.nb; ++b)
      for (int a = 0; a < side.na; ++a) {
        side.values[static_cast<std::size_t>(c)][side.index(a, b)] = towards(at(outer, a, b), courant, at(inner, a, b));
      }
  };
  step(velocity.u, 0);
  step(velocity.v, 1);
  step(velocity.w, 2);
}

// The values just beyond the edges of a side, for the corners of the ghosts: around a period, else as within.
void OpenSides::extend(Side& side) const {
  const auto& directions = along[static_cast<std::size_t>(side.direction())];
  const bool around_a = grid_.is_periodic(directions[0]), around_b = grid_.is_periodic(directions[1]);
  for (auto& v : side.values) {
    for (int b = 0; b < side.nb; ++b) {
      v[side.index(-1, b)] = v[side.index(around_a ? side.na - 1 : 0, b)];
      v[side.index(side.na, b)] = v[side.index(around_a ? 0 : side.na - 1, b)];
    }
    for (int a = -1; a <= side.na; ++a) {
      v[side.index(a, -1)] = v[side.index(a, around_b ? side.nb - 1 : 0)];
      v[side.index(a, side.nb)] = v[side.index(a, around_b ? 0 : side.nb - 1)];
    }
  }
}

double OpenSides::face_area(const Side& side, int b) const {
  switch (side.direction()) {
    case 0:
      return grid_.dy() * grid_.dz_c()[b];
    case 1:
      return grid_.dx() * grid_.dz_c()[b];
    default:
      return grid_.dx() * grid_.dy();
  }
}

std::vector<double> OpenSides::outward_fluxes() const {
  std::vector<double> fluxes;
  for (const Side& side : sides_) {
    double sum = 0;
    const auto& normal = side.values[static_cast<std::size_t>(side.direction())];
    if (side.here)
      for (int b = 0; b < side.nb; ++b) {
        double row = 0;
        for (int a = 0; a < side.na; ++a) row += normal[side.index(a, b)];
        sum += row * face_area(side, b);
      }
    fluxes.push_back(side.outwards() * sum);
  }
  grid_.ranks().sum(fluxes);
  return fluxes;
}

void OpenSides::balance() {
  if (sides_.empty()) return;
  const auto fluxes = outward_fluxes();
  double net = 0, area = 0;
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    net += fluxes[s];
    if (sides_[s].balances()) area += sides_[s].area;
  }
  const double shift = area > 0 ? -net / area : 0;
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    Side& side = sides_[s];
    if (side.is_outflow()) {
      for (double& v : side.values[static_cast<std::size_t>(side.direction())]) v += side.outwards() * shift;
      side.mean_outward = fluxes[s] / side.area + shift;
    } else if (const FlowPatch* patch = side.balance_patch()) {
      for (const auto& [i, j] : patch->faces) side.values[2][side.index(i, j)] += side.outwards() * shift;
      extend(side);
      side.mean_outward = (fluxes[s] + side.given) / side.area + shift;
    }
  }
}

double OpenSides::net_outward_flux() const {
  double net = 0;
  for (double flux : outward_fluxes()) net += flux;
  return net;
}

}  // namespace pliant
