#include "transfer/reached_rows.hpp"

#include <algorithm>

namespace pliant {
namespace {

constexpr int most_segments = 64, line = 8;  // nodes in a cache line

int width_for(int nx) {
  const int behind_first = most_segments - 1;
  const int lines = (nx + 1 + line - 1) / line;
  return line * ((lines + behind_first - 1) / behind_first);
}

}  // namespace

ReachedRows::ReachedRows(const Grid& grid)
    : grid_(grid),
      width_(width_for(grid.nx())),
      segments_(static_cast<std::size_t>(grid.ny() + 2) * static_cast<std::size_t>(grid.nz() + 2), 0) {}

void ReachedRows::clear() { std::fill(segments_.begin(), segments_.end(), 0); }

std::uint64_t ReachedRows::mask_of(int i_first, int i_last) const {
  const int first = segment_of(i_first), last = segment_of(i_last);
  return (~std::uint64_t{0} >> (most_segments - 1 - (last - first))) << first;
}

void ReachedRows::include(const Markers& markers) {
  for (const auto& [lowest, highest] : markers.reaches()) {
    const std::uint64_t mask = mask_of(lowest[0], highest[0]);
    for (int plane = lowest[2]; plane <= highest[2]; ++plane)
      for (std::size_t row = at(lowest[1], plane); row <= at(highest[1], plane); ++row) segments_[row] |= mask;
  }
}

void ReachedRows::include_plane(int k) {
  std::fill_n(segments_.begin() + static_cast<std::ptrdiff_t>(at(-1, k)), grid_.ny() + 2, mask_of(-1, grid_.nx()));
}

PlaneRegion ReachedRows::ghosts(int k) const {
  const int nx = grid_.nx(), ny = grid_.ny();
  PlaneRegion region{nx + 1, -1, ny + 1, -1};
  for (int j = -1; j <= ny; ++j) {
    const bool has_ends = holds(-1, j, k) || holds(nx, j, k), is_ghost = j == -1 || j == ny;
    if (is_empty(j, k) || !(has_ends || is_ghost)) continue;
    region.j_begin = std::min(region.j_begin, j), region.j_end = j + 1;
    for_each_part(j, k, [&](int begin, int end) {
      region.i_begin = std::min(region.i_begin, begin), region.i_end = std::max(region.i_end, end);
    });
  }
  return region;
}

void ReachedRows::include_origins_of_ghosts() {
  const int nx = grid_.nx(), ny = grid_.ny();
  if (grid_.is_periodic(0)) {
    const std::uint64_t lower = mask_of(-1, -1), upper = mask_of(nx, nx);
    const std::uint64_t first = mask_of(0, 0), last = mask_of(nx - 1, nx - 1);
    for (auto& row : segments_) row |= ((row & lower) != 0 ? last : 0) | ((row & upper) != 0 ? first : 0);
  }
  if (grid_.is_periodic(1))
    for (int k = -1; k <= grid_.nz(); ++k) {
      segments_[at(ny - 1, k)] |= segments_[at(-1, k)];
      segments_[at(0, k)] |= segments_[at(ny, k)];
    }
}

}  // namespace pliant
