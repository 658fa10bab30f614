#include "config/validate_structure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "config/body_validator.hpp"
#include "config/word.hpp"

namespace pliant {
namespace {

class StructureValidator : private BodyValidator {
 public:
  StructureValidator(const CaseConfig& config, const std::set<std::string>& suspect, std::vector<std::string>& problems)
      : BodyValidator(config, suspect, problems) {}

  void run() {
    for_each_body([this](const BodyConfig& body) {
      check_selections(body);
      check_uses(body);
      if (body.motion != MotionKind::deformable) return;
      check_mass(body);
      check_stiffness(body);
      check_pressure(body);
    });
  }

 private:
  void check_mass(const BodyConfig& body) {
    if (!trusted({"mass_per_vertex", "coupling", "density", "thickness"})) return;
    if (body.mass_per_vertex == 0.0 && moves_by_newton(body.coupling))
      complain("mass_per_vertex", fmt::format("is 0, but with coupling = \"{}\" Newton's law moves the vertices by "
                                              "themselves; give them a mass",
                                              word_for(body.coupling)));
    if (body.material.density && body.material.thickness == 0)
      complain("density",
               "has no effect without a thickness: a vertex weighs its share of area times thickness times density; "
               "give the thickness of the wall, or mass_per_vertex");
  }

  void check_stiffness(const BodyConfig& body) {
    if (!trusted({"young", "thickness", "fibre", "young_across"})) return;
    const auto& material = body.material;
    if (material.young && material.thickness == 0)
      complain("young", "is the modulus of a wall, but thickness is 0; give the thickness of the wall");
    if (material.fibre && !material.young) complain("fibre", "directs the stiffness of young, which is not given");
    if (material.fibre && !(norm(*material.fibre) > 0)) complain("fibre", "must not be 0: give its direction");
    if (!material.young_across) return;
    if (!material.fibre || !material.young)
      return complain("young_across", "is the modulus across a fibre; give young and fibre as well");
    const double ratio = *material.young / *material.young_across;
    if (ratio > 4 || ratio < 0.25)
      complain("young_across",
               fmt::format("makes the wall {:.3g} times as stiff {} the fibre; a network of springs can be at most 4 "
                           "times as stiff in one direction as in the other",
                           ratio > 1 ? ratio : 1 / ratio, ratio > 1 ? "along" : "across"));
  }

  void check_pressure(const BodyConfig& body) {
    if (!trusted({"surface.shape", "surface.file", "surface.open", "surface.ends", "pinned"})) return;
    if (body.potentials.pressure && is_open_surface(body.surface) && body.pinned.empty())
      complain("potentials.pressure.value",
               "pushes an open surface, which would fly away; name the selections of its vertices that are pinned");
  }

  void check_selections(const BodyConfig& body) {
    for (const auto& selection : body.selections) {
      const auto key = "selection." + selection.name;
      if (!selection.has_condition())
        complain(key, "selects nothing; give it border = true, border_near, sphere, box, cylinder, plane or extreme");
      const auto check_direction = [&](const std::string& path, Vec3 direction) {
        if (trusted(key + path) && !(norm(direction) > 0)) complain(key + path, "must not be 0: give a direction");
      };
      if (selection.cylinder) check_direction(".cylinder.axis", selection.cylinder->axis);
      if (selection.plane) check_direction(".plane.normal", selection.plane->normal);
      if (selection.extreme) check_direction(".extreme.direction", selection.extreme->direction);
      const bool wants_border = selection.border || selection.border_near;
      if (wants_border && trusted({"surface.shape", "surface.file", "surface.open", "surface.ends"}) &&
          !is_open_surface(body.surface))
        complain(key, std::holds_alternative<FileSurface>(body.surface)
                          ? "is at a free border, but surface.open is false, so that the file is taken for a closed "
                            "surface; set surface.open = true, or select the vertices by place"
                          : "is at a free border, but the surface is closed; select its vertices by place");
    }
  }

  void require_selection(const BodyConfig& body, const std::string& key, const std::string& name) {
    if (name.empty() || !trusted(key)) return;
    std::string known;
    for (const auto& selection : body.selections) {
      if (selection.name == name) return;
      known += (known.empty() ? "\"" : ", \"") + selection.name + "\"";
    }
    // A file's own selections are known once it is read.
    if (!trusted({"surface.shape", "surface.file"}) || std::holds_alternative<FileSurface>(body.surface)) return;
    for (const auto& brought : selections_of_shape(body.surface)) {
      if (brought == name) return;
      known += (known.empty() ? "\"" : ", \"") + brought + "\"";
    }
    complain(key, fmt::format("names \"{}\", which is no selection of the body; it has {}", name,
                              known.empty() ? "none: write [body.selection." + name + "]" : known));
  }

  bool is_overridden(const std::string& key) const {
    const auto found = config_.origins.find(prefix_ + "." + key);
    return found != config_.origins.end() && found->second.rfind("--set", 0) == 0;
  }

  void check_tightness(const BodyConfig& body) {
    if (!trusted({"tight", "tight_parts"})) return;
    if (!body.tight && !body.tight_parts.empty() && !is_overridden("tight"))
      complain("tight_parts", "names parts of a tight surface, but tight is false; set tight = true");
    if (body.tight && trusted({"surface.shape", "surface.file", "surface.open", "surface.ends"}) &&
        !is_open_surface(body.surface))
      complain("tight",
               "is true, but the surface is closed: what flows into it flows out of it, and there is no net flow to "
               "hold; leave it out");
  }

  void check_uses(const BodyConfig& body) {
    const bool soft = body.coupling == CouplingKind::automatic || body.coupling == CouplingKind::force_spreading ||
                      body.coupling == CouplingKind::local_mass;
    if (body.separates && !soft && trusted({"separates", "coupling"}))
      complain("separates",
               "is for bodies that move with the flow; set coupling = \"force-spreading\" or \"local-mass\"");
    for (const auto& name : body.pinned) require_selection(body, "pinned", name);
    for (const auto& name : body.watch) require_selection(body, "watch", name);
    for (const auto& name : body.tight_parts) require_selection(body, "tight_parts", name);
    check_tightness(body);
    for (const auto& tether : body.tethers)
      require_selection(body, "tether." + tether.name + ".selection", tether.selection);
    for (const auto& pull : body.pulls) require_selection(body, "pull." + pull.name + ".selection", pull.selection);
    for (const auto& cord : body.cords) {
      const auto key = "cord." + cord.name;
      require_selection(body, key + ".from", cord.from);
      require_selection(body, key + ".to", cord.to);
      if (cord.to.empty() && !cord.point && trusted(key + ".to") && trusted(key + ".point"))
        complain(key, "has one end only; give it to = \"SELECTION\" or point = [x, y, z]");
    }
    // An override that changes the motion makes them meaningless; that is not the file's fault.
    if (body.motion == MotionKind::deformable || is_overridden("motion")) return;
    const auto refuse = [&](PartKind kind, const auto& parts) {
      for (const auto& part : parts)
        complain(word_for(kind) + "." + part.name,
                 fmt::format("is of vertices that move one by one, but motion is \"{}\"; remove it, or write motion = "
                             "\"deformable\"",
                             word_for(body.motion)));
    };
    for (const auto& selection : body.selections)
      if (std::count(body.tight_parts.begin(), body.tight_parts.end(), selection.name) == 0)
        complain(
            "selection." + selection.name,
            fmt::format("is of vertices that move one by one, or of a part of a tight wall, but motion is \"{}\" and "
                        "tight_parts does not name it; remove it, or name it there, or write motion = "
                        "\"deformable\"",
                        word_for(body.motion)));
    refuse(PartKind::tether, body.tethers);
    refuse(PartKind::cord, body.cords);
    refuse(PartKind::pull, body.pulls);
  }
};

}  // namespace

void check_structures(const CaseConfig& config, const std::set<std::string>& suspect,
                      std::vector<std::string>& problems) {
  StructureValidator(config, suspect, problems).run();
}

}  // namespace pliant
