#pragma once
#include <array>

#include "config/case_config.hpp"

namespace pliant {

/// How one field continues beyond one side of the box.
struct SideRule {
  enum class Kind {
    periodic,
    mirror,  ///< quantity at half a cell from the side: ghost = sign * interior + value
    face     ///< quantity on the side itself: set to value
  };
  Kind kind = Kind::periodic;
  double sign = 1;
  double value = 0;
};

/// The rules of one field, sides in the order x-, x+, y-, y+, z-, z+.
using FieldRules = std::array<SideRule, 6>;

/// Rules of velocity component `component` (0, 1, 2).
FieldRules velocity_rules(const BoundaryConfig& boundary, int component);
/// Rules of the pressure and its increment: zero normal gradient at bounded sides.
FieldRules pressure_rules(const BoundaryConfig& boundary);

}  // namespace pliant
