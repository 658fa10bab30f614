#include "config/key_table.hpp"
#include "config/motion_keys.hpp"

namespace pliant {
namespace {
using BodyKey = Key<BodyConfig>;

bool is_deformable(const BodyConfig& body) { return body.motion == MotionKind::deformable; }

void add_motion(std::vector<BodyKey>& keys) {
  const auto deformable = [](BodyKey key) {
    return only_when<BodyConfig>(std::move(key), "motion is \"deformable\"", is_deformable);
  };
  add_motion_keys(keys);
  keys.push_back(deformable(make_key<BodyConfig>(
      {"mass_per_vertex", "mass", "of each vertex in Newton's law"}, [](auto& b) { return &b.mass_per_vertex; },
      at_least(0))));
  keys.push_back(deformable(make_key<BodyConfig>(
      {"damping", "mass / time", "force of -damping times the velocity of a vertex"},
      [](auto& b) { return &b.damping; }, at_least(0))));
  keys.push_back(deformable(make_key<BodyConfig>(
      {"substeps", "", "of the vertices within a fluid step; default: as many as stability asks for"},
      [](auto& b) { return &b.substeps; }, at_least(1))));
}

void add_traction(std::vector<BodyKey>& keys) {
  const auto is_drag = [](const BodyConfig& b) { return b.traction.form == TractionForm::drag; };
  keys.push_back(make_key<BodyConfig>({"traction.form", "", "how the flow loads the surface"},
                                      [](auto& b) { return &b.traction.form; }));
  keys.push_back(only_when<BodyConfig>(
      make_key<BodyConfig>(
          {"traction.coefficient", "", "c_d in the drag c_d mu A / R of a vertex that stands for the area A"},
          [](auto& b) { return &b.traction.coefficient; }, positive()),
      "traction.form is \"drag\"", is_drag));
  keys.push_back(only_when<BodyConfig>(
      make_key<BodyConfig>({"traction.area", "",
                            "area A of the drag: of the reference shape (networks) or the present one (liquid "
                            "interfaces)"},
                           [](auto& b) { return &b.traction.area; }),
      "traction.form is \"drag\"", is_drag));
  keys.push_back(only_when<BodyConfig>(
      make_key<BodyConfig>(
          {"traction.probe_length", "length", "how far from the surface the flow is sampled; 0: the mean grid spacing, 1.5 times that for \"quadratic\""},
          [](auto& b) { return &b.traction.probe_length; }, at_least(0)),
      "traction.form is not \"none\" or \"drag\"", [](const BodyConfig& b) {
        return b.traction.form != TractionForm::none && b.traction.form != TractionForm::drag;
      }));
}

void add_potentials(std::vector<BodyKey>& keys) {
  keys.push_back(required(make_key<BodyConfig>(
      {"potentials.edge.stiffness", "force / length", "k_e of every edge's spring"},
      [](auto& b) {
        auto* p = member(b.potentials.edge);
        return p ? &p->stiffness : nullptr;
      },
      at_least(0))));
  keys.push_back(make_key<BodyConfig>(
      {"potentials.edge.rest_length", "", "of the springs, as a fraction of the initial length"},
      [](auto& b) {
        auto* p = member(b.potentials.edge);
        return p ? &p->rest_length : nullptr;
      },
      at_least(0)));
  keys.push_back(required(make_key<BodyConfig>(
      {"potentials.bending.stiffness", "energy", "k_b of every hinge between two faces"},
      [](auto& b) {
        auto* p = member(b.potentials.bending);
        return p ? &p->stiffness : nullptr;
      },
      at_least(0))));
  keys.push_back(make_key<BodyConfig>(
      {"potentials.bending.reference", "", "the angle of zero energy: that of the initial shape, or flat"},
      [](auto& b) {
        auto* p = member(b.potentials.bending);
        return p ? &p->reference : nullptr;
      }));
  keys.push_back(required(make_key<BodyConfig>(
      {"potentials.volume.stiffness", "energy / volume", "k_v, holds the volume enclosed by the body"},
      [](auto& b) {
        auto* p = member(b.potentials.volume);
        return p ? &p->stiffness : nullptr;
      },
      at_least(0))));
  keys.push_back(required(make_key<BodyConfig>(
      {"potentials.area.stiffness", "energy / area", "k_a, holds the area of each face"},
      [](auto& b) {
        auto* p = member(b.potentials.area);
        return p ? &p->stiffness : nullptr;
      },
      at_least(0))));
  keys.push_back(required(make_key<BodyConfig>(
      {"potentials.total_area.stiffness", "energy / area", "holds the area of the whole surface"},
      [](auto& b) {
        auto* p = member(b.potentials.total_area);
        return p ? &p->stiffness : nullptr;
      },
      at_least(0))));
  keys.push_back(required(make_key<BodyConfig>(
      {"potentials.surface_tension.sigma", "energy / area", "tension of a liquid-liquid interface"},
      [](auto& b) {
        auto* p = member(b.potentials.surface_tension);
        return p ? &p->sigma : nullptr;
      },
      at_least(0))));
  keys.push_back(make_key<BodyConfig>(
      {"potentials.surface_tension.mesh_control", "force / length",
       "stiffness of the tangential springs that keep the mesh even; 0: a fraction of sigma"},
      [](auto& b) {
        auto* p = member(b.potentials.surface_tension);
        return p ? &p->mesh_control : nullptr;
      },
      at_least(0)));
  for (auto& key : keys) {
    if (key.path.rfind("potentials.", 0) != 0) continue;
    key = only_when<BodyConfig>(std::move(key), "motion is \"deformable\"", is_deformable);
  }
}
}  // namespace

std::vector<Key<BodyConfig>> body_keys() {
  std::vector<BodyKey> keys;
  keys.push_back(required(make_key<BodyConfig>({"name", "", "names the body's output files and its keys in --set"},
                                               [](auto& b) { return &b.name; })));
  add_surface_keys(keys);
  add_placement_keys(keys);
  add_motion(keys);
  add_traction(keys);
  add_potentials(keys);
  return keys;
}

}  // namespace pliant
