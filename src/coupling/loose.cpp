#include "coupling/loose.hpp"

#include "core/error.hpp"
#include "coupling/swing.hpp"
#include "parallel/agree.hpp"

namespace pliant {

void advance_loose_bodies(CoupledFlow& coupled, double step) {
  auto& bodies = coupled.bodies();
  // A change of velocity of a cell in a million steps, from step to step: far above round-off, harmless yet.
  const double least = 1e-6 * coupled.flow().grid().dx() / (step * step);
  std::string problem;
  for (Body& body : bodies.own()) {
    const auto& kind = bodies.kind_of(body);
    if (kind.coupling != CouplingKind::loose || (kind.has_pose() && !kind.is_free())) continue;
    try {
      if (!kind.has_pose()) {
        advance_forced(body, kind, coupled.nodal_surroundings(), coupled.contact_of(body), step);
        continue;
      }
      const RigidLoad load = coupled.load_on(body);
      advance_free(body, kind, load, step);
      if (is_swinging_up(body, kind, load, least)) throw RunError(explain_swing(body, kind));
    } catch (const RunError& error) {
      if (problem.empty()) problem = error.what();
    }
  }
  agree(coupled.flow().grid().ranks(), problem);
}

void advance_loose(CoupledFlow& coupled, double time, double step) {
  move_prescribed(coupled.bodies(), time);
  coupled.place_markers();
  coupled.begin_contact(step);
  coupled.advance_fluid(step);
  coupled.find_loads(step);
  coupled.finish_soft_bodies(step);
  coupled.accept();
  advance_loose_bodies(coupled, step);
  coupled.end_contact(step);
}

}  // namespace pliant
