#include "config/validate_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "config/body_validator.hpp"
#include "config/word.hpp"

namespace pliant {
namespace {

class MotionValidator : private BodyValidator {
 public:
  MotionValidator(const CaseConfig& config, const std::set<std::string>& suspect, std::vector<std::string>& problems)
      : BodyValidator(config, suspect, problems) {}

  void run() {
    for_each_body([this](const BodyConfig& body) {
      check_coupling(body);
      check_traction(body);
      check_schedule(body);
      switch (body.motion) {
        case MotionKind::fixed:
        case MotionKind::deformable:
          break;
        case MotionKind::prescribed:
          check_axis("path.axis", body.path.axis);
          break;
        case MotionKind::rigid:
          check_material(body);
          check_switches("free_translation", body.rigid.free_translation);
          check_switches("free_rotation", body.rigid.free_rotation);
          break;
        case MotionKind::hinge:
          check_material(body);
          check_hinge(body);
          break;
      }
    });
    check_repulsion();
  }

 private:
  void check_coupling(const BodyConfig& body) {
    if (!trusted({"coupling"})) return;
    const auto word = word_for(body.coupling);
    const bool is_soft = body.coupling == CouplingKind::force_spreading || body.coupling == CouplingKind::local_mass;
    if (is_soft && body.motion != MotionKind::deformable)
      complain("coupling", fmt::format("is \"{}\", which moves the vertices of deformable bodies, but motion is \"{}\"",
                                       word, word_for(body.motion)));
    const bool is_free = body.motion == MotionKind::rigid || body.motion == MotionKind::hinge;
    if (is_free && body.coupling == CouplingKind::one_way)
      complain("coupling", fmt::format("is \"{}\", but what moves a body with motion = \"{}\" is its action on the "
                                       "flow; write \"loose\", \"strong\" or \"auto\"",
                                       word, word_for(body.motion)));
  }

  void check_traction(const BodyConfig& body) {
    if (!trusted({"traction.form", "loads"})) return;
    const auto form = body.traction.form;
    const bool is_deformable = body.motion == MotionKind::deformable;
    if (form == TractionForm::drag && !is_deformable)
      complain("traction.form",
               fmt::format("is \"drag\", which moves the vertices of deformable bodies, but motion is \"{}\"; choose "
                           "\"quadratic\", \"one-sided\", \"gradient\" or \"none\"",
                           word_for(body.motion)));
    if (form == TractionForm::quadratic && is_deformable)
      complain("traction.form",
               "is \"quadratic\", which needs the surface to push the flow, but motion is \"deformable\"; choose "
               "\"drag\", \"one-sided\" or \"gradient\"");
    const bool is_free = body.motion == MotionKind::rigid || body.motion == MotionKind::hinge;
    if (is_free && body.loads == LoadSource::probes && form == TractionForm::none)
      complain("loads",
               "is \"probes\", but traction.form is \"none\", which has no probes; choose another form, or loads = "
               "\"momentum-balance\"");
  }

  void check_schedule(const BodyConfig& body) {
    if (!body.schedule || !trusted({"schedule.period", "schedule.phase", "coupling"})) return;
    if (body.motion != MotionKind::fixed && body.motion != MotionKind::prescribed)
      return complain(
          "schedule",
          fmt::format("is given, but motion is \"{}\": while the body is not there nothing would move it, and "
                      "where it comes back would mean nothing; only bodies whose place is known beforehand "
                      "(\"fixed\", \"prescribed\") have a schedule",
                      word_for(body.motion)));
    if (body.coupling == CouplingKind::one_way)
      complain("schedule",
               "is given, but coupling is \"one-way\", so that the flow never feels the body; leave out one");
    if (body.schedule->phase[0] == body.schedule->phase[1])
      complain("schedule.phase",
               fmt::format("begins and ends at {}; a body that always acts needs no schedule, one that "
                           "never does is left out",
                           body.schedule->phase[0]));
  }

  void check_axis(const char* key, Vec3 axis) {
    if (trusted({key}) && !(norm(axis) > 0)) complain(key, "must not be 0: give the direction to turn about");
  }

  void check_switches(const char* key, Vec3 values) {
    if (!trusted({key})) return;
    for (int d = 0; d < 3; ++d)
      if (values[d] != 0 && values[d] != 1)
        complain(key,
                 fmt::format("has the component {} along {}; it must be 1 (free) or 0 (held)", values[d], "xyz"[d]));
  }

  void check_material(const BodyConfig& body) {
    if (!trusted({"thickness", "surface.shape", "surface.file", "surface.open", "surface.ends"})) return;
    if (!is_open_surface(body.surface) || body.material.thickness > 0) return;
    complain(
        "thickness",
        fmt::format("is 0, but the surface is open and motion is \"{}\": without a volume its mass and inertia come "
                    "from its wall; give the thickness of the wall",
                    word_for(body.motion)));
  }

  void check_hinge(const BodyConfig& body) {
    const auto& hinge = body.hinge;
    check_axis("hinge.axis", hinge.axis);
    if (body.placement.count || body.placement.positions)
      complain(body.placement.count ? "count" : "positions",
               "makes copies, but motion is \"hinge\", and a hinge is at one place; write a [[body]] for each");
    if (!trusted({"hinge.angle", "hinge.min_angle", "hinge.max_angle"})) return;
    if (hinge.min_angle && hinge.max_angle && *hinge.min_angle > *hinge.max_angle)
      return complain("hinge.min_angle", fmt::format("is {}, above hinge.max_angle = {}; exchange them",
                                                     *hinge.min_angle, *hinge.max_angle));
    const bool is_below = hinge.min_angle && hinge.angle < *hinge.min_angle;
    const bool is_above = hinge.max_angle && hinge.angle > *hinge.max_angle;
    if (!is_below && !is_above) return;
    complain("hinge.angle", fmt::format("starts at {} degrees, {} = {}; start between the stops, or move the stop",
                                        hinge.angle, is_below ? "below hinge.min_angle" : "above hinge.max_angle",
                                        is_below ? *hinge.min_angle : *hinge.max_angle));
  }

  void check_repulsion() {
    const auto& repulsion = config_.repulsion;
    if (suspect_.count("repulsion.range") > 0 || suspect_.count("repulsion.strength") > 0) return;
    const auto add = [&](const std::string& key, const std::string& what) {
      problems_.push_back(place_of(config_, key) + " " + what);
    };
    if (repulsion.range > 0 && repulsion.strength == 0)
      add("repulsion.range",
          "is given, but repulsion.strength is 0; give the pressure of the repulsion, or leave out "
          "both");
    if (repulsion.strength > 0 && repulsion.range == 0)
      add("repulsion.strength",
          "is given, but repulsion.range is 0; give the distance from which surfaces push each "
          "other off, or leave out both");
    if (suspect_.count("box.size") > 0) return;
    for (int d = 0; d < 3; ++d)
      if (has_deformable() && has_walls(config_.boundary, d) && repulsion.range > 0.25 * config_.box.size[d])
        add("repulsion.range",
            fmt::format("is {}, more than a quarter of the box along {} ({}), which has walls: a deformable body would "
                        "be within range of both wherever it is; shorten the range",
                        repulsion.range, "xyz"[d], config_.box.size[d]));
    for (int d = 0; d < 3; ++d)
      if (is_periodic(config_.boundary, d) && repulsion.range > 0.5 * config_.box.size[d])
        add("repulsion.range",
            fmt::format(
                "is {}, more than half of the periodic direction {} ({}): a body would meet itself; shorten the "
                "range",
                repulsion.range, "xyz"[d], config_.box.size[d]));
  }

  bool has_deformable() const {
    return std::any_of(config_.bodies.begin(), config_.bodies.end(),
                       [](const BodyConfig& body) { return body.motion == MotionKind::deformable; });
  }
};

}  // namespace

void check_motions(const CaseConfig& config, const std::set<std::string>& suspect, std::vector<std::string>& problems) {
  MotionValidator(config, suspect, problems).run();
}

}  // namespace pliant
