#include "config/motion_keys.hpp"

namespace pliant {
namespace {
using BodyKey = Key<BodyConfig>;

constexpr Limits zero_or_one{.min = 0, .max = 1};

BodyKey when(MotionKind motion, BodyKey key) {
  return only_when<BodyConfig>(std::move(key), "motion is \"" + word_for(motion) + "\"",
                               [motion](const BodyConfig& b) { return b.motion == motion; });
}

/// The same where the flow feels the body.
BodyKey when_felt(MotionKind motion, BodyKey key) {
  return only_when<BodyConfig>(
      std::move(key), "motion is \"" + word_for(motion) + "\" and coupling is not \"one-way\"",
      [motion](const BodyConfig& b) { return b.motion == motion && b.coupling != CouplingKind::one_way; });
}

bool has_mass(const BodyConfig& b) { return b.motion == MotionKind::rigid || b.motion == MotionKind::hinge; }

BodyKey when_massive(BodyKey key) {
  return only_when<BodyConfig>(std::move(key), "motion is \"rigid\" or \"hinge\"", has_mass);
}

BodyKey when_material(BodyKey key) {
  return only_when<BodyConfig>(std::move(key), "motion is \"rigid\", \"hinge\" or \"deformable\"",
                               [](const BodyConfig& b) { return has_mass(b) || b.motion == MotionKind::deformable; });
}

/// The text of a path has a legal empty value: no displacement.
BodyKey path_key(const std::string& name, const std::string& unit, const std::string& doc,
                 std::string PathConfig::*member) {
  auto key = make_key<BodyConfig>({"path." + name, unit, doc}, [member](auto& b) { return &(b.path.*member); });
  key.default_value = Json();
  key.get = [member](const BodyConfig& b) { return (b.path.*member).empty() ? Json() : Json(b.path.*member); };
  key.legal = "a formula of t, or the name of a signal";
  return when(MotionKind::prescribed, std::move(key));
}

void add_path(std::vector<BodyKey>& keys) {
  keys.push_back(path_key("x", "length", "displacement along x at time t", &PathConfig::x));
  keys.push_back(path_key("y", "length", "displacement along y", &PathConfig::y));
  keys.push_back(path_key("z", "length", "displacement along z", &PathConfig::z));
  keys.push_back(path_key("angle", "degrees", "rotation about path.axis through path.pivot", &PathConfig::angle));
  keys.push_back(when(MotionKind::prescribed, make_key<BodyConfig>({"path.axis", "", "of the rotation"},
                                                                   [](auto& b) { return &b.path.axis; })));
  keys.push_back(when(
      MotionKind::prescribed,
      make_key<BodyConfig>({"path.pivot", "length", "point of the axis at no displacement; default: the body's center"},
                           [](auto& b) { return &b.path.pivot; })));
}

void add_schedule(std::vector<BodyKey>& keys) {
  const auto add = [&](KeyText text, auto ScheduleConfig::*value, Limits limits) {
    keys.push_back(required(make_key<BodyConfig>(
        std::move(text),
        [value](auto& b) {
          auto* schedule = member(b.schedule);
          return schedule ? &(schedule->*value) : nullptr;
        },
        limits)));
  };
  add({"schedule.period", "time", "of the cycle in which the body comes and goes; t = 0 is phase 0"},
      &ScheduleConfig::period, positive());
  add({"schedule.phase", "",
       "part of each period, from 0 to 1, in which the body acts on the flow; in the rest it is not there. [0.9, 0.2] "
       "goes on over the end of the period. Each step has the body or not, by the time in its middle"},
      &ScheduleConfig::phase, zero_or_one);
}

void add_material(std::vector<BodyKey>& keys) {
  keys.push_back(when_material(make_key<BodyConfig>(
      {"density", "mass / length^3", "of the body's material; default: the fluid's"},
      [](auto& b) { return &b.material.density; }, positive())));
  keys.push_back(when_material(make_key<BodyConfig>(
      {"thickness", "length",
       "of the wall of a hollow, open or deformable body; 0: a solid, which must be closed, or, if deformable, a "
       "surface whose mass and stiffness are given otherwise"},
      [](auto& b) { return &b.material.thickness; }, at_least(0))));
  keys.push_back(when_massive(make_key<BodyConfig>(
      {"mass", "mass", "instead of what density makes; the inertia is scaled along"},
      [](auto& b) { return &b.material.mass; }, positive())));
  keys.push_back(when(MotionKind::rigid, make_key<BodyConfig>(
                                             {"inertia", "mass length^2",
                                              "moments about the centre of mass along the axes of the surface before "
                                              "`rotation`, instead of what the shape makes"},
                                             [](auto& b) { return &b.material.inertia; }, positive())));
}

void add_rigid(std::vector<BodyKey>& keys) {
  const auto add = [&](BodyKey key) { keys.push_back(when(MotionKind::rigid, std::move(key))); };
  add(make_key<BodyConfig>({"velocity", "velocity", "of the centre of mass at the start"},
                           [](auto& b) { return &b.rigid.velocity; }));
  add(make_key<BodyConfig>({"angular_velocity", "1 / time", "at the start, radians a time"},
                           [](auto& b) { return &b.rigid.angular_velocity; }));
  add(make_key<BodyConfig>(
      {"free_translation", "", "1: the body may move along this axis of the box; 0: it is held"},
      [](auto& b) { return &b.rigid.free_translation; }, zero_or_one));
  add(make_key<BodyConfig>(
      {"free_rotation", "", "1: the body may turn about this axis of the box; 0: it is held"},
      [](auto& b) { return &b.rigid.free_rotation; }, zero_or_one));
  add(make_key<BodyConfig>(
      {"virtual_mass", "",
       "fraction of the displaced fluid's mass that is added on both sides of Newton's law, so that "
       "loose coupling bears lighter bodies; 0.5 suits a sphere"},
      [](auto& b) { return &b.rigid.virtual_mass; }, at_least(0)));
}

void add_hinge(std::vector<BodyKey>& keys) {
  const auto add = [&](BodyKey key) { keys.push_back(when(MotionKind::hinge, std::move(key))); };
  add(make_key<BodyConfig>({"hinge.point", "length", "a point of the axis"}, [](auto& b) { return &b.hinge.point; }));
  add(make_key<BodyConfig>({"hinge.axis", "", "direction of the axis; angles count by the right hand"},
                           [](auto& b) { return &b.hinge.axis; }));
  add(make_key<BodyConfig>({"hinge.angle", "degrees", "at the start, from the place that the surface is given"},
                           [](auto& b) { return &b.hinge.angle; }));
  add(make_key<BodyConfig>({"hinge.rate", "degrees / time", "at the start"}, [](auto& b) { return &b.hinge.rate; }));
  add(make_key<BodyConfig>({"hinge.min_angle", "degrees", "stop; none if not given"},
                           [](auto& b) { return &b.hinge.min_angle; }));
  add(make_key<BodyConfig>({"hinge.max_angle", "degrees", "stop; none if not given"},
                           [](auto& b) { return &b.hinge.max_angle; }));
  add(make_key<BodyConfig>(
      {"hinge.restitution", "", "rate after a stop over rate before it"}, [](auto& b) { return &b.hinge.restitution; },
      zero_or_one));
  add(make_key<BodyConfig>(
      {"hinge.inertia", "mass length^2", "about the axis, instead of what the material makes"},
      [](auto& b) { return &b.hinge.inertia; }, positive()));
  add(make_key<BodyConfig>(
      {"hinge.damping", "torque time", "torque of -damping times the rate in radians"},
      [](auto& b) { return &b.hinge.damping; }, at_least(0)));
  add(make_key<BodyConfig>(
      {"hinge.stiffness", "torque", "torque of -stiffness times the angle from rest_angle in radians"},
      [](auto& b) { return &b.hinge.stiffness; }, at_least(0)));
  add(make_key<BodyConfig>({"hinge.rest_angle", "degrees", "of the spring"},
                           [](auto& b) { return &b.hinge.rest_angle; }));
  add(make_key<BodyConfig>(
      {"hinge.virtual_inertia", "mass length^2",
       "added on both sides of the equation of motion, so that loose coupling bears lighter leaflets"},
      [](auto& b) { return &b.hinge.virtual_inertia; }, at_least(0)));
}

}  // namespace

void add_motion_keys(std::vector<BodyKey>& keys) {
  keys.push_back(make_key<BodyConfig>({"motion", "", "how the body moves"}, [](auto& b) { return &b.motion; }));
  keys.push_back(make_key<BodyConfig>({"coupling", "",
                                       "one-way: the flow does not feel the body; loose: fluid, loads, body, once a "
                                       "step; strong: repeated until they agree; force-spreading, local-mass: "
                                       "vertices move with the flow, substep by substep (docs/coupling.md); "
                                       "auto: by the mass ratio"},
                                      [](auto& b) { return &b.coupling; }));
  keys.push_back(when_material(make_key<BodyConfig>(
      {"loads", "", "what moves the body: the momentum balance of its forcing, or the stress at its probes (traction)"},
      [](auto& b) { return &b.loads; })));
  keys.push_back(make_key<BodyConfig>(
      {"contact", "",
       "false: the body takes no part in the repulsion of bodies, walls and itself; for bodies that are joined"},
      [](auto& b) { return &b.contact; }));
  keys.push_back(only_when<BodyConfig>(
      make_key<BodyConfig>(
          {"marker_refinement", "",
           "parts that each edge of a face is cut in to place markers; 0: as many as the grid asks for"},
          [](auto& b) { return &b.marker_refinement; }, between(0, 100)),
      "coupling is not \"one-way\"", [](const BodyConfig& b) { return b.coupling != CouplingKind::one_way; }));
  keys.push_back(only_when<BodyConfig>(
      make_key<BodyConfig>(
          {"marker_retraction", "grid spacings",
           "how far inside a closed surface markers are put, or away from the borders of an open one, "
           "since forcing acts as a body larger by about as much; default: 0.2"},
          [](auto& b) { return &b.marker_retraction; }, between(0, 1)),
      "coupling is not \"one-way\"", [](const BodyConfig& b) { return b.coupling != CouplingKind::one_way; }));
  keys.push_back(only_when<BodyConfig>(
      make_key<BodyConfig>(
          {"thin_sheet", "",
           "of an open surface: the flow feels a sheet without thickness; false: no slip at the markers, "
           "which acts as one about a spacing thick"},
          [](auto& b) { return &b.thin_sheet; }),
      "coupling is not \"one-way\"", [](const BodyConfig& b) { return b.coupling != CouplingKind::one_way; }));
  const auto fixed = [](BodyKey key) { return when_felt(MotionKind::fixed, std::move(key)); };
  keys.push_back(
      fixed(make_key<BodyConfig>({"tight", "",
                                  "of an open surface: no net flow passes it after any step; for walls with orifices "
                                  "that part the box, and valves in them. Costs the memory of a field a part, and a "
                                  "pass over the flow in each substep"},
                                 [](auto& b) { return &b.tight; })));
  keys.push_back(
      fixed(make_key<BodyConfig>({"tight_parts", "",
                                  "selections for which that holds one by one, and for the rest of the surface: one "
                                  "for each part of the box that the surface borders on"},
                                 [](auto& b) { return &b.tight_parts; })));
  const auto soft = [](BodyKey key) { return when_felt(MotionKind::deformable, std::move(key)); };
  keys.push_back(
      soft(make_key<BodyConfig>({"held", "",
                                 "a force shared over the surface keeps its centre at rest, so that it deforms but "
                                 "does not drift; the body's table has the flow's force on it"},
                                [](auto& b) { return &b.held; })));
  keys.push_back(soft(make_key<BodyConfig>(
      {"separates", "",
       "of an open surface: with other bodies it parts the box in two, as a closed one does by itself "
       "(a sack on a plate across the box). Then the even part of the pressure that it bears "
       "stays out of the flow, which would leak under it; pressures on one side are shown less it"},
      [](auto& b) { return &b.separates; })));
  keys.push_back(
      soft(make_key<BodyConfig>({"volume_correction", "",
                                 "of a closed body: the least motion of its vertices that keeps the volume as it was, "
                                 "once a step; the body's table has what it took"},
                                [](auto& b) { return &b.volume_correction; })));
  add_path(keys);
  add_schedule(keys);
  add_material(keys);
  add_rigid(keys);
  add_hinge(keys);
}

void add_interaction_keys(std::vector<Key<CaseConfig>>& keys) {
  const auto add = [&](Key<CaseConfig> key) { keys.push_back(std::move(key)); };
  add(make_key<CaseConfig>(
      {"immersed_boundary.forcing_iterations", "",
       "times that velocities are compared and forces spread within a substep"},
      [](auto& c) { return &c.immersed_boundary.forcing_iterations; }, between(1, 100)));
  add(make_key<CaseConfig>(
      {"immersed_boundary.carry_forces", "",
       "the forces on fixed bodies begin each substep as those of the one before: walls under a pressure do not leak"},
      [](auto& c) { return &c.immersed_boundary.carry_forces; }));
  add(make_key<CaseConfig>(
      {"coupling.scheme", "",
       "of strong coupling: fixed point with Aitken relaxation or by interface quasi-Newton, or Hamming's "
       "predictor-corrector; auto: quasi-newton for deformable bodies, else aitken"},
      [](auto& c) { return &c.coupling.scheme; }));
  add(make_key<CaseConfig>(
      {"coupling.tolerance", "",
       "strong coupling ends when no velocity changes by more than this part of the largest one"},
      [](auto& c) { return &c.coupling.tolerance; }, positive()));
  add(make_key<CaseConfig>(
      {"coupling.max_iterations", "", "of strong coupling in a step; beyond it the run fails"},
      [](auto& c) { return &c.coupling.max_iterations; }, between(2, 10000)));
  add(make_key<CaseConfig>(
      {"coupling.relaxation", "", "of the first iteration of a step"}, [](auto& c) { return &c.coupling.relaxation; },
      Limits{.min = 0, .min_bound = Bound::exclusive, .max = 1}));
  add(make_key<CaseConfig>(
      {"coupling.reuse", "", "steps whose secants quasi-newton uses again, as long as they say something new"},
      [](auto& c) { return &c.coupling.reuse; }, between(0, 20)));
  add(make_key<CaseConfig>(
      {"repulsion.range", "length", "within which surfaces push each other off; 0: they do not"},
      [](auto& c) { return &c.repulsion.range; }, at_least(0)));
  add(make_key<CaseConfig>(
      {"repulsion.strength", "pressure", "of rigid bodies: the most that they bear; of deformable ones: at 0.6 ranges"},
      [](auto& c) { return &c.repulsion.strength; }, at_least(0)));
  add(make_key<CaseConfig>({"repulsion.with_itself", "", "deformable bodies do not pass through themselves either"},
                           [](auto& c) { return &c.repulsion.with_itself; }));
}

}  // namespace pliant
