#include "mesh/crossing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mesh/distance.hpp"
#include "mesh/geometry.hpp"

namespace pliant {
namespace {

struct Box {
  Vec3 lower, upper;
};

struct Item {
  Box box;
  int number;
};

void widen(Box& box, Vec3 x) {
  for (int d = 0; d < 3; ++d) {
    box.lower[d] = std::min(box.lower[d], x[d]);
    box.upper[d] = std::max(box.upper[d], x[d]);
  }
}

bool meet(const Box& a, const Box& b) {
  for (int d = 0; d < 3; ++d)
    if (a.lower[d] > b.upper[d] || b.lower[d] > a.upper[d]) return false;
  return true;
}

Box box_of(std::span<const Vec3> positions) {
  Box box{positions[0], positions[0]};
  for (const Vec3 x : positions) widen(box, x);
  return box;
}

bool by_lower_x(const Item& a, const Item& b) {
  return a.box.lower.x != b.box.lower.x ? a.box.lower.x < b.box.lower.x : a.number < b.number;
}

/// The edges, or faces, whose boxes meet `limits`, sorted by their lower x.
template <class Corners>
std::vector<Item> items_within(const Box& limits, const Corners& corners, std::span<const Vec3> positions) {
  std::vector<Item> items;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Box box{positions[corners[i][0]], positions[corners[i][0]]};
    for (const int v : corners[i]) widen(box, positions[v]);
    if (meet(box, limits)) items.push_back({box, static_cast<int>(i)});
  }
  std::sort(items.begin(), items.end(), by_lower_x);
  return items;
}

/// Calls visit(first, second) for pairs whose boxes meet, by a sweep along x, until it returns true.
template <class Visit>
bool any_pair(const std::vector<Item>& first, const std::vector<Item>& second, Visit visit) {
  // Items that begin later than their partner: each pair comes up once, from the one that begins first.
  const auto sweep = [&](const std::vector<Item>& early, const std::vector<Item>& late, const auto& call, bool ties) {
    std::size_t start = 0;
    for (const Item& item : early) {
      while (start < late.size() && late[start].box.lower.x < item.box.lower.x) ++start;
      for (std::size_t i = start; i < late.size() && late[i].box.lower.x <= item.box.upper.x; ++i) {
        if (!ties && late[i].box.lower.x == item.box.lower.x) continue;
        if (meet(item.box, late[i].box) && call(item.number, late[i].number)) return true;
      }
    }
    return false;
  };
  return sweep(first, second, visit, true) || sweep(
                                                  second, first, [&](int b, int a) { return visit(a, b); }, false);
}

/// Where the segment crosses the triangle, both its ends further than `depth` from the plane.
std::optional<Vec3> crossing_of(Vec3 from, Vec3 to, const Triangle& triangle, double depth) {
  const auto [a, b, c] = triangle;
  const Vec3 area = cross(b - a, c - a);
  const double size = norm(area);
  if (!(size > 0)) return std::nullopt;
  const double begin = dot(area, from - a) / size, end = dot(area, to - a) / size;
  if (!((begin > depth && end < -depth) || (begin < -depth && end > depth))) return std::nullopt;
  const Vec3 along = to - from;
  // Volumes of the segment with the three sides: of one sign if it passes through, 0 if it meets a side.
  const double ab = dot(along, cross(a - from, b - from)), bc = dot(along, cross(b - from, c - from)),
               ca = dot(along, cross(c - from, a - from));
  const bool passes = (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  if (!passes) return std::nullopt;
  return from + begin / (begin - end) * along;
}

Triangle triangle_of(const SurfaceView& surface, int face) {
  const Face& corners = surface.mesh.vertices_of_face()[face];
  return {surface.positions[corners[0]], surface.positions[corners[1]], surface.positions[corners[2]]};
}

std::optional<Box> common_box(const SurfaceView& a, const SurfaceView& b, double depth) {
  Box first = box_of(a.positions);
  const Box second = box_of(b.positions);
  const Vec3 margin{depth, depth, depth};
  first = {first.lower - margin, first.upper + margin};
  if (!meet(first, second)) return std::nullopt;
  for (int d = 0; d < 3; ++d) {
    first.lower[d] = std::max(first.lower[d], second.lower[d] - depth);
    first.upper[d] = std::min(first.upper[d], second.upper[d] + depth);
  }
  return first;
}

/// Calls visit(edge of a, face of b, point) where an edge of `a` passes through a face of `b`, until it returns true.
template <class Visit>
void edges_through_faces(const SurfaceView& a, const SurfaceView& b, const Box& limits, double depth, Visit visit) {
  const auto edges = items_within(limits, a.mesh.vertices_of_edge(), a.positions);
  const auto faces = items_within(limits, b.mesh.vertices_of_face(), b.positions);
  any_pair(edges, faces, [&](int e, int f) {
    const auto& [from, to] = a.mesh.vertices_of_edge()[e];
    const auto at = crossing_of(a.positions[from], a.positions[to], triangle_of(b, f), depth);
    return at && visit(e, f, *at);
  });
}

/// The same of one surface; edges and faces that share a vertex do not count.
template <class Visit>
void edges_through_own_faces(const SurfaceView& surface, double depth, Visit visit) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  const Box everything{{-endless, -endless, -endless}, {endless, endless, endless}};
  edges_through_faces(surface, surface, everything, depth, [&](int e, int f, Vec3 at) {
    const auto& [from, to] = surface.mesh.vertices_of_edge()[e];
    for (const int v : surface.mesh.vertices_of_face()[f])
      if (v == from || v == to) return false;
    return visit(e, f, at);
  });
}

void add_faces_of_edge(const SurfaceView& surface, int e, std::vector<int>& faces) {
  for (const int f : surface.mesh.faces_of_edge()[e])
    if (f >= 0) faces.push_back(f);
}
void sort_once(std::vector<int>& faces) {
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
}
}  // namespace

std::optional<Vec3> find_crossing(const SurfaceView& a, const SurfaceView& b, double depth) {
  const auto limits = common_box(a, b, depth);
  if (!limits) return std::nullopt;
  std::optional<Vec3> found;
  const auto take_first = [&](int, int, Vec3 at) { return found = at, true; };
  edges_through_faces(a, b, *limits, depth, take_first);
  if (!found) edges_through_faces(b, a, *limits, depth, take_first);
  return found;
}

std::optional<Vec3> find_self_crossing(const SurfaceView& surface, double depth) {
  std::optional<Vec3> found;
  edges_through_own_faces(surface, depth, [&](int, int, Vec3 at) { return found = at, true; });
  return found;
}

FacePairs find_crossing_faces(const SurfaceView& a, const SurfaceView& b, double depth) {
  FacePairs found;
  const auto limits = common_box(a, b, depth);
  if (!limits) return found;
  edges_through_faces(a, b, *limits, depth, [&](int e, int f, Vec3) {
    add_faces_of_edge(a, e, found.of_a);
    found.of_b.push_back(f);
    return false;
  });
  edges_through_faces(b, a, *limits, depth, [&](int e, int f, Vec3) {
    add_faces_of_edge(b, e, found.of_b);
    found.of_a.push_back(f);
    return false;
  });
  sort_once(found.of_a);
  sort_once(found.of_b);
  return found;
}

std::vector<int> find_self_crossing_faces(const SurfaceView& surface, double depth) {
  std::vector<int> faces;
  edges_through_own_faces(surface, depth, [&](int e, int f, Vec3) {
    add_faces_of_edge(surface, e, faces);
    faces.push_back(f);
    return false;
  });
  sort_once(faces);
  return faces;
}

std::optional<Vec3> find_common_sheet(const SurfaceView& a, const SurfaceView& b, double depth) {
  const auto limits = common_box(a, b, depth);
  if (!limits) return std::nullopt;
  const auto first = items_within(*limits, a.mesh.vertices_of_face(), a.positions);
  auto second = items_within(*limits, b.mesh.vertices_of_face(), b.positions);
  const Vec3 margin{depth, depth, depth};
  for (Item& item : second) item.box = {item.box.lower - margin, item.box.upper + margin};
  std::optional<Vec3> found;
  any_pair(first, second, [&](int f, int g) {
    const Triangle of_a = triangle_of(a, f), of_b = triangle_of(b, g);
    const Vec3 middle = (of_a[0] + of_a[1] + of_a[2]) / 3.0;
    const Vec3 normal_a = normalized(cross(of_a[1] - of_a[0], of_a[2] - of_a[0]));
    const Vec3 normal_b = normalized(cross(of_b[1] - of_b[0], of_b[2] - of_b[0]));
    const double off_plane = std::abs(dot(normal_b, middle - of_b[0]));
    if (off_plane > depth || norm(cross(normal_a, normal_b)) > 1e-6) return false;
    if (norm(nearest_point(middle, of_b) - middle) > 2 * depth) return false;
    found = middle;
    return true;
  });
  return found;
}

}  // namespace pliant
