#include "io/csv_writer.hpp"

#include <fmt/format.h>

#include <stdexcept>

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

}  // namespace

CsvWriter::CsvWriter(std::filesystem::path path, std::vector<std::string> columns)
    : file_(std::move(path)), n_columns_(columns.size()) {
  file_.append(join(columns));
}

void CsvWriter::write_row(const std::vector<double>& values) {
  if (values.size() != n_columns_) throw std::logic_error("a CSV row needs one value a column");
  std::vector<std::string> cells;
  // The shortest digits that read back as the same double.
  for (const double value : values) cells.push_back(fmt::to_string(value));
  file_.append(join(cells));
}

}  // namespace pliant
