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

  /// One value a column, in the order of the names, each with the fewest digits that read back as the same double;
  /// "nan" and "inf" where there is no number. Throws RunError.
  void write_row(const std::vector<double>& values);
  const std::filesystem::path& path() const { return file_.path(); }

 private:
  PosixFile file_;
  std::size_t n_columns_;
};

}  // namespace pliant
