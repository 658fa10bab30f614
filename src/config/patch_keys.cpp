#include "config/key_table.hpp"

namespace pliant {
namespace {
using PatchKey = Key<PatchConfig>;

PatchKey for_shapes(PatchKey key, std::vector<PatchShape> shapes) {
  std::string words;
  for (auto shape : shapes) words += (words.empty() ? "shape is \"" : " or \"") + word_for(shape) + "\"";
  return only_when<PatchConfig>(std::move(key), words, [shapes](const PatchConfig& patch) {
    for (auto shape : shapes) {
      if (patch.shape == shape) return true;
    }
    return false;
  });
}

PatchKey unless_balance(PatchKey key) {
  return only_when<PatchConfig>(std::move(key), "balance is false", [](const PatchConfig& p) { return !p.balance; });
}
}  // namespace

std::vector<Key<PatchConfig>> patch_keys() {
  using enum PatchShape;
  std::vector<PatchKey> keys;
  keys.push_back(required(make_key<PatchConfig>(
      {"name", "", "names the patch's column in history.csv and its keys in --set"}, [](auto& p) { return &p.name; })));
  keys.push_back(make_key<PatchConfig>(
      {"shape", "", "outside: all of the side beyond the radius, or, without one, all that other patches leave"},
      [](auto& p) { return &p.shape; }));
  keys.push_back(
      make_key<PatchConfig>({"center", "length", "of the patch, [x, y]"}, [](auto& p) { return &p.center; }));
  keys.push_back(for_shapes(make_key<PatchConfig>(
                                {"radius", "length", "of the disc, of the annulus without, of what is left out"},
                                [](auto& p) { return &p.radius; }, positive()),
                            {disc, annulus, outside}));
  const auto without_default = [](PatchKey key) { return key.default_value = Json(), key; };
  keys.push_back(for_shapes(
      without_default(make_key<PatchConfig>(
          {"inner_radius", "length", "of the annulus within"}, [](auto& p) { return &p.inner_radius; }, positive())),
      {annulus}));
  keys.push_back(for_shapes(
      without_default(make_key<PatchConfig>(
          {"size", "length", "of the rectangle along x and y"}, [](auto& p) { return &p.size; }, positive())),
      {rectangle}));
  auto rate =
      make_key<PatchConfig>({"flow_rate", "volume / time", "into the box: the name of a signal or a formula of t"},
                            [](auto& p) { return &p.flow_rate; });
  rate.default_value = Json();
  rate.get = [](const PatchConfig& p) { return p.flow_rate.empty() ? Json() : Json(p.flow_rate); };
  keys.push_back(unless_balance(std::move(rate)));
  keys.push_back(unless_balance(make_key<PatchConfig>(
      {"phase", "", "part of the signal's period, from 0 to 1, in which fluid passes; in the rest the patch is wall"},
      [](auto& p) { return &p.phase; }, between(0, 1))));
  keys.push_back(unless_balance(make_key<PatchConfig>(
      {"profile", "",
       "of the velocity; parabolic: as in a pipe, 0 at the edge (rectangle: the product of two parabolas, annulus: as "
       "between two pipes)"},
      [](auto& p) { return &p.profile; })));
  keys.push_back(make_key<PatchConfig>(
      {"balance", "", "true: lets out (or in) what all others bring in; one such patch, or an outflow side"},
      [](auto& p) { return &p.balance; }));
  return keys;
}

}  // namespace pliant
