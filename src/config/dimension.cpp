#include "config/dimension.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace pliant {
namespace {

struct Named {
  const char* name;
  Dimension dimension;
};
constexpr std::array named{Named{"length", {1, 0, 0}}, Named{"time", {0, 1, 0}},       Named{"mass", {0, 0, 1}},
                           Named{"area", {2, 0, 0}},   Named{"volume", {3, 0, 0}},     Named{"velocity", {1, -1, 0}},
                           Named{"force", {1, -2, 1}}, Named{"pressure", {-1, -2, 1}}, Named{"energy", {2, -2, 1}},
                           Named{"torque", {2, -2, 1}}};

/// product = { ["/"] factor }, factor = (name | "1" | "(" product ")") ["^" digit]; a "/" is before one factor only.
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : all_(text), rest_(text) {}

  KeyUnit parse() {
    KeyUnit unit;
    product(1, unit);
    if (!rest_.empty()) fail();
    return unit;
  }

 private:
  [[noreturn]] void fail() const { throw std::logic_error(fmt::format("\"{}\" is no unit of a key", all_)); }
  bool takes(char c) {
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  void product(int sign, KeyUnit& unit) {
    for (bool any = false;; any = true) {
      while (takes(' ')) {}
      if (rest_.empty() || rest_.front() == ')') {
        if (!any) fail();
        return;
      }
      const bool divides = takes('/');
      while (takes(' ')) {}
      factor(divides ? -sign : sign, unit);
    }
  }
  void factor(int sign, KeyUnit& unit) {
    KeyUnit base;
    if (takes('(')) {
      product(1, base);
      if (!takes(')')) fail();
    } else {
      base = word();
    }
    int power = sign;
    if (takes('^')) {
      if (rest_.empty() || std::isdigit(static_cast<unsigned char>(rest_.front())) == 0) fail();
      power *= rest_.front() - '0';
      rest_.remove_prefix(1);
    }
    unit.dimension.length += power * base.dimension.length;
    unit.dimension.time += power * base.dimension.time;
    unit.dimension.mass += power * base.dimension.mass;
    unit.factor *= std::pow(base.factor, power);
  }
  KeyUnit word() {
    if (takes('1')) return {};
    std::size_t n = 0;
    while (n < rest_.size() && std::isalpha(static_cast<unsigned char>(rest_[n])) != 0) ++n;
    const auto name = rest_.substr(0, n);
    rest_.remove_prefix(n);
    if (name == "degrees") return {.factor = 180 / std::numbers::pi};
    for (const auto& known : named)
      if (name == known.name) return {.dimension = known.dimension};
    fail();
  }

  std::string_view all_, rest_;
};

std::string product_of(std::array<std::pair<const char*, int>, 3> factors, int sign, int& count) {
  std::string text;
  count = 0;
  for (const auto& [name, power] : factors) {
    if (power * sign <= 0) continue;
    if (count++ > 0) text += ' ';
    text += power * sign > 1 ? fmt::format("{}^{}", name, power * sign) : name;
  }
  return text;
}

std::string quotient(std::array<std::pair<const char*, int>, 3> factors) {
  int n_above = 0, n_below = 0;
  const auto above = product_of(factors, 1, n_above), below = product_of(factors, -1, n_below);
  if (n_below == 0) return n_above == 0 ? "1" : above;
  return fmt::format(fmt::runtime(n_below > 1 ? "{}/({})" : "{}/{}"), n_above == 0 ? "1" : above, below);
}

}  // namespace

double UnitScales::of(Dimension dimension) const {
  return std::pow(length, dimension.length) * std::pow(time, dimension.time) * std::pow(mass, dimension.mass);
}

std::optional<KeyUnit> parse_key_unit(std::string_view text) {
  if (text.empty() || text == "steps" || text == "grid spacings" || text == "diameters" || text == "of the values") return std::nullopt;
  if (text == "minutes") return KeyUnit{{0, 1, 0}, 1.0 / 60, true};
  return UnitParser(text).parse();
}

std::string si_unit(Dimension d) { return quotient({{{"kg", d.mass}, {"m", d.length}, {"s", d.time}}}); }

std::string describe(Dimension d) {
  if (d == Dimension{}) return "a pure number";
  for (const auto& known : named)
    if (known.dimension == d) {
      return fmt::format("{} {}", std::string_view("aeiou").find(known.name[0]) < 5 ? "an" : "a", known.name);
    }
  return quotient({{{"mass", d.mass}, {"length", d.length}, {"time", d.time}}});
}

}  // namespace pliant
