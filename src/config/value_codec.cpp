#include "config/value_codec.hpp"

#include <fmt/format.h>

namespace pliant {

std::string describe(const Limits& limits) {
  std::string text;
  if (std::isfinite(limits.min))
    text = fmt::format("{} {}", limits.min_bound == Bound::inclusive ? ">=" : ">", limits.min);
  if (std::isfinite(limits.max))
    text += fmt::format("{}{} {}", text.empty() ? "" : " and ", limits.max_bound == Bound::inclusive ? "<=" : "<",
                        limits.max);
  return text;
}

std::optional<std::string> check_limits(double value, const Limits& limits) {
  if (!std::isfinite(value)) return fmt::format("must be a finite number, not {}", value);
  const bool low = limits.min_bound == Bound::inclusive ? value < limits.min : value <= limits.min;
  const bool high = limits.max_bound == Bound::inclusive ? value > limits.max : value >= limits.max;
  if (low || high) return fmt::format("must be {}, not {}", describe(limits), value);
  return std::nullopt;
}

std::string describe_value(const Json& value) {
  if (value.is_string()) return fmt::format("the string \"{}\"", value.get<std::string>());
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number_integer()) return fmt::format("the integer {}", value.dump());
  if (value.is_number()) return fmt::format("the number {}", value.get<double>());
  if (value.is_array()) return fmt::format("an array of {}", value.size());
  if (value.is_object()) return "a table";
  return "nothing";
}

std::optional<double> read_number(const Json& value, const Limits& limits, std::optional<std::string>& problem) {
  if (!value.is_number()) {
    problem = "must be a number, not " + describe_value(value);
    return std::nullopt;
  }
  const auto number = value.get<double>();
  problem = check_limits(number, limits);
  if (problem) return std::nullopt;
  return number;
}

std::optional<std::int64_t> read_integer(const Json& value, const Limits& limits, std::optional<std::string>& problem) {
  if (!value.is_number_integer()) {
    problem = "must be an integer, not " + describe_value(value);
    return std::nullopt;
  }
  const auto number = value.get<std::int64_t>();
  problem = check_limits(static_cast<double>(number), limits);
  if (problem) return std::nullopt;
  return number;
}

}  // namespace pliant
