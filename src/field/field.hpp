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

/// What kernels take, by value: element (i, j, k) with i, j, k from -1 (ghosts) to n.
template <class Location, class Value = double>
struct View {
  Value* origin = nullptr;
  std::ptrdiff_t row = 0;    ///< elements from j to j + 1
  std::ptrdiff_t plane = 0;  ///< elements from k to k + 1

  Value& operator()(int i, int j, int k) const { return origin[i + j * row + k * plane]; }
  Value* at_row(int j, int k) const { return origin + j * row + k * plane; }
  operator View<Location, const double>() const requires(!std::is_const_v<Value>) { return {origin, row, plane}; }
};
template <class Location>
using ConstView = View<Location, const double>;

/// Owner of the memory of one quantity on this rank's slab with one layer of ghosts, zero at start.
/// Rows and planes begin on 64-byte lines; element (0, 0, k) too, so that planes can be transformed in place.
template <class Location>
class Field {
 public:
  explicit Field(const Grid& grid);

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
  struct Free {
    void operator()(double* memory) const;
  };
  int nx_ = 0, ny_ = 0, nz_ = 0;
  std::ptrdiff_t row_ = 0, plane_ = 0;
  std::size_t bytes_ = 0;
  std::unique_ptr<double[], Free> memory_;
  double* origin_ = nullptr;
};

}  // namespace pliant
