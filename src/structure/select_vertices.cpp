#include "structure/select_vertices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "mesh/geometry.hpp"

namespace pliant {
namespace {

using Flags = std::vector<char>;

/// Each border by a number of its own at its vertices; -1 elsewhere.
std::vector<int> number_borders(const TriangleMesh& mesh) {
  std::vector<int> border(static_cast<std::size_t>(mesh.n_vertices()), -1);
  std::vector<std::vector<int>> along(border.size());
  const auto edges = mesh.vertices_of_edge();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (mesh.faces_of_edge()[e][1] >= 0) continue;
    const auto [a, b] = edges[e];
    along[a].push_back(b);
    along[b].push_back(a);
  }
  int n_borders = 0;
  for (std::size_t v = 0; v < border.size(); ++v) {
    if (along[v].empty() || border[v] >= 0) continue;
    std::vector<int> open{static_cast<int>(v)};
    while (!open.empty()) {
      const int at = open.back();
      open.pop_back();
      if (border[at] >= 0) continue;
      border[at] = n_borders;
      open.insert(open.end(), along[at].begin(), along[at].end());
    }
    ++n_borders;
  }
  return border;
}

void keep_border(Flags& kept, const TriangleMesh& mesh, std::span<const Vec3> positions,
                 const std::optional<Vec3>& near) {
  const auto border = number_borders(mesh);
  int wanted = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; near && v < border.size(); ++v)
    if (const double distance = norm(positions[v] - *near); border[v] >= 0 && distance < least)
      least = distance, wanted = border[v];
  for (std::size_t v = 0; v < border.size(); ++v)
    if (border[v] < 0 || (near && border[v] != wanted)) kept[v] = 0;
}

double mean_edge(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  const auto lengths = edge_lengths(mesh, positions);
  return std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
}

void keep_extreme(Flags& kept, std::span<const Vec3> positions, const SelectionConfig::Extreme& extreme) {
  std::vector<std::size_t> order(positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return dot(positions[a], extreme.direction) > dot(positions[b], extreme.direction);
  });
  const auto wanted = std::lround(extreme.fraction * static_cast<double>(positions.size()));
  for (std::size_t n = static_cast<std::size_t>(std::max(1L, wanted)); n < order.size(); ++n) kept[order[n]] = 0;
}

}  // namespace

std::vector<int> select_vertices(const SelectionConfig& selection, const TriangleMesh& mesh,
                                 std::span<const Vec3> positions) {
  Flags kept(positions.size(), 1);
  const auto keep = [&](auto holds) {
    for (std::size_t v = 0; v < positions.size(); ++v)
      if (!holds(positions[v])) kept[v] = 0;
  };
  if (selection.border || selection.border_near) keep_border(kept, mesh, positions, selection.border_near);
  if (const auto& sphere = selection.sphere) keep([&](Vec3 x) { return norm(x - sphere->center) <= sphere->radius; });
  if (const auto& box = selection.box)
    keep([&](Vec3 x) {
      for (int d = 0; d < 3; ++d)
        if (x[d] < box->lower[d] || x[d] > box->upper[d]) return false;
      return true;
    });
  if (const auto& cylinder = selection.cylinder)
    keep([&](Vec3 x) { return norm(cross(x - cylinder->point, normalized(cylinder->axis))) <= cylinder->radius; });
  if (const auto& plane = selection.plane) {
    const double tolerance = plane->tolerance.value_or(0.01 * mean_edge(mesh, positions));
    const Vec3 normal = normalized(plane->normal);
    keep([&](Vec3 x) {
      const double height = dot(x - plane->point, normal);
      return height >= -tolerance && (plane->side == PlaneSide::beyond || height <= tolerance);
    });
  }
  if (selection.extreme) keep_extreme(kept, positions, *selection.extreme);

  std::vector<int> vertices;
  for (std::size_t v = 0; v < kept.size(); ++v)
    if (kept[v]) vertices.push_back(static_cast<int>(v));
  return vertices;
}

std::vector<int> select_vertices(const BodyConfig& body, const std::string& name, const TriangleMesh& mesh,
                                 std::span<const Vec3> positions, std::span<const NamedVertices> of_surface) {
  for (const auto& selection : body.selections) {
    if (selection.name != name) continue;
    auto vertices = select_vertices(selection, mesh, positions);
    if (!vertices.empty()) return vertices;
    throw InputError(fmt::format(
        "body.{}.selection.{} holds no vertex; its points are in the coordinates of the surface before rotation and "
        "center: `pliant mesh info` tells where a surface reaches",
        body.name, name));
  }
  std::string known;
  for (const auto& selection : of_surface) {
    if (selection.name == name) return selection.vertices;
    known += (known.empty() ? "" : ", ") + selection.name;
  }
  throw InputError(fmt::format("body.{} has no selection named {}; its surface brings {}: write [body.selection.{}]",
                               body.name, name, known.empty() ? "none" : known, name));
}

}  // namespace pliant
