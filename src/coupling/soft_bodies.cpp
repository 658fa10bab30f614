#include "coupling/soft_bodies.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "mesh/geometry.hpp"
#include "parallel/agree.hpp"
#include "structure/advance_vertices.hpp"
#include "structure/interface_mesh.hpp"

namespace pliant {

SoftBodies::SoftBodies(const Grid& grid, const CaseConfig& config, Bodies& bodies, Contact& contact,
                       CouplingKind coupling)
    : grid_(grid),
      bodies_(bodies),
      contact_(contact),
      coupling_(coupling),
      transfer_(grid, config.fluid.density),
      gravity_(config.forcing.gravity),
      density_(config.fluid.density),
      spacing_(grid.mean_spacing()),
      shapes_(bodies.kinds().size()) {
  any_ = std::any_of(bodies.kinds().begin(), bodies.kinds().end(),
                     [&](const BodyKind& kind) { return !kind.has_pose() && kind.coupling == coupling; });
}

void SoftBodies::adopt_flow(const FlowState& flow) {
  place();
  std::vector<Vec3> velocities;
  transfer_.find_velocities(flow.u.view(), flow.v.view(), flow.w.view(), velocities);
  for (const auto& part : transfer_.parts()) {
    auto& surface = part.body->surface;
    const auto found = part.of(velocities);
    const Vec3 mean = part.kind->config.held ? mean_of(part, found) : Vec3{};
    // A flag that came with the stream would be thrown back by its pole.
    const bool at_rest = !surface.pinned.empty();
    for (std::size_t v = 0; v < found.size(); ++v) surface.velocities[v] = at_rest ? Vec3{} : found[v] - mean;
    part.body->mass_velocities = surface.velocities;
    if (surface.is_interface) keep_normal_part(surface.mesh, surface.positions, surface.velocities);
    part.body->pose.center = mean_position(surface.positions);
  }
}

const ShapeState& SoftBodies::shape_of(const VertexTransfer::Part& part) {
  auto& shape = shapes_[part.body->kind];
  if (!shape) shape.emplace(part.kind->prototype.mesh);
  shape->update(part.body->surface.positions);
  return *shape;
}

void SoftBodies::find_forces(std::vector<Vec3>& forces) {
  forces.resize(transfer_.n_vertices());
  for (const auto& part : transfer_.parts()) {
    const auto of_body = part.of(forces);
    find_nodal_forces(*part.body, *part.kind, shape_of(part), gravity_, density_, of_body);
    std::copy(of_body.begin(), of_body.end(), part.body->surface.forces.begin());
  }
}

void SoftBodies::begin_step() {
  elapsed_ = 0;
  for (const auto& part : transfer_.parts()) part.body->loads.reaction = part.body->loads.balance = {};
}

// An even pressure on a surface that separates two parts of the box does no work on fluid that keeps its volume; but
// spread to the grid it is not the gradient of any discrete pressure, and what is left of it drives currents around a
// drop at rest. So the even part of the forces, by least squares with the areas as weights, stays out of the flow, and
// out of its pressure.
void SoftBodies::remove_mean_pressure(const VertexTransfer::Part& part, std::span<Vec3> forces) const {
  const auto& surface = part.body->surface;
  const auto gradient = volume_gradient(surface.mesh, surface.positions);
  double work = 0, squares = 0;
  for (std::size_t v = 0; v < forces.size(); ++v) {
    if (surface.is_pinned(v)) continue;
    const double area = transfer_.areas()[part.begin + v];
    work += dot(forces[v], gradient[v]) / area;
    squares += dot(gradient[v], gradient[v]) / area;
  }
  for (std::size_t v = 0; v < forces.size(); ++v)
    if (!surface.is_pinned(v)) forces[v] -= (work / squares) * gradient[v];
}

void SoftBodies::count_impulse(const VertexTransfer::Part& part, std::span<const Vec3> impulses) {
  auto& load = part.body->loads.reaction;
  load = load + total_load(part.body->surface.positions, impulses, part.body->pose.center);
}

std::vector<double> SoftBodies::layered_masses(const VertexTransfer::Part& part) const {
  auto masses = part.body->surface.masses;
  for (std::size_t v = 0; v < masses.size(); ++v) masses[v] += layer() * transfer_.areas()[part.begin + v];
  return masses;
}

Vec3 SoftBodies::mean_of(const VertexTransfer::Part& part, std::span<const Vec3> of_body) const {
  Vec3 sum;
  double area = 0;
  for (std::size_t v = 0; v < of_body.size(); ++v) {
    const double a = transfer_.areas()[part.begin + v];
    sum += a * of_body[v];
    area += a;
  }
  return sum / area;
}

void SoftBodies::measure_slip(const FlowState& flow) {
  place();
  std::vector<Vec3> found, normals;
  transfer_.find_velocities(flow.u.view(), flow.v.view(), flow.w.view(), found);
  for (const auto& part : transfer_.parts()) {
    const auto& surface = part.body->surface;
    normals.assign(surface.positions.size(), Vec3{});
    for (const Face& face : surface.mesh.vertices_of_face())
      for (int v : face) normals[static_cast<std::size_t>(v)] += face_vector(face, surface.positions);
    for (Vec3& n : normals) n = normalized(n);
    part.body->slip = pliant::measure_slip(part.of(found), surface.velocities, normals,
                                           transfer_.areas().subspan(part.begin, part.size()));
  }
}

void SoftBodies::finish(double step) {
  std::string problem;
  for (const auto& part : transfer_.parts()) {
    Body& body = *part.body;
    // What the flow was given, it has taken from the body.
    auto& load = body.loads.reaction;
    load.force *= -1 / step;
    load.torque *= -1 / step;
    body.loads.balance = load;
    if (part.kind->restores_volume)
      body.volume_restored +=
          restore_volume(body.surface, part.kind->displaced.volume, body.in_contact) / part.kind->displaced.volume;
    body.pose.center = mean_position(body.surface.positions);
    try {
      require_finite(body.surface);
    } catch (const RunError& error) {
      if (problem.empty()) problem = error.what();
    }
  }
  agree(grid_.ranks(), problem);
}

}  // namespace pliant
