#pragma once
#include <functional>
#include <random>
#include <vector>

#include "field/field.hpp"
#include "grid/grid.hpp"

namespace pliant::test {

inline BoundaryConfig walls() { return {WallSide{}, WallSide{}, WallSide{}, WallSide{}, WallSide{}, WallSide{}}; }

inline BoxConfig box_of(int n, StretchingLaw law, double strength = 1.5) {
  BoxConfig config;
  config.size = {2.0, 1.5, 3.0};
  config.origin = {-1.0, 0.5, -2.0};
  config.cells = {n, n + 1, n + 2};
  config.stretching_z = {law, strength};
  return config;
}

struct VelocityFields {
  explicit VelocityFields(const Grid& grid) : u(grid), v(grid), w(grid) {}
  Field<FaceX> u;
  Field<FaceY> v;
  Field<FaceZ> w;
};

/// value(component, node) for all nodes of u, v and w, ghosts included; planes are this rank's.
template <class Visit>
void for_each_node(const Grid& grid, int ghosts, Visit visit) {
  for (int k = -ghosts; k < grid.nz() + ghosts; ++k)
    for (int j = -ghosts; j < grid.ny() + ghosts; ++j)
      for (int i = -ghosts; i < grid.nx() + ghosts; ++i) {
        const Vec3 c{grid.x_center(i), grid.y_center(j), grid.z_center()[k]};
        visit(0, i, j, k, Vec3{grid.x_face(i), c.y, c.z});
        visit(1, i, j, k, Vec3{c.x, grid.y_face(j), c.z});
        visit(2, i, j, k, Vec3{c.x, c.y, grid.z_face()[k]});
      }
}

template <class Value>
void set_velocity(const Grid& grid, VelocityFields& f, Value value) {
  for_each_node(grid, 1, [&](int c, int i, int j, int k, Vec3 x) {
    (c == 0 ? f.u.view()(i, j, k) : c == 1 ? f.v.view()(i, j, k) : f.w.view()(i, j, k)) = value(c, x);
  });
}

/// Volume of the control volume of a velocity node.
inline double node_volume(const Grid& grid, int component, int k) {
  return grid.dx() * grid.dy() * (component == 2 ? grid.dz_f()[k] : grid.dz_c()[k]);
}

/// Random points of the box; margin keeps them from its sides.
inline std::vector<Vec3> random_points(const Grid& grid, int n, double margin = 0) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(margin, 1 - margin);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const double a = unit(random), b = unit(random), c = unit(random);
    const auto o = grid.origin(), s = grid.size();
    points.push_back({o.x + a * s.x, o.y + b * s.y, o.z + c * s.z});
  }
  return points;
}

}  // namespace pliant::test
