#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "io/posix_file.hpp"

namespace pliant {

/// A table that grows line by line. Every line reaches the system in one piece before `write_row` returns, so that a
/// run that is killed leaves whole lines. Not collective: the root alone has one.
class CsvWriter {
 public:
  /// Starts the file with a line of column names. Throws RunError if the file cannot be written.
  CsvWriter(std::filesystem::path path, std::vector<std::string> columns);

  /// Continues the table that is there from its first `size` bytes on; what follows them is cut off. Throws RunError if
  /// it cannot be, or begins with other columns.
  CsvWriter(std::filesystem::path path, std::vector<std::string> columns, std::int64_t size);

  /// One value a column, in the order of the names, each with the fewest digits that read back as the same double;
  /// "nan" and "inf" where there is no number. Throws RunError.
  void write_row(const std::vector<double>& values);
  const std::filesystem::path& path() const { return file_.path(); }
  /// Bytes so far: whole lines.
  std::int64_t size() const { return file_.size(); }

 private:
  PosixFile file_;
  std::size_t n_columns_;
};

}  // namespace pliant
