#include "io/hdf5_file.hpp"

#include <fmt/format.h>

#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "io/posix_file.hpp"

namespace pliant {
namespace {

// The innermost entry of HDF5's error stack says what happened, the outer ones where.
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

Hdf5File::Hdf5File(std::filesystem::path path, Backing backing) : path_(std::move(path)), backing_(backing) {
  // Errors become exceptions; the library need not print them as well.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Hdf5Id settings(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  bool good = settings.is_open();
  constexpr std::size_t growth = 1 << 20;  // bytes
  if (backing_ == Backing::memory) good = good && H5Pset_fapl_core(settings.get(), growth, false) >= 0;
  check(good, "prepare", path_.string());
  file_ = Hdf5Id(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, settings.get()), H5Fclose);
  check(file_.is_open(), "create", path_.string());
}

void Hdf5File::check(bool good, const char* action, const std::string& what) const {
  if (!good) throw RunError(fmt::format("cannot {} {}: {}", action, what, library_message()));
}

Hdf5Id Hdf5File::make_set(const std::string& name, hid_t type, const Shape& shape) {
  const auto what = fmt::format("{} in {}", name, path_.string());
  Hdf5Id space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  Hdf5Id creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  // The place has to be known at once, and is not to be filled with zeros first.
  const bool good = space.is_open() && creation.is_open() &&
                    H5Pset_alloc_time(creation.get(), H5D_ALLOC_TIME_EARLY) >= 0 &&
                    H5Pset_fill_time(creation.get(), H5D_FILL_TIME_NEVER) >= 0 &&
                    // The same contents make the same bytes, whenever they are written.
                    H5Pset_obj_track_times(creation.get(), false) >= 0;
  check(good, "prepare", what);
  Hdf5Id set(H5Dcreate2(file_.get(), name.c_str(), type, space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
             H5Dclose);
  check(set.is_open(), "create", what);
  return set;
}

void Hdf5File::write_set(const std::string& name, hid_t type, const void* values, const Shape& shape) {
  const auto set = make_set(name, type, shape);
  check(H5Dwrite(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0, "write",
        fmt::format("{} in {}", name, path_.string()));
}

void Hdf5File::write(const std::string& name, std::span<const double> values, const Shape& shape) {
  write_set(name, H5T_NATIVE_DOUBLE, values.data(), shape);
}

void Hdf5File::write(const std::string& name, std::span<const std::int32_t> values, const Shape& shape) {
  write_set(name, H5T_NATIVE_INT32, values.data(), shape);
}

template <class Real>
std::uint64_t Hdf5File::reserve(const std::string& name, const Shape& shape) {
  static_assert(std::is_same_v<Real, float> || std::is_same_v<Real, double> || std::is_same_v<Real, std::int32_t>);
  const hid_t type = std::is_same_v<Real, float>    ? H5T_NATIVE_FLOAT
                     : std::is_same_v<Real, double> ? H5T_NATIVE_DOUBLE
                                                    : H5T_NATIVE_INT32;
  const auto set = make_set(name, type, shape);
  const auto place = H5Dget_offset(set.get());
  check(place != HADDR_UNDEF, "place", fmt::format("{} in {}", name, path_.string()));
  return place;
}
template std::uint64_t Hdf5File::reserve<float>(const std::string&, const Shape&);
template std::uint64_t Hdf5File::reserve<double>(const std::string&, const Shape&);
template std::uint64_t Hdf5File::reserve<std::int32_t>(const std::string&, const Shape&);

void Hdf5File::write_scalar(const std::string& name, hid_t type, const void* value) {
  Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  Hdf5Id attribute;
  if (space.is_open())
    attribute = Hdf5Id(H5Acreate2(file_.get(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(attribute.is_open() && H5Awrite(attribute.get(), type, value) >= 0, "write",
        fmt::format("attribute {} in {}", name, path_.string()));
}

void Hdf5File::write_attribute(const std::string& name, double value) { write_scalar(name, H5T_NATIVE_DOUBLE, &value); }
void Hdf5File::write_attribute(const std::string& name, std::int64_t value) {
  write_scalar(name, H5T_NATIVE_INT64, &value);
}

void Hdf5File::write_attribute(const std::string& name, const std::string& value) {
  Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  check(type.is_open() && H5Tset_size(type.get(), value.size() + 1) >= 0 && H5Tset_cset(type.get(), H5T_CSET_UTF8) >= 0,
        "prepare", name);
  write_scalar(name, type.get(), value.c_str());
}

void Hdf5File::close() {
  if (backing_ == Backing::memory) write_image();
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
