#include "boundary/side_rules.hpp"

namespace pliant {
namespace {

SideRule rule_of(const BoundarySpec& side, int component, int direction) {
  struct Visitor {
    int component, direction;
    SideRule operator()(const PeriodicSide&) const { return {SideRule::Kind::periodic, 1, 0}; }
    SideRule operator()(const WallSide& wall) const {
      const double velocity = wall.velocity[component];
      if (component == direction) return {SideRule::Kind::face, 0, velocity};
      return {SideRule::Kind::mirror, -1, 2 * velocity};
    }
    SideRule operator()(const InflowSide&) const {
      if (component == direction) return {SideRule::Kind::face, 0, 0};
      return {SideRule::Kind::mirror, -1, 0};
    }
    // What leaves is carried by the convective condition: the ghost itself is given.
    SideRule operator()(const OutflowSide&) const {
      return {component == direction ? SideRule::Kind::face : SideRule::Kind::mirror, 0, 0};
    }
    SideRule operator()(const FreeSlipSide&) const {
      if (component == direction) return {SideRule::Kind::face, 0, 0};
      return {SideRule::Kind::mirror, 1, 0};
    }
  };
  return std::visit(Visitor{component, direction}, side);
}

}  // namespace

FieldRules velocity_rules(const BoundaryConfig& boundary, int component) {
  FieldRules rules;
  for (int s = 0; s < 6; ++s)
    rules[static_cast<std::size_t>(s)] = rule_of(boundary[static_cast<std::size_t>(s)], component, s / 2);
  return rules;
}

FieldRules pressure_rules(const BoundaryConfig& boundary) {
  FieldRules rules;
  for (std::size_t s = 0; s < 6; ++s)
    rules[s] = std::holds_alternative<PeriodicSide>(boundary[s]) ? SideRule{} : SideRule{SideRule::Kind::mirror, 1, 0};
  return rules;
}

}  // namespace pliant
