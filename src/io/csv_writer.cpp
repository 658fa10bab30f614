#include "io/csv_writer.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include "core/error.hpp"

namespace pliant {
namespace {

std::string join(const std::vector<std::string>& cells) {
  std::string line;
  for (const auto& cell : cells) {
    if (!line.empty()) line += ',';
    line += cell;
  }
  return line + '\n';
}

// The path, once the file has been seen to begin with this line.
std::filesystem::path require_columns(std::filesystem::path path, const std::string& columns) {
  std::string line;
  std::getline(std::ifstream(path), line);
  if (line + '\n' != columns)
    throw RunError(fmt::format("{} does not begin with the columns {}", path.string(), columns));
  return path;
}

}  // namespace

CsvWriter::CsvWriter(std::filesystem::path path, std::vector<std::string> columns)
    : file_(std::move(path)), n_columns_(columns.size()) {
  file_.append(join(columns));
}

CsvWriter::CsvWriter(std::filesystem::path path, std::vector<std::string> columns, std::int64_t size)
    : file_(require_columns(std::move(path), join(columns)), size), n_columns_(columns.size()) {}

void CsvWriter::write_row(const std::vector<double>& values) {
  if (values.size() != n_columns_) throw std::logic_error("a CSV row needs one value a column");
  std::vector<std::string> cells;
  // The shortest digits that read back as the same double.
  for (const double value : values) cells.push_back(fmt::to_string(value));
  file_.append(join(cells));
}

}  // namespace pliant
