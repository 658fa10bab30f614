#include "coupling/vertex_transfer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesh/geometry.hpp"
#include "parallel/agree.hpp"
#include "transfer/spread.hpp"

namespace pliant {
namespace {

std::string find_outside(std::span<const VertexTransfer::Part> parts, const PointRouter& router) {
  for (const auto& part : parts) {
    const auto& surface = part.body->surface;
    const auto vertex = router.first_outside(surface.positions);
    if (vertex == surface.positions.size()) continue;
    const Vec3 x = surface.positions[vertex];
    return fmt::format(
        "body '{}' has left the box: its vertex {} is at ({:.6g}, {:.6g}, {:.6g}); use a larger box, a repulsion from "
        "the walls (repulsion.range), or, if it was thrown out, a smaller step",
        surface.name, vertex, x.x, x.y, x.z);
  }
  return {};
}

}  // namespace

VertexTransfer::VertexTransfer(const Grid& grid, double density)
    : grid_(grid), density_(density), router_(grid), markers_(grid), fields_(grid) {}

void VertexTransfer::place(Bodies& bodies, CouplingKind coupling) {
  parts_.clear();
  areas_.clear();
  positions_.clear();
  point_areas_.clear();
  for (Body& body : bodies.own()) {
    const auto& kind = bodies.kind_of(body);
    if (kind.has_pose() || kind.coupling != coupling) continue;
    const auto& surface = body.surface;
    Part part{&body, &kind, areas_.size(), 0, positions_.size()};
    const auto areas = vertex_areas(surface.mesh, surface.positions);
    areas_.insert(areas_.end(), areas.begin(), areas.end());
    if (kind.meets_flow_at_vertices) {
      positions_.insert(positions_.end(), surface.positions.begin(), surface.positions.end());
      point_areas_.insert(point_areas_.end(), areas.begin(), areas.end());
    } else {
      kind.layout.place(surface.positions, surface.velocities, of_body_);
      positions_.insert(positions_.end(), of_body_.positions.begin(), of_body_.positions.end());
      point_areas_.insert(point_areas_.end(), of_body_.areas.begin(), of_body_.areas.end());
    }
    part.end = areas_.size();
    parts_.push_back(part);
  }
  agree(grid_.ranks(), find_outside(parts_, router_));
  router_.route(positions_);
  router_.send(point_areas_, held_areas_);
  markers_.place(router_.held(), held_areas_);
  fields_.reach(markers_);
  vectors_.assign(markers_.padded_size());
}

void VertexTransfer::find_velocities(ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w,
                                     std::vector<Vec3>& of_vertices) {
  interpolate(markers_, u, v, w, vectors_);
  held_vectors_.assign(router_.held().size(), Vec3{});
  const auto indices = markers_.indices();
  for (int c = 0; c < 3; ++c)
    for (std::size_t m = 0; m < indices.size(); ++m)
      held_vectors_[static_cast<std::size_t>(indices[m])][c] = vectors_[c][m];
  at_points_.resize(positions_.size());
  router_.collect(held_vectors_, at_points_);
  of_vertices.assign(areas_.size(), Vec3{});
  for (const Part& part : parts_) {
    const auto to = part.of(of_vertices);
    if (part.kind->meets_flow_at_vertices) {
      std::copy_n(at_points_.begin() + static_cast<std::ptrdiff_t>(part.first_point), to.size(), to.begin());
      continue;
    }
    const auto n_points = static_cast<std::size_t>(part.kind->layout.n_markers());
    const auto at = std::span(at_points_).subspan(part.first_point, n_points);
    for (std::size_t m = 0; m < n_points; ++m) at[m] *= point_areas_[part.first_point + m];
    part.kind->layout.add_to_vertices(at, to);
    for (std::size_t i = 0; i < to.size(); ++i) to[i] *= 1 / areas_[part.begin + i];
  }
}

void VertexTransfer::spread_forces(std::span<const Vec3> of_vertices) {
  std::vector<Vec3>& tractions = held_vectors_;  // not in use until they are sent
  tractions.resize(of_vertices.size());
  for (std::size_t i = 0; i < of_vertices.size(); ++i) tractions[i] = (1 / (areas_[i] * density_)) * of_vertices[i];
  to_points(tractions);
  spread(Amount::traction);
}

void VertexTransfer::spread_increments(std::span<const Vec3> of_vertices) {
  to_points(of_vertices);
  spread(Amount::increment);
}

void VertexTransfer::to_points(std::span<const Vec3> of_vertices) {
  at_points_.resize(positions_.size());
  for (const Part& part : parts_) {
    const auto from = of_vertices.subspan(part.begin, part.size());
    const auto to = std::span(at_points_).subspan(part.first_point);
    if (part.kind->meets_flow_at_vertices) std::copy(from.begin(), from.end(), to.begin());
    else part.kind->layout.interpolate(from, to.first(static_cast<std::size_t>(part.kind->layout.n_markers())));
  }
}

void VertexTransfer::spread(Amount amount) {
  router_.send(at_points_, held_vectors_);
  const auto indices = markers_.indices();
  for (int c = 0; c < 3; ++c) {
    const auto volume = markers_.volume(c);
    for (std::size_t m = 0; m < indices.size(); ++m) {
      const auto point = static_cast<std::size_t>(indices[m]);
      const double value = held_vectors_[point][c];
      // A layer takes increments as they are; tractions belong to its thickness.
      if (amount == Amount::increment) vectors_[c][m] = value;
      else vectors_[c][m] = volume[m] > 0 ? value * held_areas_[point] / volume[m] : 0.0;
    }
  }
  pliant::spread(markers_, vectors_, fields_);
}

}  // namespace pliant
