#include "diagnostics/inside.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <random>

#include "mesh/geometry.hpp"
#include "mesh/shapes/box.hpp"
#include "mesh/shapes/icosphere.hpp"

namespace pliant {
namespace {

Grid cube(int cells, bool is_periodic) {
  BoxConfig box;
  box.size = {4, 4, 4};
  box.origin = {-2, -2, -2};
  box.cells = {cells, cells, cells};
  BoundaryConfig boundary;
  if (!is_periodic) boundary.fill(WallSide{});
  return {box, boundary, Communicator(MPI_COMM_SELF)};
}

/// How often a surface winds around a point: the solid angles of its faces.
double winding(const Surface& surface, Vec3 point) {
  double sum = 0;
  for (const Face& face : surface.mesh.vertices_of_face()) {
    const auto corner = [&](std::size_t c) { return surface.positions[static_cast<std::size_t>(face[c])] - point; };
    const Vec3 a = corner(0), b = corner(1), c = corner(2);
    const double la = norm(a), lb = norm(b), lc = norm(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

// Centres of the cells of which pieces hold more than half: not quite those whose centres are inside, so lines are
// asked.
bool is_in(const std::vector<InsidePiece>& pieces, int i, int j, double z) {
  for (const auto& piece : pieces)
    if (piece.i == i && piece.j == j && piece.from < z && z < piece.to) return true;
  return false;
}

TEST(FindInside, AgreesWithSolidAnglesOfARoughSurface) {
  auto ball = make_icosphere(6, 1.2);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-0.08, 0.08);
  for (Vec3& x : ball.positions) x += Vec3{number(random), number(random), 0.3 * x.x + number(random)};
  const auto grid = cube(17, false);
  const auto pieces = find_inside(grid, ball.mesh.vertices_of_face(), ball.positions, 1);
  int inside = 0, cells = 0;
  for (int i = 0; i < 17; ++i)
    for (int j = 0; j < 17; ++j)
      for (int k = 0; k < 17; ++k, ++cells) {
        const Vec3 x{grid.x_center(i), grid.y_center(j), grid.z_center()[k]};
        const bool expected = winding(ball, x) > 0.5;
        EXPECT_EQ(is_in(pieces, i, j, x.z), expected) << i << " " << j << " " << k;
        inside += expected;
      }
  EXPECT_GT(inside, 300);
  EXPECT_LT(inside, cells / 2);
  EXPECT_TRUE(find_inside(grid, ball.mesh.vertices_of_face(), ball.positions, -1).empty()) << "inside out";
}

// Vertices, edges and upright faces stand on the lines themselves.
TEST(FindInside, TakesSurfacesThatLieOnTheLines) {
  const auto grid = cube(16, false);  // spacing 1/4
  auto box = make_box({2, 1.5, 1}, 0.25);
  for (Vec3& x : box.positions) x += Vec3{0.125, 0.125, 0.1};
  const auto pieces = find_inside(grid, box.mesh.vertices_of_face(), box.positions, 1);
  ASSERT_EQ(pieces.size(), 8u * 6u);
  for (const auto& piece : pieces) {
    EXPECT_NEAR(piece.from, -0.4, 1e-14);
    EXPECT_NEAR(piece.to, 0.6, 1e-14);
  }
  double volume = 0;
  for_cells_inside(grid, pieces, [&](int, int, int, double share, Vec3) { volume += share / 64; });
  EXPECT_NEAR(volume, 3.0, 1e-13);
}

TEST(FindInside, GoesOnPastPeriodicSides) {
  const auto grid = cube(12, true);
  auto ball = make_icosphere(5, 1.1);
  const double h = 4.0 / 12;
  const auto cells_of = [&](Vec3 at) {
    auto moved = ball;
    for (Vec3& x : moved.positions) x += at;
    std::map<std::array<int, 3>, double> cells;
    for_cells_inside(grid, find_inside(grid, moved.mesh.vertices_of_face(), moved.positions, 1),
                     [&](int i, int j, int k, double share, Vec3 shift) {
                       cells[{i, j, k}] += share;
                       const Vec3 x = Vec3{grid.x_center(i), grid.y_center(j), grid.z_center()[k]} + shift;
                       EXPECT_LT(norm(x - at), 1.1 + h) << "the shift leads to where the surface is";
                     });
    return cells;
  };
  const auto middle = cells_of({0.05, 0.03, 0.02}), corner = cells_of({0.05 + 6 * h, 0.03 - 18 * h, 0.02 + 30 * h});
  ASSERT_EQ(middle.size(), corner.size());
  double volume = 0;
  for (const auto& [cell, share] : middle) {
    const auto [i, j, k] = cell;
    EXPECT_NEAR(corner.at({(i + 6) % 12, (j + 6) % 12, (k + 6) % 12}), share, 1e-12);
    volume += share * h * h * h;
  }
  EXPECT_NEAR(volume, enclosed_volume(ball.mesh, ball.positions), 0.02 * volume);
}

}  // namespace
}  // namespace pliant
