#include "io/hdf5_file.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/error.hpp"
#include "io/agree.hpp"
#include "io/posix_file.hpp"

namespace pliant {
namespace {

// The innermost entries of HDF5's error stack say what happened; the outer ones where.
herr_t keep_innermost(unsigned depth, const H5E_error2_t* entry, void* text) {
  if (depth == 0 && entry->desc) *static_cast<std::string*>(text) = entry->desc;
  return 0;
}

std::string library_message() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &text);
  H5Eclear2(H5E_DEFAULT);
  return text.empty() ? "no reason given by HDF5" : text;
}

void prepare_library() {
  // At exit MPI is gone already, and the library would try to write through it again after a full disk.
  H5dont_atexit();
  H5open();
  // Errors become exceptions; the library's own printing would come once a rank.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

}  // namespace

Hdf5Id& Hdf5Id::operator=(Hdf5Id&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

Hdf5Id::~Hdf5Id() {
  if (id_ >= 0) close_(id_);
}

hid_t Hdf5Id::release() { return std::exchange(id_, -1); }

Hdf5File Hdf5File::create_shared(const std::filesystem::path& path, const Communicator& ranks) {
  return {path, Access::shared, ranks};
}
Hdf5File Hdf5File::create_local(const std::filesystem::path& path) {
  return {path, Access::local, Communicator(MPI_COMM_SELF)};
}

Hdf5File::Hdf5File(std::filesystem::path path, Access access, const Communicator& ranks)
    : path_(std::move(path)), access_(access), ranks_(ranks) {
  prepare_library();
  Hdf5Id settings(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  bool good = settings.is_open();
  if (access_ == Access::shared) {
    good = good && H5Pset_fapl_mpio(settings.get(), ranks_.handle(), MPI_INFO_NULL) >= 0 &&
           H5Pset_coll_metadata_write(settings.get(), true) >= 0;
  } else {
    constexpr std::size_t growth = 1 << 20;  // bytes
    good = good && H5Pset_fapl_core(settings.get(), growth, false) >= 0;
  }
  check(good, "prepare", path_.string());
  file_ = Hdf5Id(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, settings.get()), H5Fclose);
  check(file_.is_open(), "create", path_.string());
}

void Hdf5File::check(bool good, const char* action, const std::string& what) const {
  std::string problem;
  if (!good) problem = fmt::format("cannot {} {}: {}", action, what, library_message());
  if (access_ == Access::shared) agree(ranks_, problem);
  else if (!problem.empty()) throw RunError(problem);
}

void Hdf5File::write_block(const std::string& name, const void* values, hid_t type, const std::vector<hsize_t>& shape,
                           Hdf5Rows rows) {
  const auto what = fmt::format("{} in {}", name, path_.string());
  const int rank = static_cast<int>(shape.size());
  auto start = std::vector<hsize_t>(shape.size(), 0);
  auto count = shape;
  start[0] = rows.begin;
  count[0] = rows.count;

  Hdf5Id creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  // The data follow at once: filling the space with zeros first would write everything twice.
  bool good = creation.is_open() && H5Pset_fill_time(creation.get(), H5D_FILL_TIME_NEVER) >= 0;
  Hdf5Id file_space(H5Screate_simple(rank, shape.data(), nullptr), H5Sclose);
  Hdf5Id memory_space(H5Screate_simple(rank, count.data(), nullptr), H5Sclose);
  Hdf5Id transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  good = good && file_space.is_open() && memory_space.is_open() && transfer.is_open();
  if (access_ == Access::shared) good = good && H5Pset_dxpl_mpio(transfer.get(), H5FD_MPIO_COLLECTIVE) >= 0;
  if (rows.count == 0) good = good && H5Sselect_none(file_space.get()) >= 0 && H5Sselect_none(memory_space.get()) >= 0;
  else
    good = good &&
           H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >= 0;
  check(good, "prepare", what);

  Hdf5Id set(H5Dcreate2(file_.get(), name.c_str(), type, file_space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
             H5Dclose);
  check(set.is_open(), "create", what);
  check(H5Dwrite(set.get(), type, memory_space.get(), file_space.get(), transfer.get(), values) >= 0, "write", what);
  check(H5Dclose(set.release()) >= 0, "finish writing", what);
}

void Hdf5File::write_rows(const std::string& name, std::span<const float> values, std::vector<hsize_t> shape,
                          Hdf5Rows rows) {
  write_block(name, values.data(), H5T_NATIVE_FLOAT, shape, rows);
}

void Hdf5File::write_rows(const std::string& name, std::span<const double> values, std::vector<hsize_t> shape,
                          Hdf5Rows rows) {
  write_block(name, values.data(), H5T_NATIVE_DOUBLE, shape, rows);
}

void Hdf5File::write(const std::string& name, std::span<const double> values, std::vector<hsize_t> shape) {
  write_block(name, values.data(), H5T_NATIVE_DOUBLE, shape, {0, ranks_.is_root() ? shape[0] : 0});
}

void Hdf5File::write(const std::string& name, std::span<const std::int32_t> values, std::vector<hsize_t> shape) {
  write_block(name, values.data(), H5T_NATIVE_INT32, shape, {0, ranks_.is_root() ? shape[0] : 0});
}

void Hdf5File::write_scalar(const std::string& name, const void* value, hid_t type) {
  Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  Hdf5Id attribute;
  if (space.is_open())
    attribute = Hdf5Id(H5Acreate2(file_.get(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(attribute.is_open() && H5Awrite(attribute.get(), type, value) >= 0, "write",
        fmt::format("attribute {} in {}", name, path_.string()));
}

void Hdf5File::write_attribute(const std::string& name, double value) { write_scalar(name, &value, H5T_NATIVE_DOUBLE); }
void Hdf5File::write_attribute(const std::string& name, std::int64_t value) {
  write_scalar(name, &value, H5T_NATIVE_INT64);
}

void Hdf5File::write_attribute(const std::string& name, const std::string& value) {
  Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  check(type.is_open() && H5Tset_size(type.get(), value.size() + 1) >= 0 && H5Tset_cset(type.get(), H5T_CSET_UTF8) >= 0,
        "prepare", name);
  write_scalar(name, value.c_str(), type.get());
}

void Hdf5File::close() {
  if (access_ == Access::local) write_image();
  check(H5Fclose(file_.release()) >= 0, "finish writing", path_.string());
}

void Hdf5File::write_image() {
  check(H5Fflush(file_.get(), H5F_SCOPE_LOCAL) >= 0, "finish", path_.string());
  const auto size = H5Fget_file_image(file_.get(), nullptr, 0);
  check(size > 0, "finish", path_.string());
  std::string image(static_cast<std::size_t>(size), '\0');
  check(H5Fget_file_image(file_.get(), image.data(), image.size()) == size, "finish", path_.string());
  PosixFile file(path_);
  file.append(image);
  file.close();
}

}  // namespace pliant
