#include "mesh/box_cells.hpp"

#include <cmath>

namespace pliant {

Box box_around(std::span<const Vec3> positions) {
  Box box{positions[0], positions[0]};
  for (const Vec3 x : positions) box.widen(x);
  return box;
}

BoxCells::BoxCells(std::vector<Box> boxes, double asked) : boxes_(std::move(boxes)) {
  if (boxes_.empty()) return;
  all_ = boxes_[0];
  double mean = 0;
  for (const Box& box : boxes_) {
    all_.widen(box.lower);
    all_.widen(box.upper);
    const Vec3 size = box.upper - box.lower;
    mean += std::max({size.x, size.y, size.z}) / static_cast<double>(boxes_.size());
  }
  // Cells of the mean size, or of half of what is asked for, but not many more of them than boxes.
  const Vec3 size = all_.upper - all_.lower;
  const double longest = std::max({size.x, size.y, size.z});
  double cell = std::max({mean, 0.5 * asked, 1e-3 * longest});
  const auto count = [&](int d) { return std::max(1.0, std::floor(size[d] / cell)); };
  const double most = 64.0 + 8.0 * static_cast<double>(boxes_.size());
  if (cell > 0)
    while (count(0) * count(1) * count(2) > most) cell *= 1.26;
  for (int d = 0; d < 3; ++d) {
    n_[static_cast<std::size_t>(d)] = cell > 0 ? static_cast<int>(count(d)) : 1;
    cells_per_length_[d] = size[d] > 0 ? n_[static_cast<std::size_t>(d)] / size[d] : 0.0;
  }

  const auto for_each_cell = [&](const Box& box, auto&& visit) {
    const auto first = cell_of(box.lower), last = cell_of(box.upper);
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) visit(index_of({i, j, k}));
  };
  begin_.assign(index_of({n_[0] - 1, n_[1] - 1, n_[2] - 1}) + 2, 0);
  for (const Box& box : boxes_) for_each_cell(box, [&](std::size_t at) { ++begin_[at + 1]; });
  for (std::size_t at = 1; at < begin_.size(); ++at) begin_[at] += begin_[at - 1];
  items_.resize(static_cast<std::size_t>(begin_.back()));
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t b = 0; b < boxes_.size(); ++b)
    for_each_cell(boxes_[b],
                  [&](std::size_t at) { items_[static_cast<std::size_t>(next[at]++)] = static_cast<int>(b); });
}

}  // namespace pliant
