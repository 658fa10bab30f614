#include "coupling/immersed_boundary.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>

#include "core/error.hpp"
#include "mesh/geometry.hpp"
#include "parallel/agree.hpp"

namespace pliant {
namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

template <class T>
std::span<const T> part(const std::vector<T>& all, std::size_t begin, std::size_t end) {
  return std::span(all).subspan(begin, end - begin);
}
std::span<const Vec3> part(std::span<const Vec3> all, std::size_t begin, std::size_t end) {
  return all.subspan(begin, end - begin);
}

MarkerGroup group_for(const BodyKind& kind) {
  return kind.config.motion == MotionKind::fixed ? MarkerGroup::fixed : MarkerGroup::moving;
}

/// The flow has to follow it in the present step, in this group.
bool belongs(const Bodies& bodies, std::size_t kind, MarkerGroup group) {
  const BodyKind& of = bodies.kinds()[kind];
  return of.forces_flow() && bodies.is_on(kind) && group_for(of) == group;
}
bool belongs(const Bodies& bodies, const Body& body, MarkerGroup group) { return belongs(bodies, body.kind, group); }

/// Whether a kind of the group is one of those asked for; the same on all ranks.
template <class IsAsked>
bool has_any(const Bodies& bodies, MarkerGroup group, IsAsked is_asked) {
  for (std::size_t k = 0; k < bodies.kinds().size(); ++k)
    if (belongs(bodies, k, group) && is_asked(bodies.kinds()[k])) return true;
  return false;
}
bool has_sheets(const Bodies& bodies, MarkerGroup group) {
  return has_any(bodies, group, [](const BodyKind& kind) { return kind.is_thin_sheet(); });
}
bool has_fixed(const Bodies& bodies) {
  return has_any(bodies, MarkerGroup::fixed, [](const BodyKind&) { return true; });
}

/// Mean velocity and rotation of markers, weighted by area: exact if they move as a rigid body.
RigidState rigid_fit(std::span<const Vec3> positions, std::span<const Vec3> velocities, std::span<const double> areas,
                     Vec3 center) {
  double area = 0;
  Vec3 mean_x, mean_u;
  for (std::size_t m = 0; m < positions.size(); ++m) {
    area += areas[m];
    mean_x += areas[m] * positions[m];
    mean_u += areas[m] * velocities[m];
  }
  mean_x = mean_x / area;
  mean_u = mean_u / area;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Vec3 momentum;
  for (std::size_t m = 0; m < positions.size(); ++m) {
    const Vec3 r = positions[m] - mean_x;
    const Eigen::Vector3d e(r.x, r.y, r.z);
    inertia += areas[m] * (e.squaredNorm() * Eigen::Matrix3d::Identity() - e * e.transpose());
    momentum += areas[m] * cross(r, velocities[m] - mean_u);
  }
  const Eigen::Vector3d omega = inertia.fullPivLu().solve(Eigen::Vector3d(momentum.x, momentum.y, momentum.z));
  RigidState fit;
  fit.angular_velocity = {omega[0], omega[1], omega[2]};
  fit.velocity = mean_u + cross(fit.angular_velocity, center - mean_x);
  return fit;
}

/// Means of markers around each vertex, weighted by area.
void adopt_vertex_velocities(Body& body, const BodyKind& kind, std::span<const Vec3> velocities,
                             std::span<const double> areas) {
  auto& surface = body.surface;
  std::vector<Vec3> weighted(velocities.size());
  for (std::size_t m = 0; m < weighted.size(); ++m) weighted[m] = areas[m] * velocities[m];
  std::fill(surface.velocities.begin(), surface.velocities.end(), Vec3{});
  kind.layout.add_to_vertices(weighted, surface.velocities);
  const auto of_vertices = vertex_areas(surface.mesh, surface.positions);
  for (std::size_t v = 0; v < of_vertices.size(); ++v) {
    if (surface.is_pinned(v)) surface.velocities[v] = {};
    else surface.velocities[v] *= 1 / of_vertices[v];
  }
}

void tell(Body& body, const BodyKind& kind) {
  body.told = body.pose;
  if (kind.has_pose()) return;
  body.told_positions = body.surface.positions;
  body.told_velocities = body.surface.velocities;
}

}  // namespace

ImmersedBoundary::ImmersedBoundary(const Grid& grid, const CaseConfig& config)
    : grid_(grid),
      density_(config.fluid.density),
      viscosity_(config.fluid.viscosity / config.fluid.density),
      carries_forces_(config.immersed_boundary.carry_forces),
      forcing_(grid, config.fluid.density, config.immersed_boundary.forcing_iterations),
      groups_{Group(grid), Group(grid)} {}

void ImmersedBoundary::gather(const Bodies& bodies, MarkerGroup which, Group& group) const {
  group.parts.clear();
  for (auto* vectors : {&group.markers.positions, &group.markers.velocities, &group.markers.normals}) vectors->clear();
  group.markers.areas.clear();
  MarkerSet& of_body = group.of_body;
  for (const Body& body : bodies.own()) {
    const auto& kind = bodies.kind_of(body);
    if (!belongs(bodies, body, which)) continue;
    if (kind.has_pose()) {
      group.positions.resize(kind.reference.size());
      group.velocities.resize(kind.reference.size());
      place_vertices(body.told, kind.reference, group.positions, group.velocities);
    } else {
      group.positions = body.told_positions;
      group.velocities = body.told_velocities;
    }
    kind.layout.place_inside(group.positions, group.velocities, kind.retraction, of_body);
    const std::size_t begin = group.markers.areas.size();
    append(group.markers.positions, of_body.positions);
    append(group.markers.velocities, of_body.velocities);
    append(group.markers.normals, of_body.normals);
    append(group.markers.areas, of_body.areas);
    group.parts.push_back({body.id, begin, group.markers.areas.size()});
  }
}

std::string ImmersedBoundary::find_outside(const Bodies& bodies, MarkerGroup which) const {
  const auto& router = groups_[static_cast<std::size_t>(which)].router;
  for (const Body& body : bodies.own()) {
    if (!belongs(bodies, body, which)) continue;
    const auto vertex = router.first_outside(body.surface.positions);
    if (vertex == body.surface.positions.size()) continue;
    const Vec3 x = body.surface.positions[vertex];
    return fmt::format(
        "body '{}' has left the box: its vertex {} is at ({:.6g}, {:.6g}, {:.6g}); use a larger box, a repulsion from "
        "the walls (repulsion.range), or, if it was thrown out, a smaller step or coupling = {}",
        body.name(), vertex, x.x, x.y, x.z,
        bodies.kind_of(body).has_pose() ? "\"strong\"" : "\"force-spreading\" or \"local-mass\"");
  }
  return {};
}

void ImmersedBoundary::place(Bodies& bodies, MarkerGroup which) {
  agree(grid_.ranks(), find_outside(bodies, which));
  for (Body& body : bodies.own())
    if (belongs(bodies, body, which)) tell(body, bodies.kind_of(body));
  place_as_told(bodies, which);
}

void ImmersedBoundary::place_as_told(const Bodies& bodies, MarkerGroup which) {
  auto& group = group_of(which);
  gather(bodies, which, group);
  group.arrangement = bodies.arrangement();
  group.router.route(group.markers.positions);
  group.router.send(group.markers.velocities, group.held_vectors);
  group.router.send(group.markers.areas, group.held_areas);
  forcing_.place(group.router.held(), group.held_areas, group.held_vectors, which);
  if (has_sheets(bodies, which)) place_sheets(bodies, group, which);
}

void ImmersedBoundary::place_sheets(const Bodies& bodies, Group& group, MarkerGroup which) {
  group.own_vectors.assign(group.markers.areas.size(), Vec3{});
  for (const Part& p : group.parts)
    if (bodies.kind_of(*bodies.find(p.body)).is_thin_sheet())
      std::copy(group.markers.normals.begin() + static_cast<std::ptrdiff_t>(p.begin),
                group.markers.normals.begin() + static_cast<std::ptrdiff_t>(p.end),
                group.own_vectors.begin() + static_cast<std::ptrdiff_t>(p.begin));
  group.router.send(group.own_vectors, group.held_vectors);
  forcing_.set_sheets(
      group.held_vectors, viscosity_,
      [&group](std::vector<Vec3>& held) {
        group.own_vectors.resize(group.markers.areas.size());
        group.router.collect(held, group.own_vectors);
        group.router.send(group.own_vectors, held);
      },
      which);
}

void ImmersedBoundary::begin_step(const Bodies& bodies) {
  if (!carries_forces_ || !has_fixed(bodies)) return;
  auto& group = group_of(MarkerGroup::fixed);
  group.own_vectors.assign(group.markers.areas.size(), Vec3{});
  for (const Part& p : group.parts) {
    const auto& carried = bodies.find(p.body)->carried_forces;
    std::copy(carried.begin(), carried.end(), group.own_vectors.begin() + static_cast<std::ptrdiff_t>(p.begin));
  }
  group.router.send(group.own_vectors, group.held_vectors);
  forcing_.carry(group.held_vectors, MarkerGroup::fixed);
}

void ImmersedBoundary::end_step(Bodies& bodies) {
  if (!carries_forces_ || !has_fixed(bodies)) return;
  auto& group = group_of(MarkerGroup::fixed);
  group.held_vectors.assign(group.router.held().size(), Vec3{});
  group.own_vectors.resize(group.markers.areas.size());
  forcing_.add_carried(group.held_vectors, MarkerGroup::fixed);
  group.router.collect(group.held_vectors, group.own_vectors);
  for (const Part& p : group.parts) {
    const auto own = part(group.own_vectors, p.begin, p.end);
    bodies.find(p.body)->carried_forces.assign(own.begin(), own.end());
  }
}

void ImmersedBoundary::find_reactions(Bodies& bodies, MarkerGroup which, double step, Vec3 driving) {
  auto& group = group_of(which);
  auto& forces = group.own_vectors;
  group.held_vectors.assign(group.router.held().size(), Vec3{});
  forces.resize(group.markers.areas.size());
  forcing_.add_forces(group.held_vectors, which);
  group.router.collect(group.held_vectors, forces);
  for (const Part& p : group.parts) {
    Body& body = *bodies.find(p.body);
    const auto& kind = bodies.kind_of(body);
    auto& loads = body.loads;
    loads.reaction =
        total_load(part(group.markers.positions, p.begin, p.end), part(forces, p.begin, p.end), body.told.center);
    loads.balance = loads.reaction;
    if (!kind.has_pose()) {
      body.flow_forces.assign(body.surface.positions.size(), Vec3{});
      kind.layout.add_to_vertices(part(forces, p.begin, p.end), body.flow_forces);
      continue;  // there is fluid on both sides of its wall
    }
    if (!kind.is_closed()) continue;
    const double per_step = 1 / step;
    const InnerMotion motion{per_step * (body.told.velocity - body.told_before.velocity),
                             per_step * (body.told.angular_velocity - body.told_before.angular_velocity),
                             0.5 * (body.told.angular_velocity + body.told_before.angular_velocity)};
    const InnerFluid inner{density_, enclosed_moments(body.surface.mesh, body.surface.positions), driving};
    loads.balance = momentum_balance(loads.reaction, inner, motion, body.told.center);
  }
}

std::span<const Vec3> ImmersedBoundary::flow_at_markers(const FlowState& flow, MarkerGroup which) {
  auto& group = group_of(which);
  group.held_vectors.assign(group.router.held().size(), Vec3{});
  group.own_vectors.resize(group.markers.areas.size());
  forcing_.add_velocities(flow.u.view(), flow.v.view(), flow.w.view(), group.held_vectors, which);
  group.router.collect(group.held_vectors, group.own_vectors);
  return group.own_vectors;
}

// Along a thin sheet the interpolated velocity is not that of the sheet (DirectForcing): only what passes it is slip.
void ImmersedBoundary::leave_out_along(const Bodies& bodies, Group& group) {
  for (const Part& p : group.parts) {
    if (!bodies.kind_of(*bodies.find(p.body)).is_thin_sheet()) continue;
    for (std::size_t m = p.begin; m < p.end; ++m) {
      const Vec3 normal = group.markers.normals[m], velocity = group.markers.velocities[m];
      group.own_vectors[m] = velocity + dot(group.own_vectors[m] - velocity, normal) * normal;
    }
  }
}

void ImmersedBoundary::measure_slip(Bodies& bodies, const FlowState& flow) {
  // The markers of a body that has changed ranks since the step are with its old one.
  if (group_of(MarkerGroup::moving).arrangement != bodies.arrangement()) place_as_told(bodies, MarkerGroup::moving);
  for (const MarkerGroup which : {MarkerGroup::fixed, MarkerGroup::moving}) {
    const auto velocities = flow_at_markers(flow, which);
    auto& group = group_of(which);
    leave_out_along(bodies, group);
    for (const Part& p : group.parts)
      bodies.find(p.body)->slip =
          pliant::measure_slip(part(velocities, p.begin, p.end), part(group.markers.velocities, p.begin, p.end),
                               part(group.markers.normals, p.begin, p.end), part(group.markers.areas, p.begin, p.end));
  }
}

void ImmersedBoundary::adopt_inner_motion(Bodies& bodies, const FlowState& flow) {
  adopt_inner_motion(bodies, flow, [](const Body&) { return true; });
}

void ImmersedBoundary::follow_schedules(Bodies& bodies, const FlowState& flow, std::span<const std::size_t> changed) {
  for (const MarkerGroup which : {MarkerGroup::fixed, MarkerGroup::moving})
    if (std::any_of(changed.begin(), changed.end(),
                    [&](std::size_t kind) { return group_for(bodies.kinds()[kind]) == which; }))
      place(bodies, which);
  adopt_inner_motion(bodies, flow, [&](const Body& body) {
    return std::find(changed.begin(), changed.end(), body.kind) != changed.end();
  });
}

void ImmersedBoundary::adopt_inner_motion(Bodies& bodies, const FlowState& flow,
                                          const std::function<bool(const Body&)>& is_asked) {
  for (const MarkerGroup which : {MarkerGroup::fixed, MarkerGroup::moving}) {
    const auto velocities = flow_at_markers(flow, which);
    const auto& group = group_of(which);
    for (const Part& p : group.parts) {
      Body& body = *bodies.find(p.body);
      if (!is_asked(body)) continue;
      if (!bodies.kind_of(body).has_pose()) {
        adopt_vertex_velocities(body, bodies.kind_of(body), part(velocities, p.begin, p.end),
                                part(group.markers.areas, p.begin, p.end));
        continue;
      }
      const RigidState inside =
          rigid_fit(part(group.markers.positions, p.begin, p.end), part(velocities, p.begin, p.end),
                    part(group.markers.areas, p.begin, p.end), body.pose.center);
      body.told_before = body.pose;
      body.told_before.velocity = inside.velocity;
      body.told_before.angular_velocity = inside.angular_velocity;
    }
  }
}

}  // namespace pliant
