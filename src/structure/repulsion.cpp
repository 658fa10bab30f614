#include "structure/repulsion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include "core/error.hpp"

namespace pliant {
namespace {

constexpr double softening = 0.1;  // e
/// c: 1 over the maximum over g of 2 pi g times the integral of w/c from g to 1, which is the pressure between two
/// parallel planes at gap g ranges.
constexpr double normalisation = 0.4912507928074907;

/// An antiderivative of s (1 - s)^2 / (s^2 + e^2)^(3/2).
double antiderivative(double s) {
  const double q = std::sqrt(s * s + softening * softening);
  return q - 2.0 * std::asinh(s / softening) + (2.0 * s - 1.0 + softening * softening) / q;
}

/// Which image of the box, and how points see each other through its sides.
class Space {
 public:
  Space(const RepulsionBox& box, double range) : box_(box) {
    constexpr double most_cells = 1 << 20;
    for (int d = 0; d < 3; ++d) {
      periodic_[d] = box.sides[2 * static_cast<std::size_t>(d)] == RepulsionSide::periodic;
      if (periodic_[d] && range > 0.5 * box.size[d])
        throw InputError(
            fmt::format("The range {} of the repulsion is more than half of the periodic box along {}, {}; "
                        "make it smaller.",
                        range, "xyz"[d], box.size[d]));
      n_[d] = static_cast<std::int64_t>(std::clamp(std::floor(box.size[d] / range), 1.0, most_cells));
    }
  }

  bool is_periodic(int d) const { return periodic_[d]; }
  std::int64_t n_cells(int d) const { return n_[d]; }

  std::array<std::int64_t, 3> cell_of(Vec3 x) const {
    std::array<std::int64_t, 3> cell{};
    for (int d = 0; d < 3; ++d) {
      double s = (x[d] - box_.origin[d]) / box_.size[d];
      if (periodic_[d]) s -= std::floor(s);
      const auto n = static_cast<double>(n_[d]);
      cell[d] = static_cast<std::int64_t>(std::clamp(std::floor(s * n), 0.0, n - 1.0));
    }
    return cell;
  }

  std::int64_t key_of(const std::array<std::int64_t, 3>& cell) const {
    return (cell[2] * n_[1] + cell[1]) * n_[0] + cell[0];
  }

  /// From b to a, to the nearest image; changes sign to the bit with a and b exchanged.
  Vec3 difference(Vec3 a, Vec3 b) const {
    Vec3 delta = a - b;
    for (int d = 0; d < 3; ++d)
      if (periodic_[d]) delta[d] -= box_.size[d] * std::round(delta[d] / box_.size[d]);
    return delta;
  }

 private:
  RepulsionBox box_;
  std::array<bool, 3> periodic_{};
  std::array<std::int64_t, 3> n_{};
};

/// The points in the order of cells, within a cell by body and position.
class CellList {
 public:
  struct Cell {
    std::int64_t key;
    std::array<std::int64_t, 3> place;
    std::size_t begin, end;
    int least_body, greatest_body;
  };

  CellList(std::span<const SurfacePoint> points, const Space& space) : space_(space) {
    std::vector<std::int64_t> keys(points.size());
    order_.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 x = points[i].position;
      if (!std::isfinite(x.x) || !std::isfinite(x.y) || !std::isfinite(x.z)) continue;
      order_.push_back(i);
      keys[i] = space.key_of(space.cell_of(x));
    }
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      const auto rank = [&](std::size_t i) {
        const SurfacePoint& p = points[i];
        return std::tuple(keys[i], p.body, p.position.x, p.position.y, p.position.z, p.area, i);
      };
      return rank(a) < rank(b);
    });
    for (std::size_t at = 0; at < order_.size(); ++at) {
      const SurfacePoint& point = points[order_[at]];
      const std::int64_t key = keys[order_[at]];
      if (cells_.empty() || cells_.back().key != key)
        cells_.push_back({key, space.cell_of(point.position), at, at, point.body, point.body});
      cells_.back().end = at + 1;
      cells_.back().greatest_body = point.body;
    }
  }

  std::span<const Cell> cells() const { return cells_; }
  std::span<const std::size_t> members(const Cell& cell) const {
    return std::span(order_).subspan(cell.begin, cell.end - cell.begin);
  }

  /// The occupied cells around a cell and itself, each once, with another body than `cell` alone holds.
  void find_neighbours(const Cell& cell, std::vector<const Cell*>& found) const {
    std::array<std::array<std::int64_t, 3>, 3> along{};
    std::array<int, 3> n{};
    for (int d = 0; d < 3; ++d)
      for (int shift = -1; shift <= 1; ++shift) {
        std::int64_t c = cell.place[d] + shift;
        if (space_.is_periodic(d)) c = (c + space_.n_cells(d)) % space_.n_cells(d);
        const auto end = along[d].begin() + n[d];
        if (c >= 0 && c < space_.n_cells(d) && std::find(along[d].begin(), end, c) == end) along[d][n[d]++] = c;
      }
    found.clear();
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i) {
          const std::int64_t key = space_.key_of({along[0][i], along[1][j], along[2][k]});
          const auto at = std::lower_bound(cells_.begin(), cells_.end(), key,
                                           [](const Cell& c, std::int64_t wanted) { return c.key < wanted; });
          if (at == cells_.end() || at->key != key) continue;
          const bool same_body = at->least_body == at->greatest_body && cell.least_body == cell.greatest_body &&
                                 at->least_body == cell.least_body;
          if (!same_body) found.push_back(&*at);
        }
  }

 private:
  const Space& space_;
  std::vector<std::size_t> order_;
  std::vector<Cell> cells_;
};

void require_valid(const Repulsion& repulsion) {
  if (!(repulsion.range > 0))
    throw InputError(fmt::format("The range of the repulsion is {}; it must be positive.", repulsion.range));
}

/// on_pair(i, j, from j to i, distance) for each own point i and each other point j within the range, i by i.
template <class OnPair>
void for_each_pair(std::span<const SurfacePoint> points, std::size_t n_own, const RepulsionBox& box, double range,
                   OnPair&& on_pair) {
  const Space space(box, range);
  const CellList list(points, space);
  std::vector<const CellList::Cell*> neighbours;
  for (const auto& cell : list.cells()) {
    list.find_neighbours(cell, neighbours);
    if (neighbours.empty()) continue;
    for (std::size_t i : list.members(cell)) {
      if (i >= n_own) continue;
      for (const auto* neighbour : neighbours)
        for (std::size_t j : list.members(*neighbour)) {
          if (points[i].body == points[j].body) continue;
          const Vec3 delta = space.difference(points[i].position, points[j].position);
          const double squared = dot(delta, delta);
          if (squared < range * range) on_pair(i, j, delta, std::sqrt(squared));
        }
    }
  }
}

/// on_wall(i, direction, sign of the push, distance) for each own point within the range of a wall or behind it.
template <class OnWall>
void for_each_wall(std::span<const SurfacePoint> points, std::size_t n_own, const RepulsionBox& box, double range,
                   OnWall&& on_wall) {
  for (int side = 0; side < 6; ++side) {
    if (box.sides[side] != RepulsionSide::wall) continue;
    const int d = side / 2;
    const double sign = side % 2 == 0 ? 1.0 : -1.0;
    const double wall = box.origin[d] + (side % 2 == 0 ? 0.0 : box.size[d]);
    for (std::size_t i = 0; i < n_own; ++i) {
      const double distance = sign * (points[i].position[d] - wall);
      if (distance < range) on_wall(i, d, sign, distance);
    }
  }
}

}  // namespace

double repulsion_weight(double s) {
  if (s >= 1) return 0;
  const double q = std::sqrt(s * s + softening * softening);
  return normalisation * s * (1 - s) * (1 - s) / (q * q * q);
}

double repulsion_potential(double s) { return s < 1 ? normalisation * (antiderivative(1.0) - antiderivative(s)) : 0.0; }

void add_repulsion(std::span<const SurfacePoint> points, std::size_t n_own, const RepulsionBox& box,
                   const Repulsion& repulsion, std::span<Vec3> forces) {
  require_valid(repulsion);
  const double range = repulsion.range;
  std::vector<Vec3> sums(n_own);
  for_each_pair(points, n_own, box, range, [&](std::size_t i, std::size_t j, Vec3 delta, double distance) {
    if (distance == 0) return;
    const double areas = points[i].area * points[j].area;
    const double factor = repulsion.strength / (range * range) * repulsion_weight(distance / range) / distance;
    sums[i] += areas * factor * delta;
  });
  for_each_wall(points, n_own, box, range, [&](std::size_t i, int d, double sign, double distance) {
    const double gap = 1.0 - distance / range;
    sums[i][d] += sign * repulsion.strength * points[i].area * gap * gap;
  });
  for (std::size_t i = 0; i < n_own; ++i) forces[i] += sums[i];
}

double repulsion_energy(std::span<const SurfacePoint> points, std::size_t n_own, const RepulsionBox& box,
                        const Repulsion& repulsion) {
  require_valid(repulsion);
  const double range = repulsion.range;
  double energy = 0;
  for_each_pair(points, n_own, box, range, [&](std::size_t i, std::size_t j, Vec3, double distance) {
    energy +=
        0.5 * repulsion.strength * points[i].area * points[j].area / range * repulsion_potential(distance / range);
  });
  for_each_wall(points, n_own, box, range, [&](std::size_t i, int, double, double distance) {
    const double gap = 1.0 - distance / range;
    energy += repulsion.strength * points[i].area * range * gap * gap * gap / 3.0;
  });
  return energy;
}

}  // namespace pliant
