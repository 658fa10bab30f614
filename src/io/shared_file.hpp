#pragma once
#include <cstdint>
#include <filesystem>
#include <span>

#include "parallel/communicator.hpp"

namespace pliant {

/// A file that all ranks write into at the same time, each in its own places, through MPI-IO. All functions are
/// collective, and a failure on one rank is a CollectiveError on all.
///
/// HDF5's own parallel driver is not used for this: in version 1.10 a disk that fills up leaves it in a state in which
/// the end of the program crashes.
class SharedFile {
 public:
  /// Opens a file that exists.
  SharedFile(const std::filesystem::path& path, const Communicator& ranks);
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  /// Writes this rank's values, whole rows of `row_bytes`, from the place `offset` (bytes from the start) on.
  template <class Real>
  void write(std::uint64_t offset, std::span<const Real> values, std::size_t row_bytes) {
    write_rows(offset, values.data(), values.size_bytes() / row_bytes, row_bytes);
  }
  /// Brings what this rank has written to the disk, or at least to where all ranks see it.
  void sync();
  void close();

 private:
  void write_rows(std::uint64_t offset, const void* values, std::size_t n_rows, std::size_t row_bytes);
  void check(int code, const char* action) const;

  std::filesystem::path path_;
  Communicator ranks_;
  MPI_File file_ = MPI_FILE_NULL;
};

/// Sets aside the disk space of a file of `bytes`, so that a full disk is noticed before anything is written; the file
/// is made if it is not there and keeps its contents. Does nothing on file systems that cannot. Throws RunError.
void set_space_aside(const std::filesystem::path& path, std::uint64_t bytes);

}  // namespace pliant
