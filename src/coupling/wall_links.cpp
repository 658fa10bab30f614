#include "coupling/wall_links.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/seen_face.hpp"

namespace pliant {
namespace {

/// The centres of cells along one axis, and their periodic images. Surfaces like to stand at round places, where
/// centres stand too: a shift that shows nowhere keeps them apart.
class Centers {
 public:
  Centers(const Grid& grid, int axis)
      : grid_(grid),
        axis_(axis),
        cells_(grid.cells()[static_cast<std::size_t>(axis)]),
        is_periodic_(grid.is_periodic(axis)),
        origin_(grid.origin()[axis]),
        size_(grid.size()[axis]),
        shift_((axis == 0   ? 0.6180339e-7
                : axis == 1 ? 0.4142136e-7
                            : 0.3028e-7) *
               size_ / cells_) {}

  /// visit(cell, place) for those between two places, and perhaps one more on either side.
  template <class Visit>
  void for_each_between(double lower, double upper, Visit visit) const {
    for (int turn = turns_to(lower); turn <= turns_to(upper); ++turn) {
      const double by = turn * size_;
      const int last = std::min(cell_at(upper - by) + 1, cells_ - 1);
      for (int n = std::max(cell_at(lower - by) - 1, 0); n <= last; ++n) visit(n, place_of(n) + by);
    }
  }

  /// The node between the centres next to a place; -1: at a bounded side.
  int node_at(double place) const {
    const double inside = place - turns_to(place) * size_;
    int n = cell_at(inside);
    if (inside < place_of(n)) --n;
    if (is_periodic_) return n < 0 ? cells_ - 1 : n;
    return n < cells_ - 1 ? n : -1;
  }

 private:
  int turns_to(double place) const {
    return is_periodic_ ? static_cast<int>(std::floor((place - origin_) / size_)) : 0;
  }
  double place_of(int n) const {
    const double center = axis_ == 2 ? grid_.global_z_center()[n] : origin_ + (n + 0.5) * size_ / cells_;
    return center + shift_;
  }
  int cell_at(double place) const {
    if (axis_ == 2) return grid_.plane_of_height(place);
    return static_cast<int>(std::clamp(std::floor((place - origin_) / size_ * cells_), 0.0, cells_ - 1.0));
  }

  const Grid& grid_;
  int axis_, cells_;
  bool is_periodic_;
  double origin_, size_, shift_;
};

}  // namespace

std::vector<WallLink> find_wall_links(const Grid& grid, std::span<const Face> faces, std::span<const Vec3> positions) {
  const std::array<Centers, 3> centers{Centers(grid, 0), Centers(grid, 1), Centers(grid, 2)};
  std::vector<WallLink> links;
  for (const Face& face : faces)
    for (int axis = 0; axis < 3; ++axis) {
      const int a_axis = (axis + 1) % 3, b_axis = (axis + 2) % 3;
      const auto along = [&](int d) -> const Centers& { return centers[static_cast<std::size_t>(d)]; };
      const SeenFace seen(face, positions, axis);
      along(a_axis).for_each_between(seen.lower(a_axis), seen.upper(a_axis), [&](int i, double a) {
        along(b_axis).for_each_between(seen.lower(b_axis), seen.upper(b_axis), [&](int j, double b) {
          const int winds = seen.passes(a, b);
          if (winds == 0) return;
          WallLink link;
          link.axis = axis;
          link.sign = -winds;
          link.place[axis] = seen.height_at(a, b);
          link.place[a_axis] = a;
          link.place[b_axis] = b;
          link.node[static_cast<std::size_t>(axis)] = along(axis).node_at(link.place[axis]);
          link.node[static_cast<std::size_t>(a_axis)] = i;
          link.node[static_cast<std::size_t>(b_axis)] = j;
          if (link.node[static_cast<std::size_t>(axis)] >= 0) links.push_back(link);
        });
      });
    }
  return links;
}

}  // namespace pliant
