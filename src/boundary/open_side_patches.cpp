#include <algorithm>
#include <cmath>

#include "boundary/open_sides.hpp"

// What OpenSides knows of patches.
namespace pliant {

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
        if (side.signal) largest = std::max(largest, grid_.convective_rate(side.inflow->velocity) * std::abs(factor));
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
        largest = std::max(largest, std::abs(net) / patch->area / grid_.smallest_dz());
  };
  for (int n = 0; n <= samples; ++n) {
    sample(end * n / samples);
    // A run of many periods would step over their peaks.
    if (longest > 0 && longest < end) sample(longest * n / samples);
  }
  return largest;
}

}  // namespace pliant
