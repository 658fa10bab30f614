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

template <class Location>
void Field<Location>::Free::operator()(double* memory) const {
  std::free(memory);
}

template <class Location>
Field<Location>::Field(const Grid& grid) : nx_(grid.nx()), ny_(grid.ny()), nz_(grid.nz()) {
  // One line ahead of i = 0 holds the ghost -1; behind come the ghost n and the second half of the last complex mode.
  row_ = line + round_up(nx_ + 2);
  plane_ = row_ * (ny_ + 2);
  const auto count = static_cast<std::size_t>(plane_ * (nz_ + 2));
  bytes_ = count * sizeof(double);
  auto* memory = static_cast<double*>(std::aligned_alloc(64, bytes_));
  if (memory == nullptr) throw std::bad_alloc();
  memory_.reset(memory);
  ask_for_large_pages(memory, bytes_);
  std::fill_n(memory, count, 0.0);
  origin_ = memory + plane_ + row_ + line;
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
