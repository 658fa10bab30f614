#include "config/key_table.hpp"
#include "config/motion_keys.hpp"

namespace pliant {
namespace {
using BodyKey = Key<BodyConfig>;

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
          {"traction.probe_length", "length",
           "how far from the surface the flow is sampled; 0: the mean grid spacing, 1.5 times that for \"quadratic\""},
          [](auto& b) { return &b.traction.probe_length; }, at_least(0)),
      "traction.form is not \"none\" or \"drag\"", [](const BodyConfig& b) {
        return b.traction.form != TractionForm::none && b.traction.form != TractionForm::drag;
      }));
}
}  // namespace

std::vector<Key<BodyConfig>> body_keys() {
  std::vector<BodyKey> keys;
  keys.push_back(required(make_key<BodyConfig>({"name", "", "names the body's output files and its keys in --set"},
                                               [](auto& b) { return &b.name; })));
  add_surface_keys(keys);
  add_placement_keys(keys);
  add_motion_keys(keys);
  add_traction(keys);
  add_structure_keys(keys);
  return keys;
}

}  // namespace pliant
