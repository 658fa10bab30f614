#pragma once
#include <array>
#include <cstddef>

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
  /// Where the value varies along an open side: at (a, b), the two directions along the side in the order x, y, z, it
  /// is values[a + b * values_stride]. Null: `value` everywhere.
  const double* values = nullptr;
  std::ptrdiff_t values_stride = 0;

  double value_at(int a, int b) const { return values == nullptr ? value : values[a + b * values_stride]; }
};

/// The rules of one field, sides in the order x-, x+, y-, y+, z-, z+.
using FieldRules = std::array<SideRule, 6>;

/// Rules of velocity component `component` (0, 1, 2). Open sides get the kind and sign of their rule; OpenSides lends
/// the values.
FieldRules velocity_rules(const BoundaryConfig& boundary, int component);
/// Rules of the pressure and its increment: zero normal gradient at bounded sides.
FieldRules pressure_rules(const BoundaryConfig& boundary);

}  // namespace pliant
