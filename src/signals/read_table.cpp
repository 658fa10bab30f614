#include "signals/read_table.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <utility>

#include "core/error.hpp"

namespace pliant {
namespace {
/// More lines than these are not told one by one.
constexpr std::size_t most_problems = 10;

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::string field;
  for (const char c : line.substr(0, line.find('#'))) {
    const bool separates = c == ',' || c == ';' || c == ' ' || c == '\t' || c == '\r';
    if (!separates) field += c;
    else if (!field.empty()) fields.push_back(std::exchange(field, {}));
  }
  if (!field.empty()) fields.push_back(field);
  return fields;
}

std::optional<double> number_in(const std::string& text) {
  const char* begin = text.data() + (text.front() == '+' ? 1 : 0);
  const char* end = text.data() + text.size();
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}
}  // namespace

std::vector<std::array<double, 2>> read_table(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw InputError(fmt::format("{}: cannot be opened ({})", file.string(), std::strerror(errno)));
  std::vector<std::array<double, 2>> points;
  std::vector<std::string> problems;
  const auto complain = [&](long line, const std::string& what) {
    if (problems.size() < most_problems) problems.push_back(fmt::format("{}:{}: {}", file.string(), line, what));
  };
  std::string line;
  bool may_be_names = true;
  for (long number = 1; std::getline(stream, line); ++number) {
    const auto fields = fields_of(line);
    if (fields.empty()) continue;
    const bool names = std::exchange(may_be_names, false) && !number_in(fields[0]);
    if (names) continue;
    const auto t = number_in(fields[0]), v = fields.size() == 2 ? number_in(fields[1]) : std::nullopt;
    if (!t || !v) complain(number, fmt::format("\"{}\" is not a line of two numbers, time and value", line));
    else if (!points.empty() && *t <= points.back()[0])
      complain(number, fmt::format("the time {} is not greater than that before it, {}", *t, points.back()[0]));
    else points.push_back({*t, *v});
  }
  if (stream.bad()) complain(0, "cannot be read");
  if (points.empty() && problems.empty()) problems.push_back(fmt::format("{}: has no line of numbers", file.string()));
  if (!problems.empty()) throw InputError(std::move(problems));
  return points;
}

}  // namespace pliant
