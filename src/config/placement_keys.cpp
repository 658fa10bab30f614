#include "config/key_table.hpp"

namespace pliant {
namespace {
using BodyKey = Key<BodyConfig>;

bool is_single(const BodyConfig& b) { return !b.placement.count && !b.placement.positions; }
bool is_random(const BodyConfig& b) { return b.placement.count.has_value(); }

BodyKey for_random_copies(BodyKey key) { return only_when<BodyConfig>(std::move(key), "count is given", is_random); }
BodyKey for_copies(BodyKey key) {
  return only_when<BodyConfig>(std::move(key), "count or positions is given",
                               [](const BodyConfig& b) { return !is_single(b); });
}

BodyKey axis_key() {
  auto key = make_key<BodyConfig>({"rotation.axis", "", "about which the surface is turned, through its origin"},
                                  [](auto& b) { return &b.rotation.axis; });
  key.legal = "not 0";
  key.set = [set = std::move(key.set)](BodyConfig& body, const Json& value) -> std::optional<std::string> {
    const Vec3 before = body.rotation.axis;
    auto problem = set(body, value);
    if (problem || norm(body.rotation.axis) > 0) return problem;
    body.rotation.axis = before;
    return "must not be 0: give the direction to turn about";
  };
  return key;
}
}  // namespace

void add_placement_keys(std::vector<Key<BodyConfig>>& keys) {
  keys.push_back(axis_key());
  keys.push_back(make_key<BodyConfig>(
      {"rotation.angle", "degrees", "by which the surface is turned, before it is put at its center"},
      [](auto& b) { return &b.rotation.angle; }));
  keys.push_back(only_when<BodyConfig>(make_key<BodyConfig>({"center", "length", "where the surface's origin is put"},
                                                            [](auto& b) { return &b.center; }),
                                       "neither count nor positions is given", is_single));
  keys.push_back(make_key<BodyConfig>(
      {"count", "",
       "so many copies are placed at random, without overlap of their bounding spheres; default: one body, "
       "at its center"},
      [](auto& b) { return &b.placement.count; }, between(1, 1e6)));
  keys.push_back(instead_of(
      make_key<BodyConfig>({"positions", "",
                            "a CSV file with a copy on each line: x, y, z of its center and, if wanted, ax, ay, az, "
                            "angle: an axis and the degrees to turn about it, after `rotation`"},
                           [](auto& b) { return &b.placement.positions; }),
      {"count"}));
  keys.push_back(for_copies(make_key<BodyConfig>(
      {"seed", "", "of the random places and orientations"}, [](auto& b) { return &b.placement.seed; }, at_least(0))));
  keys.push_back(for_copies(
      make_key<BodyConfig>({"orientation", "", "of the copies: as given by `rotation`, or each turned at random"},
                           [](auto& b) { return &b.placement.orientation; })));
  keys.push_back(for_random_copies(make_key<BodyConfig>(
      {"gap", "length", "least distance of a copy from other bodies and from sides that are not periodic"},
      [](auto& b) { return &b.placement.gap; }, at_least(0))));
  keys.push_back(
      for_random_copies(make_key<BodyConfig>({"region.lower", "length",
                                              "lower corner of the region that the copies lie in; default: the "
                                              "box"},
                                             [](auto& b) { return &b.placement.region_lower; })));
  keys.push_back(
      for_random_copies(make_key<BodyConfig>({"region.upper", "length",
                                              "upper corner of the region that the copies lie in; default: the "
                                              "box"},
                                             [](auto& b) { return &b.placement.region_upper; })));
}

}  // namespace pliant
