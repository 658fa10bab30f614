#include "coupling/coupled_flow.hpp"

#include "coupling/one_way.hpp"
#include "coupling/surface_stress.hpp"

namespace pliant {
namespace {

SampledFields fields_of(const FlowSolver& flow) {
  const auto& state = flow.state();
  return {&state.u, &state.v, &state.w, &state.p};
}

}  // namespace

CoupledFlow::CoupledFlow(const CaseConfig& config, FlowSolver& flow, Bodies& bodies, RunStart start)
    : config_(config),
      flow_(flow),
      bodies_(bodies),
      contact_(flow.grid(), config),
      sampler_(flow.grid(), fields_of(flow), config.fluid.density) {
  for (const auto& kind : bodies.kinds()) {
    is_two_way_ |= kind.acts_on_flow();
    has_strong_ |= kind.coupling == CouplingKind::strong;
    has_probe_driven_ |= kind.is_free() && kind.config.loads == LoadSource::probes;
    has_deformable_ |= !kind.has_pose();
  }
  if (!is_two_way_) return;
  boundary_.emplace(flow.grid(), config);
  boundary_->place(bodies_, MarkerGroup::fixed);
  boundary_->place(bodies_, MarkerGroup::moving);
  if (start == RunStart::anew) boundary_->adopt_inner_motion(bodies_, flow_.state());
}

void CoupledFlow::place_markers() {
  if (!is_two_way_) return;
  const auto scope = timer_.measure("bodies: markers");
  boundary_->place(bodies_, MarkerGroup::moving);
}

void CoupledFlow::advance_fluid(double step) {
  last_step_ = step;
  const auto scope = timer_.measure("fluid");
  if (!is_two_way_) {
    flow_.advance(step);
    return;
  }
  flow_.advance(step, [this](const Substep& substep, double dt, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
    const auto forcing = timer_.measure("bodies: forcing, within fluid");
    boundary_->apply(substep, dt, u, v, w);
  });
}

// Samplers read the fields themselves.
void CoupledFlow::settle() {
  const auto scope = timer_.measure("fluid");
  flow_.settle();
}

Vec3 CoupledFlow::driving() const {
  Vec3 sum = config_.forcing.acceleration;
  if (const auto& bulk = config_.forcing.bulk_velocity) sum[static_cast<int>(bulk->axis)] += flow_.bulk_forcing();
  return sum;
}

void CoupledFlow::find_loads(double step) {
  if (!is_two_way_) return;
  if (has_probe_driven_) settle();
  const auto scope = timer_.measure("bodies: loads");
  boundary_->find_reactions(bodies_, MarkerGroup::moving, step, driving());
  if (has_probe_driven_) find_stresses(bodies_, sampler_, flow_.grid(), driving(), StressOf::driven);
  if (contact_.is_wanted()) contact_.find(bodies_);
}

RigidLoad CoupledFlow::load_on(const Body& body) const {
  return total_load(body, bodies_.kind_of(body), {config_.forcing.gravity, driving(), config_.fluid.density});
}

void CoupledFlow::accept() {
  for (Body& body : bodies_.own()) body.told_before = body.told;
}

void CoupledFlow::advance_one_way_bodies(double step) {
  if (!has_deformable_) return;
  settle();
  const auto scope = timer_.measure("bodies: motion");
  advance_one_way(bodies_, sampler_, config_.fluid, contact_, step);
}

void CoupledFlow::diagnose() {
  if (!is_two_way_) return;
  flow_.settle();
  if (last_step_ > 0) boundary_->find_reactions(bodies_, MarkerGroup::fixed, last_step_, driving());
  boundary_->measure_slip(bodies_, flow_.state());
  find_stresses(bodies_, sampler_, flow_.grid(), driving(), StressOf::all);
}

}  // namespace pliant
