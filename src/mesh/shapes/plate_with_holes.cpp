#include "mesh/shapes/plate_with_holes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "mesh/shapes/patch_mesher.hpp"
#include "mesh/shapes/shape_parts.hpp"

namespace pliant {
namespace {
/// By how much edges grow with the distance from a hole.
constexpr double growth = 0.25;

double distance_to(const RoundHole& hole, double x, double y) {
  return std::hypot(x - hole.x, y - hole.y) - hole.radius;
}

void check(const PlateWithHolesSizes& sizes) {
  ShapeChecks checks("plate-with-holes");
  checks.positive("size x", sizes.size[0]);
  checks.positive("size y", sizes.size[1]);
  for (const auto& hole : sizes.holes) checks.positive("radius of a hole", hole.radius);
  const double shortest = sizes.hole_edge > 0 ? std::min(sizes.hole_edge, sizes.edge) : sizes.edge;
  checks.edge(sizes.edge, std::min(sizes.size[0], sizes.size[1]), sizes.size[0] * sizes.size[1]);
  checks.positive("hole_edge", shortest);
  checks.finish();
  std::vector<std::string> problems;
  for (std::size_t i = 0; i < sizes.holes.size(); ++i) {
    const auto& hole = sizes.holes[i];
    const double gap =
        std::min(sizes.size[0] / 2 - std::abs(hole.x), sizes.size[1] / 2 - std::abs(hole.y)) - hole.radius;
    const double wanted = sizes.hole_edge > 0 ? sizes.hole_edge : sizes.edge;
    if (!(gap >= wanted))
      problems.push_back(
          fmt::format("plate-with-holes: hole {} comes closer to the border than one edge ({:.4g} < "
                      "{:.4g}); move it, or give shorter edges",
                      i + 1, gap, wanted));
    for (std::size_t j = 0; j < i; ++j)
      if (const double between = distance_to(sizes.holes[j], hole.x, hole.y) - hole.radius; !(between >= wanted))
        problems.push_back(
            fmt::format("plate-with-holes: holes {} and {} are closer than one edge ({:.4g} < {:.4g}); "
                        "move them apart, or give shorter edges",
                        j + 1, i + 1, between, wanted));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

/// A point that is far from the circles and outside all of them, by a search over a lattice.
ChartPoint far_from_holes(const PlateWithHolesSizes& sizes) {
  constexpr int n = 64;
  ChartPoint best{};
  double farthest = -std::numeric_limits<double>::infinity();
  for (int i = 1; i < n; ++i)
    for (int j = 1; j < n; ++j) {
      const double x = sizes.size[0] * (static_cast<double>(i) / n - 0.5);
      const double y = sizes.size[1] * (static_cast<double>(j) / n - 0.5);
      double distance = std::min(sizes.size[0] / 2 - std::abs(x), sizes.size[1] / 2 - std::abs(y));
      for (const auto& hole : sizes.holes) distance = std::min(distance, distance_to(hole, x, y));
      if (distance > farthest) farthest = distance, best = {x, y};
    }
  return best;
}
}  // namespace

Surface make_plate_with_holes(const PlateWithHolesSizes& sizes) {
  check(sizes);
  const double hole_edge = sizes.hole_edge > 0 ? sizes.hole_edge : sizes.edge;
  const auto [width, depth] = sizes.size;
  Patch patch;
  patch.surface = [](ChartPoint p) { return Vec3{p[0], p[1], 0}; };
  patch.edge = [&](Vec3 x) {
    double edge = sizes.edge;
    for (const auto& hole : sizes.holes)
      edge = std::min(edge, hole_edge + growth * std::max(0.0, distance_to(hole, x.x, x.y)));
    return edge;
  };
  patch.middle = far_from_holes(sizes);

  // Opposite sides: the same fractions, and coordinates that are exactly plus or minus half the size.
  const int nx = parts_of(width, sizes.edge), ny = parts_of(depth, sizes.edge);
  const auto along = [](double size, int i, int n) { return size * (static_cast<double>(i) / n) - size / 2; };
  const auto add = [&](double x, double y) { patch.outline.push_back({{x, y}, {x, y, 0}}); };
  for (int i = 0; i < nx; ++i) add(along(width, i, nx), -depth / 2);
  for (int i = 0; i < ny; ++i) add(width / 2, along(depth, i, ny));
  for (int i = nx; i > 0; --i) add(along(width, i, nx), depth / 2);
  for (int i = ny; i > 0; --i) add(-width / 2, along(depth, i, ny));

  ShapeParts parts;
  parts.selections = {{"border", {}}, {"holes", {}}};
  int v = 0;
  for (; v < static_cast<int>(patch.outline.size()); ++v) parts.selections[0].vertices.push_back(v);
  for (std::size_t i = 0; i < sizes.holes.size(); ++i) {
    const auto& hole = sizes.holes[i];
    auto& loop = patch.holes.emplace_back();
    auto& selection = parts.selections.emplace_back(NamedVertices{fmt::format("hole-{}", i + 1), {}});
    const int m = parts_of_circle(hole.radius, std::min(hole_edge, hole.radius));
    for (int j = 0; j < m; ++j, ++v) {
      const Vec3 x = Vec3{hole.x, hole.y, 0} + circle_vertex(hole.radius, m, j);
      loop.push_back({{x.x, x.y}, x});
      selection.vertices.push_back(v);
    }
    auto& all = parts.selections[1].vertices;
    all.insert(all.end(), selection.vertices.begin(), selection.vertices.end());
  }
  try {
    PatchMesh mesh = mesh_patch(patch);
    parts.positions = std::move(mesh.positions);
    parts.faces = std::move(mesh.faces);
  } catch (const InputError& error) { throw InputError(fmt::format("plate-with-holes: {}", error.what())); }
  return finish_shape(parts);
}

}  // namespace pliant
