#include "mesh/shapes/box.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "mesh/shapes/shape_parts.hpp"

namespace pliant {
namespace {
using Lattice = std::array<int, 3>;

class BoxBuilder {
 public:
  BoxBuilder(Vec3 size, Lattice n) : size_(size), n_(n) {}

  /// The side of the box whose normal is along direction d, at its upper or lower end.
  void add_side(int d, int level) {
    const int e = (d + 1) % 3, f = (d + 2) % 3;  // e x f = d
    for (int j = 0; j < n_[f]; ++j)
      for (int i = 0; i < n_[e]; ++i) {
        const auto corner = [&](int di, int dj) {
          Lattice at{};
          at[d] = level;
          at[e] = i + di;
          at[f] = j + dj;
          return vertex(at);
        };
        const int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), g = corner(0, 1);
        const bool rising = (2 * i + 1 >= n_[e]) == (2 * j + 1 >= n_[f]);
        if (rising) add_pair({a, b, c}, {a, c, g}, level);
        else add_pair({a, b, g}, {b, c, g}, level);
      }
  }

  ShapeParts parts;

 private:
  void add_pair(Face first, Face second, int level) {
    if (level == 0) {
      std::swap(first[1], first[2]);
      std::swap(second[1], second[2]);
    }
    parts.faces.push_back(first);
    parts.faces.push_back(second);
  }

  int vertex(const Lattice& at) {
    const auto [entry, is_new] = numbers_.try_emplace(at, static_cast<int>(parts.positions.size()));
    if (is_new) {
      Vec3 x;
      for (int d = 0; d < 3; ++d) x[d] = size_[d] * (static_cast<double>(at[d]) / n_[d]) - size_[d] / 2;
      parts.add_vertex(x);
    }
    return entry->second;
  }

  Vec3 size_;
  Lattice n_;
  std::map<Lattice, int> numbers_;
};
}  // namespace

Surface make_box(Vec3 size, double edge) {
  ShapeChecks checks("box");
  checks.positive("size x", size.x);
  checks.positive("size y", size.y);
  checks.positive("size z", size.z);
  checks.edge(edge, std::min({size.x, size.y, size.z}), 2 * (size.x * size.y + size.y * size.z + size.z * size.x));
  checks.finish();
  // The shortest side is cut first, and the others into parts like its own.
  const double shortest = std::min({size.x, size.y, size.z});
  const double step = shortest / parts_of(shortest, edge);
  const Lattice n{parts_of(size.x, step), parts_of(size.y, step), parts_of(size.z, step)};
  BoxBuilder builder(size, n);
  for (int d = 0; d < 3; ++d)
    for (int level : {0, n[d]}) builder.add_side(d, level);
  return finish_shape(builder.parts);
}

}  // namespace pliant
