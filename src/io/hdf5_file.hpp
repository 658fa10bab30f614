#pragma once
#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

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

/// Where an HDF5 file takes shape.
enum class Backing {
  memory,  ///< handed to the system in one piece by close(), so that no failure of the disk can happen in the library
  disk     ///< for data sets that others fill in later, see Hdf5File::reserve
};

/// An HDF5 file that one process is writing. Data sets are row-major, the last dimension running fastest.
/// Every failure is a RunError with the file's name and the library's or the system's reason.
class Hdf5File {
 public:
  using Shape = std::vector<hsize_t>;

  Hdf5File(std::filesystem::path path, Backing backing);

  void write(const std::string& name, std::span<const double> values, const Shape& shape);
  void write(const std::string& name, std::span<const std::int32_t> values, const Shape& shape);
  /// A number or a text at the root of the file.
  void write_attribute(const std::string& name, double value);
  void write_attribute(const std::string& name, std::int64_t value);
  void write_attribute(const std::string& name, const std::string& value);

  /// Makes a data set of `Real` (float, double or int32) without contents, in one piece on the disk. Returns its place: the
  /// offset in bytes from the start of the file, at which anyone may write the values once the file is closed.
  template <class Real>
  std::uint64_t reserve(const std::string& name, const Shape& shape);

  /// Finishes the file. A file that goes away without it is not complete.
  void close();

 private:
  Hdf5Id make_set(const std::string& name, hid_t type, const Shape& shape);
  void write_set(const std::string& name, hid_t type, const void* values, const Shape& shape);
  void write_scalar(const std::string& name, hid_t type, const void* value);
  void check(bool good, const char* action, const std::string& what) const;
  void write_image();

  std::filesystem::path path_;
  Backing backing_;
  Hdf5Id file_;
};

}  // namespace pliant
