#include "coupling/soft_bodies.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "mesh/geometry.hpp"
#include "parallel/agree.hpp"
#include "structure/advance_vertices.hpp"

namespace pliant {

SoftBodies::SoftBodies(const Grid& grid, const CaseConfig& config, Bodies& bodies, CouplingKind coupling)
    : grid_(grid),
      bodies_(bodies),
      coupling_(coupling),
      transfer_(grid, config.fluid.density),
      gravity_(config.forcing.gravity),
      density_(config.fluid.density),
      spacing_(grid.mean_spacing()),
      shapes_(bodies.kinds().size()) {
  any_ = std::any_of(bodies.kinds().begin(), bodies.kinds().end(),
                     [&](const BodyKind& kind) { return !kind.has_pose() && kind.coupling == coupling; });
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
  for (const auto& part : transfer_.parts()) part.body->loads.reaction = part.body->loads.balance = {};
}

void SoftBodies::count_impulse(const VertexTransfer::Part& part, std::span<const Vec3> impulses) {
  auto& load = part.body->loads.reaction;
  load = load + total_load(part.body->surface.positions, impulses, part.body->pose.center);
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
      body.volume_restored += restore_volume(body.surface, part.kind->displaced.volume) / part.kind->displaced.volume;
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
