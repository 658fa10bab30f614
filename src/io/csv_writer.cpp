#include "io/csv_writer.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace pliant {

CsvWriter::CsvWriter(std::filesystem::path path, std::vector<std::string> columns)
    : file_(std::move(path)), n_columns_(columns.size()) {
  file_.append(fmt::format("{}\n", fmt::join(columns, ",")));
}

void CsvWriter::write_row(const std::vector<double>& values) {
  if (values.size() != n_columns_) throw std::logic_error("a CSV row needs one value a column");
  std::string line;
  for (const double value : values) {
    if (!line.empty()) line += ',';
    // The shortest digits that read back as the same double.
    line += fmt::to_string(value);
  }
  file_.append(line + '\n');
}

}  // namespace pliant
