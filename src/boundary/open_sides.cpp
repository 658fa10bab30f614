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

/// One upwind step from an old value towards the one next to it.
double towards(double old, double courant, double neighbour) {
  return old - std::clamp(courant, 0.0, 1.0) * (old - neighbour);
}

}  // namespace

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

const FlowPatch* OpenSides::Side::balance_patch() const {
  for (const auto& patch : patches)
    if (patch.balances()) return &patch;
  return nullptr;
}

// What enters through a patch with a rate has its profile and the wall's own tangential velocity. What leaves, through
// any patch, is carried by the convective condition of an outflow side, shifted to its rate: no slip in the hole would
// be a layer that the flow does not have, and that ends in wiggles and, as the hole closes, in a jet that nothing
// drives. What enters through the balance patch tends to a plug, as fast as it comes: values kept as they were would
// come in as they left. The tangential values are those of the wall itself, half a cell from the first nodes: the rule
// of a wall stays, and with it the implicit solves.
void OpenSides::set_patches(Side& side, const VelocityViews& velocity, double time, double dt_alpha) const {
  std::vector<PatchMotion> motions;
  side.given = 0;
  for (const FlowPatch& patch : side.patches) {
    const double rate = patch.balances() ? -side.mean_outward * patch.area : patch.flow_rate(time);
    if (!patch.balances()) side.given += rate;
    const double dz = grid_.global_dz_c()[side.number % 2 == 0 ? 0 : grid_.cells()[2] - 1];
    motions.push_back({rate, std::abs(rate) / patch.area * dt_alpha / dz});
  }
  if (!side.here) return;
  for (std::size_t p = 0; p < side.patches.size(); ++p)
    set_normal_values(side, side.patches[p], motions[p], velocity.w);
  if (!side.varies[0]) return;
  set_tangential_values(side, motions, 0, velocity.u);
  set_tangential_values(side, motions, 1, velocity.v);
}

void OpenSides::set_normal_values(Side& side, const FlowPatch& patch, const PatchMotion& motion,
                                  ConstView<FaceZ> w) const {
  const double inwards = -side.outwards();
  const auto value = [&](const std::array<int, 2>& face) -> double& {
    return side.values[2][side.index(face[0], face[1])];
  };
  if (!motion.leaves() && !patch.balances()) {
    for (std::size_t n = 0; n < patch.faces.size(); ++n)
      value(patch.faces[n]) = inwards * motion.rate * patch.weights[n];
    return;
  }
  const int inner = side.number % 2 == 1 ? grid_.nz() - 2 : 0;
  const double plug = inwards * motion.rate / patch.area;
  double mean = 0;
  for (const auto& face : patch.faces) {
    value(face) = towards(value(face), motion.cells, motion.leaves() ? w(face[0], face[1], inner) : plug);
    mean += value(face) / static_cast<double>(patch.faces.size());
  }
  if (patch.balances()) return;  // shifted when all the others are known
  for (const auto& face : patch.faces) value(face) += plug - mean;
}

template <class Location>
void OpenSides::set_tangential_values(Side& side, const std::vector<PatchMotion>& motions, int component,
                                      ConstView<Location> field) const {
  const auto c = static_cast<std::size_t>(component);
  const double at_wall = std::get<WallSide>(boundary_[static_cast<std::size_t>(side.number)]).velocity[component];
  const int k = side.number % 2 == 1 ? grid_.nz() - 1 : 0;
  for (int j = 0; j < side.nb; ++j)
    for (int i = 0; i < side.na; ++i) {
      double& value = side.values[c][side.index(i, j)];
      // A node lies between two faces, and in a patch if both are.
      const int owner = side.owners[side.index(i, j)];
      const bool within = owner >= 0 && owner == side.owners[side.index(i + 1 - component, j + component)];
      const auto p = static_cast<std::size_t>(owner);
      if (within && motions[p].leaves()) value = 2 * towards(0.5 * value, 2 * motions[p].cells, field(i, j, k));
      else if (within && side.patches[p].balances()) value = 2 * towards(0.5 * value, 2 * motions[p].cells, at_wall);
      else value = 2 * at_wall;
    }
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

std::vector<PatchFlowRate> OpenSides::patch_flow_rates() const {
  std::vector<PatchFlowRate> rates;
  std::vector<double> sums;
  for (const Side& side : sides_)
    for (const FlowPatch& patch : side.patches) {
      double sum = 0;
      if (side.here)
        for (const auto& [i, j] : patch.faces) sum -= side.outwards() * side.values[2][side.index(i, j)];
      rates.push_back({patch.name, 0});
      sums.push_back(sum * grid_.dx() * grid_.dy());
    }
  grid_.ranks().sum(sums);
  for (std::size_t p = 0; p < sums.size(); ++p) rates[p].value = sums[p];
  return rates;
}

double OpenSides::smallest_spacing(int direction) const {
  return direction == 0 ? grid_.dx() : direction == 1 ? grid_.dy() : grid_.smallest_dz();
}

double OpenSides::largest_rate(double end) const {
  constexpr int samples = 2000;
  double longest = 0;
  for (const Side& side : sides_) {
    if (side.signal && side.signal->period()) longest = std::max(longest, *side.signal->period());
    for (const auto& patch : side.patches)
      if (patch.signal && patch.signal->period()) longest = std::max(longest, *patch.signal->period());
  }
  double largest = 0;
  const auto sample = [&](double time) {
    double net = 0;
    for (const Side& side : sides_) {
      if (side.inflow != nullptr) {
        const double factor = side.signal ? side.signal->value(time) : 1.0;
        double rate = 0;
        for (int d = 0; d < 3; ++d) rate += std::abs(side.inflow->velocity[d]) / smallest_spacing(d);
        if (side.signal) largest = std::max(largest, rate * std::abs(factor));
        net -= side.outwards() * side.inflow->velocity[side.direction()] * side.area * factor;
      }
      const double dz = grid_.global_dz_c()[side.number % 2 == 0 ? 0 : grid_.cells()[2] - 1];
      for (const auto& patch : side.patches) {
        const double rate = patch.flow_rate(time);
        net += rate;
        largest =
            std::max(largest, std::abs(rate) * *std::max_element(patch.weights.begin(), patch.weights.end()) / dz);
      }
    }
    for (const Side& side : sides_)
      if (const FlowPatch* patch = side.balance_patch())
        largest = std::max(largest, std::abs(net) / patch->area / smallest_spacing(2));
  };
  for (int n = 0; n <= samples; ++n) {
    sample(end * n / samples);
    // A run of many periods would step over their peaks.
    if (longest > 0 && longest < end) sample(longest * n / samples);
  }
  return largest;
}

double OpenSides::net_outward_flux() const {
  double net = 0;
  for (double flux : outward_fluxes()) net += flux;
  return net;
}

}  // namespace pliant
