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
