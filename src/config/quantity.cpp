#include "config/quantity.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>

#include "core/error.hpp"

namespace pliant {
namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

/// The data base of units, read once.
ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    return ut_read_xml(nullptr);
  }();
  if (system == nullptr)
    throw InputError(
        "the data base of units cannot be read; is udunits2.xml installed? UDUNITS2_XML_PATH says where it is");
  return system;
}

/// What a visit to a unit finds out.
struct Parts {
  Quantity one{1, {}};
  std::string strange;  // what is not made of length, time and mass
};

void add(Parts& parts, const ut_unit* basic, int power) {
  const char* symbol = ut_get_symbol(basic, UT_ASCII);
  const std::string name = symbol != nullptr ? symbol : "?";
  if (name == "m") parts.one.dimension.length += power;
  else if (name == "s") parts.one.dimension.time += power;
  else if (name == "kg") parts.one.dimension.mass += power;
  else if (name != "rad") parts.strange = name;
}

ut_status visit_basic(const ut_unit* unit, void* parts) {
  add(*static_cast<Parts*>(parts), unit, 1);
  return UT_SUCCESS;
}
ut_status visit_product(const ut_unit*, int count, const ut_unit* const* basics, const int* powers, void* parts) {
  for (int n = 0; n < count; ++n) add(*static_cast<Parts*>(parts), basics[n], powers[n]);
  return UT_SUCCESS;
}
extern const ut_visitor visitor;
ut_status visit_galilean(const ut_unit*, double scale, const ut_unit* underlying, double offset, void* parts) {
  auto& found = *static_cast<Parts*>(parts);
  found.one.value *= scale;
  if (offset != 0) found.strange = "an offset";
  return ut_accept_visitor(underlying, &visitor, parts);
}
ut_status visit_timestamp(const ut_unit*, const ut_unit*, double, void* parts) {
  static_cast<Parts*>(parts)->strange = "a date";
  return UT_SUCCESS;
}
ut_status visit_logarithmic(const ut_unit*, double, const ut_unit*, void* parts) {
  static_cast<Parts*>(parts)->strange = "a logarithm";
  return UT_SUCCESS;
}
const ut_visitor visitor{visit_basic, visit_product, visit_galilean, visit_timestamp, visit_logarithmic};

std::string trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.remove_suffix(1);
  return std::string(text);
}

/// Takes a number off the front of a text that begins with one.
std::optional<double> take_number(std::string_view& text) {
  const char* begin = text.data() + (!text.empty() && text.front() == '+' ? 1 : 0);
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return value;
}

/// "[10, 5, 5] cm" as "10 cm", "5 cm", "5 cm"; nothing if the text is not of that form.
std::optional<Json> split_list(const std::string& text) {
  const auto whole = trimmed(text);
  const auto end = whole.find(']');
  if (whole.empty() || whole.front() != '[' || end == std::string::npos) return std::nullopt;
  const auto unit = whole.substr(end + 1);
  auto list = Json::array();
  std::string_view inner = std::string_view(whole).substr(1, end - 1);
  while (true) {
    const auto comma = inner.find(',');
    list.push_back(trimmed(inner.substr(0, comma)) + " " + trimmed(unit));
    if (comma == std::string_view::npos) return list;
    inner.remove_prefix(comma + 1);
  }
}

double number_in(const std::string& text, const KeyUnit& unit, const UnitScales* scales,
                 std::optional<std::string>& problem) {
  std::string what;
  const auto quantity = read_quantity(text, what);
  if (!quantity) problem = fmt::format("is \"{}\": {}", text, what);
  else if (quantity->dimension != unit.dimension)
    problem = fmt::format("is \"{}\", {}, but must be {} (in SI: {})", text, describe(quantity->dimension),
                          unit.dimension == Dimension{} ? "an angle" : describe(unit.dimension),
                          unit.dimension == Dimension{} ? "rad" : si_unit(unit.dimension));
  else if (scales == nullptr && unit.dimension != Dimension{} && !unit.is_clock_time)
    problem = fmt::format("is \"{}\", {}", text, how_to_give_scales());
  else return in_own_units(*quantity, unit, scales != nullptr ? *scales : UnitScales{});
  return 0;
}

}  // namespace

std::optional<Quantity> read_unit(const std::string& text, std::string& problem) {
  auto spelled = trimmed(text);
  const Unit unit(ut_parse(unit_system(), spelled.c_str(), UT_UTF8));
  if (!unit) {
    problem =
        fmt::format("\"{}\" is no unit; write it as in \"mm\", \"kg/m^3\", \"mL/s\", \"MPa\" (UDUNITS-2)", spelled);
    return std::nullopt;
  }
  Parts parts;
  ut_accept_visitor(unit.get(), &visitor, &parts);
  if (!parts.strange.empty()) {
    problem = fmt::format("\"{}\" is a unit with {}, not of length, time and mass alone", spelled, parts.strange);
    return std::nullopt;
  }
  return parts.one;
}

std::optional<Quantity> read_quantity(const std::string& text, std::string& problem) {
  const auto whole = trimmed(text);
  std::string_view rest = whole;
  const auto number = take_number(rest);
  if (!number) {
    problem = "a number with a unit begins with the number, as \"25 mm\"";
    return std::nullopt;
  }
  if (trimmed(rest).empty()) {
    problem = "it has no unit; a number in the case's own units stands without quotes";
    return std::nullopt;
  }
  auto quantity = read_unit(std::string(rest), problem);
  if (quantity) quantity->value *= *number;
  return quantity;
}

bool looks_like_quantity(const std::string& text) {
  const auto whole = trimmed(text);
  std::string_view rest = whole;
  if (!take_number(rest) || rest.size() < 2) return false;
  return rest[0] == ' ' && std::isalpha(static_cast<unsigned char>(trimmed(rest).front())) != 0;
}

double in_own_units(const Quantity& quantity, const KeyUnit& unit, const UnitScales& scales) {
  return quantity.value * unit.factor / (unit.is_clock_time ? 1 : scales.of(unit.dimension));
}

Json to_own_units(const Json& value, const KeyUnit& unit, const UnitScales* scales,
                  std::optional<std::string>& problem) {
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    if (const auto list = split_list(text)) return to_own_units(*list, unit, scales, problem);
    const auto whole = trimmed(text);
    std::string_view rest = whole;
    if (!take_number(rest)) return value;  // no quantity: whoever reads it says what it wants
    const double number = number_in(text, unit, scales, problem);
    return problem ? value : Json(number);
  }
  if (!value.is_array()) return value;
  auto list = Json::array();
  for (const auto& element : value) {
    list.push_back(to_own_units(element, unit, scales, problem));
    if (problem) break;
  }
  return list;
}

std::string how_to_give_scales() {
  return "but the case does not say what its own units are; add [units] with length, velocity (or time) and density, "
         "such as length = \"25 mm\", velocity = \"0.2 m/s\", density = \"1000 kg/m^3\": these are 1 then";
}

std::optional<UnitScales> scales_of(const UnitsConfig& units) {
  std::string ignored;
  const auto get = [&](const std::string& text, Dimension wanted) -> std::optional<double> {
    const auto quantity = text.empty() ? std::nullopt : read_quantity(text, ignored);
    const bool is_sound = quantity && quantity->dimension == wanted && quantity->value > 0;
    return is_sound ? std::optional(quantity->value) : std::nullopt;
  };
  const auto length = get(units.length, {1, 0, 0}), velocity = get(units.velocity, {1, -1, 0});
  const auto time = get(units.time, {0, 1, 0}), density = get(units.density, {-3, 0, 1});
  if (!length || !density || (!velocity && !time)) return std::nullopt;
  return UnitScales{*length, time ? *time : *length / *velocity, *density * *length * *length * *length};
}

}  // namespace pliant
