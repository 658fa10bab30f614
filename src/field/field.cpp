#include "field/field.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <utility>

namespace pliant {
namespace {
constexpr std::ptrdiff_t line = 8;  // doubles in a cache line
std::ptrdiff_t round_up(std::ptrdiff_t n) { return (n + line - 1) / line * line; }

// Markers read rows here and there, and an entry of the page table for every few of them would be as far away as they
// are. A wish: where large pages are not to be had, nothing changes.
void ask_for_large_pages(double* memory, std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) / page * page;
  const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / page * page;
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#else
  static_cast<void>(memory), static_cast<void>(bytes);
#endif
}
}  // namespace

void FreeMemory::operator()(double* memory) const { std::free(memory); }

AlignedDoubles allocate_aligned(std::size_t count) {
  const std::size_t bytes = (count * sizeof(double) + 63) / 64 * 64;
  AlignedDoubles memory(static_cast<double*>(std::aligned_alloc(64, bytes)));
  if (memory == nullptr) throw std::bad_alloc();
  ask_for_large_pages(memory.get(), bytes);
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
