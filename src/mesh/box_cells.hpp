#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/vec3.hpp"

namespace pliant {

/// A box along the axes, corners included.
struct Box {
  Vec3 lower, upper;

  void widen(Vec3 x) {
    for (int d = 0; d < 3; ++d) {
      lower[d] = std::min(lower[d], x[d]);
      upper[d] = std::max(upper[d], x[d]);
    }
  }
  Box inflated(double margin) const {
    const Vec3 m{margin, margin, margin};
    return {lower - m, upper + m};
  }
  Box shifted(Vec3 by) const { return {lower + by, upper + by}; }
  bool meets(const Box& other) const {
    for (int d = 0; d < 3; ++d)
      if (lower[d] > other.upper[d] || other.lower[d] > upper[d]) return false;
    return true;
  }
};

/// The smallest box around some of the points, at least one.
template <class Corners>
Box box_around(const Corners& corners, std::span<const Vec3> positions) {
  Box box{positions[corners[0]], positions[corners[0]]};
  for (const int v : corners) box.widen(positions[v]);
  return box;
}
Box box_around(std::span<const Vec3> positions);

/// Boxes sorted into equal cells, so that those that meet another box are found without looking at all.
class BoxCells {
 public:
  /// `asked`: the size of the boxes that will be asked for.
  explicit BoxCells(std::vector<Box> boxes, double asked = 0);

  /// Calls visit(index) once for each box that meets `box`.
  template <class Visit>
  void for_each_meeting(const Box& box, Visit&& visit) const {
    if (boxes_.empty() || !box.meets(all_)) return;
    const auto first = cell_of(box.lower), last = cell_of(box.upper);
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) {
          const auto at = index_of({i, j, k});
          for (int n = begin_[at]; n < begin_[at + 1]; ++n) {
            const Box& other = boxes_[static_cast<std::size_t>(items_[static_cast<std::size_t>(n)])];
            if (!other.meets(box)) continue;
            // A pair that shares several cells belongs to the one with the lower corner of what they share.
            if (cell_along(0, std::max(box.lower.x, other.lower.x)) == i &&
                cell_along(1, std::max(box.lower.y, other.lower.y)) == j &&
                cell_along(2, std::max(box.lower.z, other.lower.z)) == k)
              visit(items_[static_cast<std::size_t>(n)]);
          }
        }
  }

 private:
  int cell_along(int d, double x) const {
    const double s = (x - all_.lower[d]) * cells_per_length_[d];
    const int n = n_[static_cast<std::size_t>(d)];
    return s >= n ? n - 1 : s > 0 ? static_cast<int>(s) : 0;
  }
  std::array<int, 3> cell_of(Vec3 x) const { return {cell_along(0, x.x), cell_along(1, x.y), cell_along(2, x.z)}; }
  std::size_t index_of(const std::array<int, 3>& cell) const {
    return (static_cast<std::size_t>(cell[2]) * static_cast<std::size_t>(n_[1]) + static_cast<std::size_t>(cell[1])) *
               static_cast<std::size_t>(n_[0]) +
           static_cast<std::size_t>(cell[0]);
  }

  std::vector<Box> boxes_;
  Box all_;
  std::array<int, 3> n_{1, 1, 1};
  Vec3 cells_per_length_;
  std::vector<int> begin_, items_;
};

}  // namespace pliant
