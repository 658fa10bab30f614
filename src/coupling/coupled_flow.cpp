#include "coupling/coupled_flow.hpp"

#include <limits>

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
      copies_(flow.grid()),
      sampler_(flow.grid(), fields_of(flow), config.fluid.density) {
  bool has_forced = false, has_tight = false;
  for (const auto& kind : bodies.kinds()) {
    has_forced |= kind.forces_flow();
    has_tight |= !kind.tight_parts.empty();
    if (kind.coupling == CouplingKind::force_spreading && !force_spreading_)
      force_spreading_.emplace(flow.grid(), config, bodies, contact_);
    if (kind.coupling == CouplingKind::local_mass && !local_mass_)
      local_mass_.emplace(flow.grid(), config, bodies, contact_);
    is_two_way_ |= kind.acts_on_flow();
    has_strong_ |= kind.coupling == CouplingKind::strong;
    has_probe_driven_ |= kind.is_driven_by_probes();
    has_two_way_vertices_ |= !kind.has_pose() && kind.acts_on_flow();
    has_one_way_ |= !kind.has_pose() && !kind.acts_on_flow();
  }
  if (start == RunStart::anew && force_spreading_) force_spreading_->adopt_flow(flow_.state());
  if (start == RunStart::anew && local_mass_) local_mass_->adopt_flow(flow_.state());
  if (!has_forced) return;
  boundary_.emplace(flow.grid(), config);
  boundary_->place(bodies_, MarkerGroup::fixed);
  boundary_->place(bodies_, MarkerGroup::moving);
  if (start == RunStart::anew) boundary_->adopt_inner_motion(bodies_, flow_.state());
  if (has_tight) tight_walls_.emplace(flow_, bodies_);
}

void CoupledFlow::follow_schedules(double time) {
  const auto changed = bodies_.follow_schedules(time);
  if (changed.empty() || !boundary_) return;
  settle();
  const auto scope = timer_.measure("bodies: markers");
  boundary_->follow_schedules(bodies_, flow_.state(), changed);
}

/// Without a body in it the flow is the one that never had any, to the bit.
bool CoupledFlow::is_followed() const {
  for (std::size_t k = 0; k < bodies_.kinds().size(); ++k)
    if (bodies_.kinds()[k].forces_flow() && bodies_.is_on(k)) return true;
  return false;
}

void CoupledFlow::place_markers() {
  if (!boundary_) return;
  const auto scope = timer_.measure("bodies: markers");
  boundary_->place(bodies_, MarkerGroup::moving);
}

FlowHooks CoupledFlow::hooks() {
  FlowHooks hooks;
  if (force_spreading_) {
    hooks.forces = force_spreading_->forces();
    hooks.corrected = [this](const Substep& substep, double dt) {
      const auto& state = flow_.state();
      const auto scope = timer_.measure("bodies: soft, within fluid");
      force_spreading_->corrected(substep, dt, state);
    };
  }
  if (force_spreading_ || local_mass_)
    hooks.before = [this](const Substep& substep, double dt) {
      if (local_mass_) {
        const auto& state = flow_.state();
        const auto scope = timer_.measure("bodies: soft, within fluid");
        local_mass_->before(substep, state);
      }
      const auto scope = timer_.measure("bodies: soft, within fluid");
      if (force_spreading_) force_spreading_->before(substep, dt);
    };
  const bool merges = force_spreading_ && force_spreading_->wants_predicted();
  const bool forces = is_followed();
  if (forces || local_mass_ || merges)
    hooks.predicted = [this, merges, forces](const Substep& substep, double dt, View<FaceX> u, View<FaceY> v,
                                             View<FaceZ> w) {
      if (merges || local_mass_) {
        const auto scope = timer_.measure("bodies: soft, within fluid");
        if (merges) force_spreading_->predicted(substep, dt, u, v, w);
        if (merges && local_mass_) copies_.fill(u, v, w);
        if (local_mass_) local_mass_->predicted(substep, dt, u, v, w);
        if (forces) copies_.fill(u, v, w);
      }
      if (!forces) return;
      const auto scope = timer_.measure("bodies: forcing, within fluid");
      boundary_->apply(substep, dt, u, v, w);
      if (tight_walls_ && tight_walls_->any(bodies_)) tight_walls_->apply(bodies_, u, v, w);
    };
  return hooks;
}

void CoupledFlow::advance_fluid(double step) {
  last_step_ = step;
  const auto scope = timer_.measure("fluid");
  if (boundary_) boundary_->begin_step(bodies_);
  if (tight_walls_) tight_walls_->begin_step();
  if (local_mass_) local_mass_->begin();
  flow_.advance(step, hooks());
}

void CoupledFlow::save_soft_bodies() {
  saved_soft_.clear();
  for (const Body& body : bodies_.own())
    if (bodies_.kind_of(body).is_soft()) saved_soft_.push_back(body);
}

void CoupledFlow::restore_soft_bodies() {
  for (const Body& saved : saved_soft_) *bodies_.find(saved.id) = saved;
}

void CoupledFlow::begin_contact(double step) {
  if (!has_two_way_vertices_) return;
  const auto scope = timer_.measure("bodies: contact");
  contact_.begin(bodies_, step, PosedBodies::at_its_start);
}

void CoupledFlow::end_contact(double step) {
  if (!has_two_way_vertices_) return;
  const auto scope = timer_.measure("bodies: contact");
  contact_.end(bodies_, step, has_one_way_ ? ContactPass::first : ContactPass::only);
}

void CoupledFlow::finish_soft_bodies(double step) {
  const auto scope = timer_.measure("bodies: motion");
  if (force_spreading_) force_spreading_->finish(step);
  if (local_mass_) local_mass_->finish(step);
}

double CoupledFlow::step_limit() const {
  return force_spreading_ ? force_spreading_->step_limit() : std::numeric_limits<double>::infinity();
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
  if (!boundary_) return;
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
  if (boundary_) boundary_->end_step(bodies_);
}

void CoupledFlow::advance_one_way_bodies(double step) {
  if (!has_one_way_) return;
  settle();
  const auto scope = timer_.measure("bodies: motion");
  advance_one_way(bodies_, sampler_, config_.fluid, contact_, step,
                  has_two_way_vertices_ ? ContactPass::second : ContactPass::only);
}

void CoupledFlow::add_loads_of_tight_walls() {
  for (Body& body : bodies_.own()) {
    if (bodies_.kind_of(body).tight_parts.empty() || !bodies_.is_on(body)) continue;
    auto& loads = body.loads;
    loads.reaction = loads.reaction + tight_walls_->load_on(body, last_step_);
    loads.balance = loads.reaction;
  }
}

void CoupledFlow::diagnose() {
  if (!is_two_way_) return;
  flow_.settle();
  if (boundary_ && last_step_ > 0) boundary_->find_reactions(bodies_, MarkerGroup::fixed, last_step_, driving());
  if (tight_walls_ && last_step_ > 0) add_loads_of_tight_walls();
  if (force_spreading_) force_spreading_->measure_slip(flow_.state());
  if (local_mass_) local_mass_->measure_slip(flow_.state());
  if (boundary_) boundary_->measure_slip(bodies_, flow_.state());
  find_stresses(bodies_, sampler_, flow_.grid(), driving(), StressOf::all);
}

}  // namespace pliant
