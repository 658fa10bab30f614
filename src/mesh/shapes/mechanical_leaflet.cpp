#include "mesh/shapes/mechanical_leaflet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "mesh/shapes/patch_mesher.hpp"
#include "mesh/shapes/shape_parts.hpp"

namespace pliant {
namespace {
constexpr double degree = std::numbers::pi / 180;

/// Points on an arc of the curve, its ends included, at even distances along it.
template <class Curve>
std::vector<Vec3> spread_evenly(const Curve& curve, double begin, double end, double edge) {
  constexpr int fine = 4096;
  std::vector<double> length{0};
  Vec3 last = curve(begin);
  for (int i = 1; i <= fine; ++i) {
    const Vec3 x = curve(begin + (end - begin) * i / fine);
    length.push_back(length.back() + norm(x - last));
    last = x;
  }
  const int n = parts_of(length.back(), edge);
  std::vector<Vec3> points{curve(begin)};
  for (int i = 1, at = 0; i < n; ++i) {
    const double wanted = length.back() * i / n;
    while (length[at + 1] < wanted) ++at;
    const double place = at + (wanted - length[at]) / (length[at + 1] - length[at]);
    points.push_back(curve(begin + (end - begin) * place / fine));
  }
  points.push_back(curve(end));
  return points;
}
}  // namespace

Surface make_mechanical_leaflet(const MechanicalLeafletSizes& sizes) {
  ShapeChecks checks("mechanical-leaflet");
  checks.positive("radius", sizes.radius);
  checks.edge(sizes.edge, sizes.radius, std::numbers::pi * sizes.radius * sizes.radius);
  checks.finish();
  const double diameter = 2 * sizes.radius, offset = sizes.hinge_offset * diameter;
  const double reach = sizes.radius - sizes.clearance * diameter, tilt = std::cos(sizes.closed_angle * degree);
  if (!(sizes.closed_angle >= 0 && sizes.closed_angle <= 80))
    throw InputError(
        fmt::format("mechanical-leaflet: closed_angle = {} must be from 0 to 80 degrees", sizes.closed_angle));
  if (!(sizes.clearance >= 0 && 0.5 * sizes.clearance < sizes.hinge_offset && offset < 0.9 * reach))
    throw InputError(fmt::format(
        "mechanical-leaflet: hinge_offset = {} and clearance = {} leave no room; the hinge lies between the "
        "straight edge, half a clearance off the middle, and the wall",
        sizes.hinge_offset, sizes.clearance));
  // Half the width at the hinge; how far the short part reaches.
  const double width = std::sqrt(reach * reach - offset * offset),
               back = (offset - 0.5 * sizes.clearance * diameter) / tilt;
  const double edge = std::min(sizes.edge, std::min(width, back));
  const double end = std::atan2(width, offset);

  std::vector<Vec3> loop;
  ShapeParts parts;
  parts.selections = {{"hinge-axis", {}}, {"straight-edge", {}}, {"arc", {}}};
  const auto add_line = [&](Vec3 from, Vec3 to, bool with_end) {
    const int n = parts_of(norm(to - from), edge);
    for (int i = 0; i < n + (with_end ? 1 : 0); ++i)
      loop.push_back(i == n ? to : from + (static_cast<double>(i) / n) * (to - from));
  };
  const Vec3 right{0, -width, 0}, left{0, width, 0}, right_end{-back, -width, 0}, left_end{-back, width, 0};
  add_line(right_end, right, false);
  const int arc_begin = static_cast<int>(loop.size());
  auto arc = spread_evenly(
      [&](double angle) {
        return Vec3{(reach * std::cos(angle) - offset) / tilt, reach * std::sin(angle), 0};
      },
      -end, end, edge);
  arc.front() = right;
  arc.back() = left;
  loop.insert(loop.end(), arc.begin(), arc.end() - 1);
  const int arc_end = static_cast<int>(loop.size());
  add_line(left, left_end, false);
  const int straight_begin = static_cast<int>(loop.size());
  add_line(left_end, right_end, false);
  parts.selections[0].vertices = {arc_begin, arc_end};
  for (int v = straight_begin; v < static_cast<int>(loop.size()); ++v) parts.selections[1].vertices.push_back(v);
  parts.selections[1].vertices.push_back(0);
  for (int v = arc_begin; v <= arc_end; ++v) parts.selections[2].vertices.push_back(v);

  Patch patch;
  patch.surface = [](ChartPoint p) { return Vec3{p[0], p[1], 0}; };
  patch.edge = [edge](Vec3) { return edge; };
  for (const Vec3 x : loop) patch.outline.push_back({{x.x, x.y}, x});
  patch.middle = {0.3 * sizes.radius, 0};
  PatchMesh mesh = mesh_patch(patch);
  parts.positions = std::move(mesh.positions);
  parts.faces = std::move(mesh.faces);
  return finish_shape(parts);
}

Surface make_bileaflet_valve(const MechanicalLeafletSizes& sizes, double angle) {
  const Surface leaflet = make_mechanical_leaflet(sizes);
  const double c = std::cos(angle * degree), s = std::sin(angle * degree),
               offset = 2 * sizes.radius * sizes.hinge_offset;
  ShapeParts parts;
  for (const double side : {-1.0, 1.0}) {
    const int first = static_cast<int>(parts.positions.size());
    for (const Vec3 x : leaflet.positions) parts.add_vertex({side * (offset + c * x.x), side * x.y, -s * x.x});
    for (const Face& face : leaflet.mesh.vertices_of_face())
      parts.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
    for (const auto& selection : leaflet.selections) {
      auto& named = parts.selections.emplace_back(selection);
      named.name = (side < 0 ? "left-" : "right-") + named.name;
      for (int& v : named.vertices) v += first;
    }
  }
  return finish_shape(parts);
}

}  // namespace pliant
