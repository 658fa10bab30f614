#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace pliant {

/// Exponents of length, time and mass.
struct Dimension {
  int length = 0, time = 0, mass = 0;
  friend bool operator==(const Dimension&, const Dimension&) = default;
};

/// What one unit of a case's own is in metres, seconds and kilograms.
struct UnitScales {
  double length = 1, time = 1, mass = 1;

  /// What one of the case's own units of this dimension is in SI.
  double of(Dimension dimension) const;
};

/// The unit of a key, as its text in the table of keys has it: "mass/(length time^2)", "velocity", "degrees/time".
struct KeyUnit {
  Dimension dimension;
  double factor = 1;           ///< the number in the file is so many times the quantity: 180/pi where it is in degrees
  bool is_clock_time = false;  ///< "minutes" on the wall, which the case's scales are nothing to
};

/// Reads the text of a key's unit; nothing where a number has no dimension that a text could give ("", "steps",
/// "grid spacings"). Throws std::logic_error on a text that is none of this.
std::optional<KeyUnit> parse_key_unit(std::string_view text);

/// "kg/(m s^2)", "m", "1".
std::string si_unit(Dimension dimension);
/// "a length", "a pressure", or else "mass/(length time)".
std::string describe(Dimension dimension);

}  // namespace pliant
