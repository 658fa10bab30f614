#include "coupling/surface_stress.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/error.hpp"
#include "coupling/forced_vertices.hpp"
#include "parallel/agree.hpp"
#include "transfer/point_router.hpp"

namespace pliant {
namespace {

bool is_asked(const BodyKind& kind, StressOf which) {
  if (!kind.acts_on_flow() || kind.config.traction.form == TractionForm::none) return false;
  return which == StressOf::all || kind.is_driven_by_probes();
}

void set_sites_of(Body& body, const BodyKind& kind) {
  const auto& surface = body.surface;
  std::vector<Vec3> accelerations(surface.positions.size());
  for (std::size_t v = 0; v < accelerations.size(); ++v)
    if (kind.has_pose()) accelerations[v] = acceleration_at(body.pose, body.acceleration, surface.positions[v]);
    else if (!body.accelerations.empty()) accelerations[v] = body.accelerations[v];
  set_sites(surface.mesh, surface.positions, surface.velocities, accelerations, body.sites);
}

void forget(Body& body) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Vec3 nothing{none, none, none};
  const std::size_t n = body.sites.size();
  body.loads.probes = {nothing, nothing};
  body.stresses = {};
  body.stresses.outer = {std::vector<double>(n, none), std::vector<Vec3>(n, nothing)};
  body.stresses.forces.assign(n, nothing);
}

struct Asked {
  std::size_t body, begin, end;
};

}  // namespace

void find_stresses(Bodies& bodies, const FlowSampler& flow, const Grid& grid, Vec3 driving, StressOf which) {
  const PointRouter box(grid);
  std::vector<Vec3> points, of_body;
  std::vector<Asked> asked;
  std::string problem;
  const auto own = bodies.own();
  for (std::size_t b = 0; b < own.size(); ++b) {
    Body& body = own[b];
    const auto& kind = bodies.kind_of(body);
    if (!is_asked(kind, which) || !bodies.is_on(body)) continue;
    set_sites_of(body, kind);
    probe_points(body.sites, kind.probes, of_body);
    const auto outside = box.first_outside(of_body);
    if (outside < of_body.size()) {
      const Vec3 x = of_body[outside];
      forget(body);
      if (which == StressOf::driven && problem.empty())
        problem = fmt::format(
            "body '{}' has come too close to a side of the box: a probe of its loads, of length {:.4g}, ends outside "
            "at "
            "({:.6g}, {:.6g}, {:.6g}); use loads = \"momentum-balance\", a shorter traction.probe_length, or a "
            "repulsion from the walls (repulsion.range)",
            body.name(), kind.probes.length, x.x, x.y, x.z);
      continue;
    }
    asked.push_back({b, points.size(), points.size() + of_body.size()});
    points.insert(points.end(), of_body.begin(), of_body.end());
  }
  agree(grid.ranks(), problem);
  std::vector<FlowSample> samples(points.size());
  flow.sample(points, samples);
  for (const Asked& a : asked) {
    Body& body = own[a.body];
    auto probes = bodies.kind_of(body).probes;
    probes.body_force = driving;
    evaluate_probes(body.sites, probes, std::span(samples).subspan(a.begin, a.end - a.begin), body.stresses);
    if (const auto& kind = bodies.kind_of(body); !kind.has_pose() && kind.is_driven_by_probes())
      adopt_probe_forces(body);
    body.loads.probes = total_load(body.sites.positions, body.stresses.forces, body.pose.center);
  }
}

}  // namespace pliant
