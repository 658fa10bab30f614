#pragma once
#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "parallel/communicator.hpp"

namespace pliant {

/// Owner of an HDF5 identifier of any kind; closes it when it goes.
class Hdf5Id {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Id() = default;
  Hdf5Id(hid_t id, Close close) : id_(id), close_(close) {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_(other.release()), close_(other.close_) {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept;
  ~Hdf5Id();

  hid_t get() const { return id_; }
  bool is_open() const { return id_ >= 0; }
  hid_t release();

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Which rows of a data set a rank holds: `begin` is the first index in the slowest dimension.
struct Hdf5Rows {
  hsize_t begin = 0;
  hsize_t count = 0;
};

/// An HDF5 file that is being written. Data sets are row-major, the last dimension running fastest.
///
/// Shared: all ranks write parts of one file through MPI-IO; every call is collective, and if a call fails on one rank
/// it throws on all. Local: the caller alone writes; the file is built in memory and handed to the system in one piece,
/// so that no failure of the disk can happen inside the library. Every failure is a RunError with the file's name.
class Hdf5File {
 public:
  static Hdf5File create_shared(const std::filesystem::path& path, const Communicator& ranks);
  static Hdf5File create_local(const std::filesystem::path& path);
  Hdf5File(Hdf5File&&) noexcept = default;
  Hdf5File& operator=(Hdf5File&&) noexcept = default;

  /// Writes this rank's rows of a data set of global extent `shape`. Empty on a rank means it holds none.
  void write_rows(const std::string& name, std::span<const float> values, std::vector<hsize_t> shape, Hdf5Rows rows);
  void write_rows(const std::string& name, std::span<const double> values, std::vector<hsize_t> shape, Hdf5Rows rows);
  /// Writes a data set that every rank holds whole.
  void write(const std::string& name, std::span<const double> values, std::vector<hsize_t> shape);
  void write(const std::string& name, std::span<const std::int32_t> values, std::vector<hsize_t> shape);
  /// A number or a text at the root of the file.
  void write_attribute(const std::string& name, double value);
  void write_attribute(const std::string& name, std::int64_t value);
  void write_attribute(const std::string& name, const std::string& value);

  /// Finishes the file. A file that goes away without it is not complete.
  void close();

 private:
  enum class Access { shared, local };
  Hdf5File(std::filesystem::path path, Access access, const Communicator& ranks);
  void write_block(const std::string& name, const void* values, hid_t type, const std::vector<hsize_t>& shape,
                   Hdf5Rows rows);
  void write_scalar(const std::string& name, const void* value, hid_t type);
  /// Throws if this call failed here or, for a shared file, on any rank.
  void check(bool good, const char* action, const std::string& what) const;
  void write_image();

  std::filesystem::path path_;
  Access access_;
  Communicator ranks_;
  Hdf5Id file_;
};

}  // namespace pliant
