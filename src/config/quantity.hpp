#pragma once
#include <optional>
#include <string>

#include "config/case_config.hpp"
#include "config/value_codec.hpp"

namespace pliant {

/// A number with a unit, in SI.
struct Quantity {
  double value = 0;
  Dimension dimension;
};

/// A unit such as "kg/m^3" or "mmHg", as UDUNITS-2 knows it: what one of it is in SI. Sets `problem` and returns
/// nothing if it is none, has an offset, or is made of more than length, time, mass and angle.
std::optional<Quantity> read_unit(const std::string& text, std::string& problem);

/// "25 mm", "1.2e6 Pa": a number and a unit.
std::optional<Quantity> read_quantity(const std::string& text, std::string& problem);

/// Whether a text that may be a formula begins as a quantity does: a number, a space, a letter.
bool looks_like_quantity(const std::string& text);

/// What a quantity is in a case's own units, for a key with that unit.
double in_own_units(const Quantity& quantity, const KeyUnit& unit, const UnitScales& scales);

/// `value`, in which each text that is a quantity has become a number in the case's own units; also in lists, and a
/// list in one text: "[10, 5, 5] cm". Texts that do not begin with a number stay. `scales`: null if the case states
/// none. Sets `problem` to what follows the key in a message.
Json to_own_units(const Json& value, const KeyUnit& unit, const UnitScales* scales,
                  std::optional<std::string>& problem);

/// For messages: what a case needs to say before it can use units.
std::string how_to_give_scales();

/// The scales of a case, if all of them are given and sound.
std::optional<UnitScales> scales_of(const UnitsConfig& units);

}  // namespace pliant
