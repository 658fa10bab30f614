#include "coupling/one_way.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "loads/traction.hpp"
#include "structure/advance_vertices.hpp"
#include "structure/stable_time_step.hpp"

namespace pliant {
namespace {

constexpr double most_substeps = 1e6;

int count_substeps(const DeformableBody& body, const VertexLoads& loads, double step) {
  if (body.substeps) return *body.substeps;
  const double count = std::ceil(step / (substep_safety * stable_time_step(body, loads.drag)));
  if (!(count <= most_substeps))
    throw RunError(
        fmt::format("body '{}': a fluid step of {:g} would need {:g} substeps; take a smaller fluid step, softer "
                    "potentials or a larger mass_per_vertex",
                    body.name, step, count));
  return std::max(1, static_cast<int>(count));
}

}  // namespace

int advance_one_way(DeformableBody& body, const FlowSampler& flow, const FluidConfig& fluid, double step) {
  if (body.motion == MotionKind::fixed) return 0;
  const Traction traction(body, flow, fluid);
  ShapeState shape(body.mesh, body.positions);
  VertexLoads loads;
  traction.evaluate(body, shape, loads);
  const int substeps = count_substeps(body, loads, step);
  for (int i = 0; i < substeps; ++i) {
    advance_vertices(body, shape, loads, step / substeps);
    shape.update(body.positions);
    if (i + 1 < substeps) traction.evaluate(body, shape, loads);
  }
  require_finite(body);
  return substeps;
}

}  // namespace pliant
