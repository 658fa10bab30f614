#include "config/key_table.hpp"

namespace pliant {
namespace {

/// A text that is not given is empty, and stays out of the print-out.
Key<CavityConfig> text_key(KeyText text, std::string legal, std::string CavityConfig::*member) {
  auto key = make_key<CavityConfig>(std::move(text), [member](auto& c) { return &(c.*member); });
  key.default_value = Json();
  key.legal = std::move(legal);
  key.get = [member](const CavityConfig& c) { return (c.*member).empty() ? Json() : Json(c.*member); };
  return key;
}

template <class Value>
Key<CavityConfig> jet_key(KeyText text, Value JetConfig::*value) {
  text.path = "jet." + text.path;
  return make_key<CavityConfig>(std::move(text), [value](auto& c) {
    auto* jet = member(c.jet);
    return jet ? &(jet->*value) : nullptr;
  });
}

}  // namespace

std::vector<Key<CavityConfig>> cavity_keys() {
  std::vector<Key<CavityConfig>> keys;
  const auto add = [&](Key<CavityConfig> key) { keys.push_back(std::move(key)); };
  add(required(text_key({"body", "",
                         "whose inside it is; each border of an open one gets a lid, a fan to the mean of "
                         "its vertices"},
                        "the name of a body without copies", &CavityConfig::body)));
  add(text_key({"flow", "volume / time", "what flows in, for comparison with the rate of the volume"},
               "the name of a signal, or a formula of t", &CavityConfig::flow));
  add(make_key<CavityConfig>(
      {"flow_factor", "", "on `flow`: -1 where a positive flow empties the cavity, an area where it is a velocity"},
      [](auto& c) { return &c.flow_factor; }));
  add(make_key<CavityConfig>(
      {"period", "time", "of the cycle that begins at time 0; default: that of the signal `flow`, else output.period"},
      [](auto& c) { return &c.period; }, positive()));
  add(make_key<CavityConfig>(
      {"ejection_fraction", "",
       "(V_max - V_min) / V_max that the signal `flow` is to cause from the volume at the start: sets the signal's "
       "scale, "
       "whatever it was"},
      [](auto& c) { return &c.ejection_fraction; },
      Limits{.min = 0, .min_bound = Bound::exclusive, .max = 1, .max_bound = Bound::exclusive}));
  add(required(jet_key({"origin", "length", "from which the depth of the jet is measured, as the middle of an orifice"},
                       &JetConfig::origin)));
  add(jet_key({"axis", "", "direction in which depth is measured"}, &JetConfig::axis));
  add(required(jet_key({"threshold", "velocity", "along the axis, above which fluid belongs to the jet"},
                       &JetConfig::threshold)));
  return keys;
}

}  // namespace pliant
