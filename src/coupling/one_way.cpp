#include "coupling/one_way.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "loads/traction.hpp"
#include "parallel/agree.hpp"
#include "structure/advance_vertices.hpp"
#include "structure/stable_time_step.hpp"
#include "transfer/point_router.hpp"

namespace pliant {
namespace {

int count_substeps(const DeformableBody& body, const VertexLoads& loads, double step) {
  return body.substeps ? *body.substeps : substeps_for(step, stable_time_step(body, loads.drag), body.name);
}

std::string find_outside(const DeformableBody& body, std::span<const Vec3> points, const PointRouter& box) {
  const auto outside = box.first_outside(points);
  if (outside == points.size()) return {};
  const Vec3 x = points[outside];
  return fmt::format("body '{}': the flow was asked for at ({:.6g}, {:.6g}, {:.6g}), which is outside the box; {}",
                     body.name, x.x, x.y, x.z, explain_outside(body.traction));
}

int advance_in(const Traction& traction, DeformableBody& body, SurfaceContact* contact, double step) {
  ShapeState shape(body.mesh, body.positions);
  VertexLoads loads;
  traction.evaluate(body, shape, loads);
  const int substeps = count_substeps(body, loads, step);
  for (int i = 0; i < substeps; ++i) {
    if (contact != nullptr) advance_vertices(body, shape, loads, step / substeps, *contact, i * step / substeps);
    else advance_vertices(body, shape, loads, step / substeps);
    shape.update(body.positions);
    if (i + 1 < substeps) traction.evaluate(body, shape, loads);
  }
  require_finite(body);
  return substeps;
}

}  // namespace

int advance_one_way(DeformableBody& body, const FlowSampler& flow, const FluidConfig& fluid, double step) {
  if (body.motion == MotionKind::fixed) return 0;
  return advance_in(Traction(body, flow, fluid), body, nullptr, step);
}

void advance_one_way(Bodies& bodies, const FlowSampler& flow, const FluidConfig& fluid, Contact& contact, double step,
                     ContactPass pass) {
  std::vector<Body*> moved;
  std::vector<Vec3> points;
  std::vector<std::size_t> begin(1, 0);
  std::string problem;
  for (Body& body : bodies.own()) {
    if (bodies.kind_of(body).coupling != CouplingKind::one_way || bodies.kind_of(body).has_pose()) continue;
    const auto of_body = traction_points(body.surface);
    moved.push_back(&body);
    points.insert(points.end(), of_body.begin(), of_body.end());
    begin.push_back(points.size());
  }
  const auto& ranks = bodies.grid().ranks();
  const PointRouter box(bodies.grid());
  for (std::size_t b = 0; b < moved.size() && problem.empty(); ++b)
    problem = find_outside(moved[b]->surface, std::span(points).subspan(begin[b], begin[b + 1] - begin[b]), box);
  agree(ranks, problem);
  std::vector<FlowSample> samples(points.size());
  flow.sample(points, samples);
  contact.begin(bodies, step, PosedBodies::at_its_end);
  for (std::size_t b = 0; b < moved.size() && problem.empty(); ++b) {
    const auto n = begin[b + 1] - begin[b];
    auto& body = moved[b]->surface;
    try {
      advance_in(Traction(std::span(points).subspan(begin[b], n), std::span(samples).subspan(begin[b], n), fluid), body,
                 contact.of(*moved[b]), step);
    } catch (const RunError& error) { problem = error.what(); }
  }
  agree(ranks, problem);
  contact.end(bodies, step, pass);
}

}  // namespace pliant
