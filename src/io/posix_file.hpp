#pragma once
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace pliant {

/// A file open for writing through the system's own calls, every return code checked: a disk that is full shows up in
/// the write or in the close, as a RunError that names the file.
class PosixFile {
 public:
  /// Creates the file, or empties the one that is there.
  explicit PosixFile(std::filesystem::path path);
  /// Opens a file that is there and cuts it back to its first `size` bytes; appends go behind them. Throws RunError
  /// if it is not there or has fewer.
  PosixFile(std::filesystem::path path, std::int64_t size);
  ~PosixFile();
  PosixFile(const PosixFile&) = delete;
  PosixFile& operator=(const PosixFile&) = delete;

  /// Appends all of the text, or, if that fails, cuts the file back to what it held before and throws.
  void append(std::string_view text);
  void close();
  std::int64_t size() const { return size_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
};

}  // namespace pliant
