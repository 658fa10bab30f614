#include "field/field.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <utility>

namespace pliant {
namespace {
constexpr std::ptrdiff_t line = 8;  // doubles in a cache line
std::ptrdiff_t round_up(std::ptrdiff_t n) { return (n + line - 1) / line * line; }
}  // namespace

void FreeMemory::operator()(double* memory) const { std::free(memory); }

AlignedDoubles allocate_aligned(std::size_t count) {
  const std::size_t bytes = (count * sizeof(double) + 63) / 64 * 64;
  AlignedDoubles memory(static_cast<double*>(std::aligned_alloc(64, bytes)));
  if (memory == nullptr) throw std::bad_alloc();
  std::fill_n(memory.get(), count, 0.0);
  return memory;
}

PlaneLayout::PlaneLayout(const Grid& grid)
    : row(line + round_up(grid.nx() + 2)), plane(row * (grid.ny() + 2)), origin(row + line) {}

template <class Location>
Field<Location>::Field(const Grid& grid, int planes_beyond) : nx_(grid.nx()), ny_(grid.ny()), nz_(grid.nz()) {
  const PlaneLayout layout(grid);
  row_ = layout.row;
  plane_ = layout.plane;
  const auto count = static_cast<std::size_t>(plane_ * (nz_ + 2 + planes_beyond));
  bytes_ = count * sizeof(double);
  memory_ = allocate_aligned(count);
  origin_ = memory_.get() + plane_ + layout.origin;
}

template <class Location>
void Field<Location>::swap(Field& other) noexcept {
  std::swap(memory_, other.memory_);
  std::swap(origin_, other.origin_);
}

template class Field<Center>;
template class Field<FaceX>;
template class Field<FaceY>;
template class Field<FaceZ>;

}  // namespace pliant
