#include "structure/positions_file.hpp"

#include <fmt/format.h>

#include <algorithm>
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
constexpr const char* column_names[] = {"x", "y", "z", "ax", "ay", "az", "angle"};
constexpr std::size_t n_columns = 7, most_problems = 20;
constexpr auto expected = "x, y, z or x, y, z, ax, ay, az, angle";

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const auto end = std::min(line.find(',', begin), line.size());
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return fields;
}

std::optional<double> to_number(const std::string& text) {
  const char* begin = text.data() + (text.rfind('+', 0) == 0 ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

class PositionsReader {
 public:
  explicit PositionsReader(const std::filesystem::path& path) : path_(path) {
    for (std::size_t c = 0; c < n_columns; ++c) columns_.push_back(c);
  }

  std::vector<Placement> read() {
    errno = 0;
    std::ifstream input(path_);
    if (!input || std::filesystem::is_directory(path_))
      throw InputError(fmt::format("{}: the positions cannot be read ({}); check the path", path_.string(),
                                   errno ? std::strerror(errno) : "it is a folder"));
    std::string line;
    while (std::getline(input, line)) {
      ++line_;
      line = trimmed(line);
      if (!line.empty() && line[0] != '#') take(split(line));
    }
    if (input.bad()) complain("the file cannot be read to its end");
    if (placements_.empty() && n_problems_ == 0)
      throw InputError(fmt::format("{}: there is no position in it; give lines of {}", path_.string(), expected));
    if (n_problems_ > most_problems)
      problems_.push_back(fmt::format("{}: and {} more problems", path_.string(), n_problems_ - most_problems));
    if (n_problems_ > 0) throw InputError(std::move(problems_));
    return std::move(placements_);
  }

 private:
  void complain(const std::string& what) {
    if (++n_problems_ <= most_problems) problems_.push_back(fmt::format("{}:{}: {}", path_.string(), line_, what));
  }

  void take(const std::vector<std::string>& fields) {
    const bool first = std::exchange(is_first_, false);
    if (first && !to_number(fields[0])) return take_names(fields);
    const std::size_t wanted = has_names_ ? columns_.size() : fields.size();
    if (fields.size() != wanted || (wanted != 3 && wanted != n_columns))
      return complain(fmt::format("the line has {} values; give {}", fields.size(), expected));
    double values[n_columns] = {0, 0, 0, 0, 0, 1, 0};
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto number = to_number(fields[i]);
      if (!number || !std::isfinite(*number))
        return complain(fmt::format("\"{}\" is not a finite number; give {}", fields[i], expected));
      values[columns_[i]] = *number;
    }
    const Vec3 axis{values[3], values[4], values[5]};
    if (!(norm(axis) > 0)) return complain("the axis ax, ay, az is 0; give the direction to turn about");
    placements_.push_back({{values[0], values[1], values[2]}, rotation_about(axis, values[6])});
  }

  void take_names(const std::vector<std::string>& fields) {
    has_names_ = true;
    columns_.clear();
    for (const auto& field : fields) {
      const auto found = std::find(std::begin(column_names), std::end(column_names), field);
      const auto column = static_cast<std::size_t>(found - std::begin(column_names));
      if (column == n_columns || std::count(columns_.begin(), columns_.end(), column) > 0)
        complain(fmt::format("unknown or repeated column \"{}\"; the columns are {}", field, expected));
      columns_.push_back(std::min(column, n_columns - 1));
    }
    if (columns_.size() != 3 && columns_.size() != n_columns)
      complain(fmt::format("there are {} columns; give {}", columns_.size(), expected));
    else if (columns_.size() == 3 && *std::max_element(columns_.begin(), columns_.end()) > 2)
      complain(fmt::format("three columns have to be x, y, z; give {}", expected));
  }

  std::filesystem::path path_;
  long line_ = 0;
  bool is_first_ = true, has_names_ = false;
  std::vector<std::size_t> columns_;  ///< which column of column_names each field is
  std::vector<Placement> placements_;
  std::vector<std::string> problems_;
  std::size_t n_problems_ = 0;
};
}  // namespace

std::vector<Placement> read_positions(const std::filesystem::path& path) { return PositionsReader(path).read(); }

}  // namespace pliant
