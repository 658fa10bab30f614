#pragma once
#include <cstddef>
#include <memory>
#include <type_traits>

#include "grid/grid.hpp"

namespace pliant {

/// Where a quantity lives on the staggered grid; part of a field's type, so that components cannot be swapped.
/// FaceX i lies between the centres i and i + 1, and so on.
struct Center {};
struct FaceX {};
struct FaceY {};
struct FaceZ {};

/// One x-y plane of a quantity as row kernels see it: element (i, j) with i, j from -1 to n.
template <class Location, class Value = double>
struct Plane {
  Value* origin = nullptr;
  std::ptrdiff_t row = 0;  ///< elements from j to j + 1

  Value* at_row(int j) const { return origin + j * row; }
  operator Plane<Location, const double>() const requires(!std::is_const_v<Value>) { return {origin, row}; }
};
template <class Location>
using ConstPlane = Plane<Location, const double>;

/// What kernels take, by value: element (i, j, k) with i, j, k from -1 (ghosts) to n.
template <class Location, class Value = double>
struct View {
  Value* origin = nullptr;
  std::ptrdiff_t row = 0;    ///< elements from j to j + 1
  std::ptrdiff_t plane = 0;  ///< elements from k to k + 1

  Value& operator()(int i, int j, int k) const { return origin[i + j * row + k * plane]; }
  Value* at_row(int j, int k) const { return origin + j * row + k * plane; }
  Plane<Location, Value> at_plane(int k) const { return {origin + k * plane, row}; }
  operator View<Location, const double>() const requires(!std::is_const_v<Value>) { return {origin, row, plane}; }
};
template <class Location>
using ConstView = View<Location, const double>;

struct FreeMemory {
  void operator()(double* memory) const;
};
using AlignedDoubles = std::unique_ptr<double[], FreeMemory>;
/// Zeroed memory that begins on a 64-byte line. Throws std::bad_alloc.
AlignedDoubles allocate_aligned(std::size_t count);

/// How planes of a grid lie in memory: one line of 8 doubles ahead of i = 0 holds the ghost -1; behind come the ghost n
/// and the second half of the last complex mode.
struct PlaneLayout {
  explicit PlaneLayout(const Grid& grid);
  std::ptrdiff_t row, plane;  ///< doubles from row to row and from plane to plane, ghost rows counted
  std::ptrdiff_t origin;      ///< of element (0, 0) in its plane
};

/// Owner of the memory of one quantity on this rank's slab with one layer of ghosts, zero at start.
/// Rows and planes begin on 64-byte lines; element (0, 0, k) too, so that planes can be transformed in place.
template <class Location>
class Field {
 public:
  /// `planes_beyond`: planes above the upper ghost plane.
  explicit Field(const Grid& grid, int planes_beyond = 0);

  View<Location> view() { return {origin_, row_, plane_}; }
  ConstView<Location> view() const { return {origin_, row_, plane_}; }
  std::ptrdiff_t row() const { return row_; }
  std::ptrdiff_t plane() const { return plane_; }
  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int nz() const { return nz_; }
  std::size_t bytes() const { return bytes_; }
  /// Exchanges the memory of two fields of one grid.
  void swap(Field& other) noexcept;

 private:
  int nx_ = 0, ny_ = 0, nz_ = 0;
  std::ptrdiff_t row_ = 0, plane_ = 0;
  std::size_t bytes_ = 0;
  AlignedDoubles memory_;
  double* origin_ = nullptr;
};

}  // namespace pliant
