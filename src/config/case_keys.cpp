#include "config/key_table.hpp"
#include "config/motion_keys.hpp"
#include "config/quantity.hpp"

namespace pliant {
namespace {
using CaseKey = Key<CaseConfig>;

/// The scheme is unstable beyond sqrt(3).
constexpr Limits largest_cfl{.min = 0, .min_bound = Bound::exclusive, .max = 1.732};

/// Beyond it the cells at the ends are lost in rounding.
constexpr Limits strength{.min = 0, .min_bound = Bound::exclusive, .max = 10};

struct BoundaryWord {
  std::string word;
  BoundarySpec spec;
};

std::vector<BoundaryWord> boundary_words() {
  return {{"periodic", PeriodicSide{}},
          {"wall", WallSide{}},
          {"free-slip", FreeSlipSide{}},
          {"inflow", InflowSide{}},
          {"outflow", OutflowSide{}}};
}

CaseKey side_type_key(int side) {
  CaseKey key;
  key.path = "boundary." + side_names()[side] + ".type";
  key.doc = "condition on this side";
  key.type = "word";
  for (const auto& known : boundary_words()) key.legal += (key.legal.empty() ? "\"" : ", \"") + known.word + "\"";
  key.default_value = "periodic";
  key.set = [side, legal = key.legal](CaseConfig& config, const Json& value) -> std::optional<std::string> {
    if (!value.is_string()) return "must be one of " + legal + ", not " + describe_value(value);
    for (const auto& known : boundary_words()) {
      if (known.word == value.get<std::string>()) return config.boundary[side] = known.spec, std::nullopt;
    }
    return "unknown type \"" + value.get<std::string>() + "\"; known: " + legal;
  };
  key.get = [side](const CaseConfig& config) -> Json { return boundary_word(config.boundary[side]); };
  return key;
}

CaseKey side_velocity_key(int side) {
  auto key = make_key<CaseConfig>({"boundary." + side_names()[side] + ".velocity", "velocity",
                                   "of the wall, no component normal to it; of the inflow, into the box"},
                                  [side](auto& config) {
                                    auto& spec = config.boundary[side];
                                    if (auto* inflow = std::get_if<InflowSide>(&spec)) return &inflow->velocity;
                                    auto* wall = std::get_if<WallSide>(&spec);
                                    return wall ? &wall->velocity : nullptr;
                                  });
  key.default_value = Json::array({0.0, 0.0, 0.0});
  return only_when<CaseConfig>(std::move(key), "the side's type is \"wall\" or \"inflow\"",
                               [side](const CaseConfig& config) {
                                 return std::holds_alternative<WallSide>(config.boundary[side]) ||
                                        std::holds_alternative<InflowSide>(config.boundary[side]);
                               });
}

template <class Value>
CaseKey inflow_key(int side, KeyText text, Value InflowSide::*member, Limits limits = {}) {
  text.path = "boundary." + side_names()[side] + "." + text.path;
  auto key = make_key<CaseConfig>(
      std::move(text),
      [side, member](auto& config) {
        auto* inflow = std::get_if<InflowSide>(&config.boundary[side]);
        return inflow ? &(inflow->*member) : nullptr;
      },
      limits);
  key.default_value = ValueCodec<Value>::write(InflowSide{}.*member);
  return only_when<CaseConfig>(std::move(key), "the side's type is \"inflow\"", [side](const CaseConfig& config) {
    return std::holds_alternative<InflowSide>(config.boundary[side]);
  });
}

CaseKey inflow_signal_key(int side) {
  auto key = inflow_key(side, {"signal", "", "factor on the velocity: the name of a signal or a formula of t"},
                        &InflowSide::signal);
  key.default_value = Json();
  key.get = [get = std::move(key.get)](const CaseConfig& config) {
    auto text = get(config);
    return text == "" ? Json() : text;
  };
  return key;
}

std::function<bool(const CaseConfig&)> flow_is(std::vector<InitialFlow> flows) {
  return [flows](const CaseConfig& config) {
    for (auto flow : flows) {
      if (config.initial.flow == flow) return true;
    }
    return false;
  };
}

std::string flow_condition(const std::vector<InitialFlow>& flows) {
  std::string text;
  for (auto flow : flows) text += (text.empty() ? "initial.flow is \"" : " or \"") + word_for(flow) + "\"";
  return text;
}

CaseKey for_flows(CaseKey key, const std::vector<InitialFlow>& flows) {
  return only_when<CaseConfig>(std::move(key), flow_condition(flows), flow_is(flows));
}

CaseKey scale_key(const std::string& name, const std::string& doc, Dimension dimension,
                  std::string UnitsConfig::*text) {
  auto key = make_key<CaseConfig>({"units." + name, "", doc}, [text](auto& c) {
    auto* units = member(c.units);
    return units ? &(units->*text) : nullptr;
  });
  key.type = "number with unit";
  key.legal = "> 0 " + si_unit(dimension);
  key.default_value = Json();
  key.set = [dimension, text](CaseConfig& config, const Json& value) -> std::optional<std::string> {
    if (!value.is_string()) return "must be a text, a number with its unit, not " + describe_value(value);
    const auto& given = value.get_ref<const std::string&>();
    std::string problem;
    const auto quantity = read_quantity(given, problem);
    if (!quantity) return "is \"" + given + "\": " + problem;
    if (quantity->dimension != dimension)
      return "is \"" + given + "\", " + describe(quantity->dimension) + ", but must be " + describe(dimension) +
             " (in SI: " + si_unit(dimension) + ")";
    if (!(quantity->value > 0)) return "must be > 0, not \"" + given + "\"";
    member(config.units)->*text = given;
    return std::nullopt;
  };
  key.get = [text](const CaseConfig& config) -> Json {
    return config.units && !((*config.units).*text).empty() ? Json((*config.units).*text) : Json();
  };
  return key;
}

void add_units(std::vector<CaseKey>& keys) {
  keys.push_back(required(scale_key("length", "the length that is 1 in the case's own units, such as \"25 mm\"",
                                    {1, 0, 0}, &UnitsConfig::length)));
  keys.push_back(scale_key("velocity", "the velocity that is 1, or time", {1, -1, 0}, &UnitsConfig::velocity));
  keys.push_back(
      instead_of(scale_key("time", "the time that is 1", {0, 1, 0}, &UnitsConfig::time), {"units.velocity"}));
  keys.push_back(required(
      scale_key("density", "the density that is 1, as a rule that of the fluid", {-3, 0, 1}, &UnitsConfig::density)));
}

void add_box(std::vector<CaseKey>& keys) {
  const auto by_law = [](StretchingLaw law, CaseKey key) {
    return only_when<CaseConfig>(std::move(key), "box.stretching.z.law is \"" + word_for(law) + "\"",
                                 [law](const CaseConfig& c) { return c.box.stretching_z.law == law; });
  };
  keys.push_back(make_key<CaseConfig>(
      {"box.size", "length", "extent of the box in x, y, z"}, [](auto& c) { return &c.box.size; }, positive()));
  keys.push_back(make_key<CaseConfig>({"box.origin", "length", "corner of the box with the smallest coordinates"},
                                      [](auto& c) { return &c.box.origin; }));
  keys.push_back(make_key<CaseConfig>(
      {"box.cells", "", "number of cells in x, y, z"}, [](auto& c) { return &c.box.cells; }, between(1, 100000)));
  keys.push_back(make_key<CaseConfig>({"box.stretching.z.law", "", "how the cells are spread along z"},
                                      [](auto& c) { return &c.box.stretching_z.law; }));
  keys.push_back(
      by_law(StretchingLaw::tanh, make_key<CaseConfig>(
                                      {"box.stretching.z.strength", "", "larger packs more cells at both ends"},
                                      [](auto& c) { return &c.box.stretching_z.strength; }, strength)));
  keys.push_back(
      by_law(StretchingLaw::cluster,
             make_key<CaseConfig>({"box.stretching.z.center", "length", "middle of the range of equal cells"},
                                  [](auto& c) { return &c.box.stretching_z.center; })));
  keys.push_back(by_law(StretchingLaw::cluster, make_key<CaseConfig>(
                                                    {"box.stretching.z.width", "length", "of the range of equal cells"},
                                                    [](auto& c) { return &c.box.stretching_z.width; }, at_least(0))));
  keys.push_back(by_law(StretchingLaw::cluster,
                        make_key<CaseConfig>(
                            {"box.stretching.z.growth", "",
                             "outside that range each cell is longer than the one before it by about this part"},
                            [](auto& c) { return &c.box.stretching_z.growth; },
                            Limits{.min = 0, .min_bound = Bound::exclusive, .max = 0.5})));
}

void add_fluid(std::vector<CaseKey>& keys) {
  keys.push_back(make_key<CaseConfig>(
      {"fluid.density", "mass / length^3", "of the fluid"}, [](auto& c) { return &c.fluid.density; }, positive()));
  keys.push_back(make_key<CaseConfig>(
      {"fluid.viscosity", "mass / (length time)", "dynamic viscosity of the fluid"},
      [](auto& c) { return &c.fluid.viscosity; }, at_least(0)));
  keys.push_back(make_key<CaseConfig>({"forcing.acceleration", "length / time^2", "force per unit mass of fluid"},
                                      [](auto& c) { return &c.forcing.acceleration; }));
  keys.push_back(
      make_key<CaseConfig>({"forcing.gravity", "length / time^2",
                            "moves bodies that are heavier or lighter than the fluid; the fluid's own weight is "
                            "balanced by its pressure and left out"},
                           [](auto& c) { return &c.forcing.gravity; }));
  keys.push_back(required(make_key<CaseConfig>(
      {"forcing.bulk_velocity.axis", "", "direction of a constant mass flux; must be periodic"}, [](auto& c) {
        auto* bulk = member(c.forcing.bulk_velocity);
        return bulk ? &bulk->axis : nullptr;
      })));
  keys.push_back(required(make_key<CaseConfig>(
      {"forcing.bulk_velocity.value", "velocity", "mean velocity that the constant mass flux keeps"}, [](auto& c) {
        auto* bulk = member(c.forcing.bulk_velocity);
        return bulk ? &bulk->value : nullptr;
      })));
}

void add_boundary(std::vector<CaseKey>& keys) {
  for (int side = 0; side < 6; ++side) {
    keys.push_back(side_type_key(side));
    keys.push_back(side_velocity_key(side));
    keys.push_back(inflow_key(side,
                              {"profile", "", "parabolic: times 4 s (1 - s) along each bounded direction of the side"},
                              &InflowSide::profile));
    keys.push_back(inflow_key(side, {"ramp", "time", "over which the inflow grows from 0; 0: at once"},
                              &InflowSide::ramp, at_least(0)));
    keys.push_back(inflow_signal_key(side));
  }
}

void add_initial(std::vector<CaseKey>& keys) {
  using enum InitialFlow;
  keys.push_back(
      make_key<CaseConfig>({"initial.flow", "", "the flow at time 0"}, [](auto& c) { return &c.initial.flow; }));
  keys.push_back(for_flows(
      make_key<CaseConfig>({"initial.velocity", "velocity", "uniform: the velocity; perturbed: the mean velocity"},
                           [](auto& c) { return &c.initial.velocity; }),
      {uniform, perturbed}));
  keys.push_back(
      for_flows(make_key<CaseConfig>({"initial.amplitude", "velocity",
                                      "poiseuille: velocity in the middle; taylor-green, perturbed: velocity scale"},
                                     [](auto& c) { return &c.initial.amplitude; }),
                {poiseuille, taylor_green, perturbed}));
  keys.push_back(for_flows(make_key<CaseConfig>({"initial.direction", "", "direction of the flow"},
                                                [](auto& c) { return &c.initial.direction; }),
                           {poiseuille}));
  keys.push_back(for_flows(
      make_key<CaseConfig>({"initial.normal", "",
                            "couette, poiseuille: normal of the walls; taylor-green: of the plane of the vortices"},
                           [](auto& c) { return &c.initial.normal; }),
      {couette, poiseuille, taylor_green}));
  keys.push_back(for_flows(
      make_key<CaseConfig>(
          {"initial.seed", "", "of the random perturbation"}, [](auto& c) { return &c.initial.seed; }, at_least(0)),
      {perturbed}));
}

void add_time(std::vector<CaseKey>& keys) {
  const auto adaptive = [](const CaseConfig& c) { return !c.time.step; };
  keys.push_back(make_key<CaseConfig>(
      {"time.end", "time", "the run ends at this time"}, [](auto& c) { return &c.time.end; }, at_least(0)));
  keys.push_back(make_key<CaseConfig>(
      {"time.max_steps", "", "the run ends after so many steps, if that is earlier"},
      [](auto& c) { return &c.time.max_steps; }, at_least(0)));
  keys.push_back(
      instead_of(make_key<CaseConfig>(
                     {"time.step", "time",
                      "fixed time step, shortened only to hit the times of outputs; else the step follows cfl"},
                     [](auto& c) { return &c.time.step; }, positive()),
                 {"time.cfl", "time.max_step"}));
  keys.push_back(only_when<CaseConfig>(
      make_key<CaseConfig>(
          {"time.cfl", "", "the step keeps the largest dt (u / dx + v / dy + w / dz) at this, by absolute values"},
          [](auto& c) { return &c.time.cfl; }, largest_cfl),
      "time.step is not given", adaptive));
  keys.push_back(
      only_when<CaseConfig>(make_key<CaseConfig>(
                                {"time.max_step", "time", "upper bound on the step that follows cfl; 0: none"},
                                [](auto& c) { return &c.time.max_step; }, at_least(0)),
                            "time.step is not given", adaptive));
  keys.push_back(make_key<CaseConfig>({"time.viscous", "", "directions in which viscous terms are implicit"},
                                      [](auto& c) { return &c.time.viscous; }));
  keys.push_back(
      make_key<CaseConfig>({"time.sweeps", "",
                            "how a step goes through memory: fused (few passes), or plain (one loop for each "
                            "operator, slower, the same results but for round-off)"},
                           [](auto& c) { return &c.time.sweeps; }));
}

template <class Access>
void add_series(std::vector<CaseKey>& keys, const std::string& name, const std::string& what, Access series) {
  keys.push_back(instead_of(make_key<CaseConfig>(
                                {"output." + name + ".interval", "time", "time between two " + what},
                                [series](auto& c) { return &series(c).interval; }, positive()),
                            {"output." + name + ".every"}));
  keys.push_back(make_key<CaseConfig>(
      {"output." + name + ".every", "steps", "steps between two " + what},
      [series](auto& c) { return &series(c).every; }, at_least(1)));
  keys.push_back(make_key<CaseConfig>(
      {"output." + name + ".phases", "", what + " at these phases of every cycle of output.period; 0: its beginning"},
      [series](auto& c) { return &series(c).phases; }, Limits{.min = 0, .max = 1, .max_bound = Bound::exclusive}));
}

void add_phase_average(std::vector<CaseKey>& keys) {
  const auto add = [&](KeyText text, auto value, Limits limits) {
    text.path = "output.phase_average." + text.path;
    return make_key<CaseConfig>(
        std::move(text),
        [value](auto& c) {
          auto* group = member(c.output.phase_average);
          return group ? &(group->*value) : nullptr;
        },
        limits);
  };
  using P = PhaseAverageConfig;
  keys.push_back(required(add({"bins", "",
                               "equal parts of output.period, in each of which the flow is averaged over all "
                               "cycles: phase_average.xdmf"},
                              &P::bins, between(1, 10000))));
  keys.push_back(add({"from", "time", "before which nothing counts"}, &P::from, at_least(0)));
  keys.push_back(
      add({"every", "steps", "steps between two samples; each counts as much as the time since the one before"},
          &P::every, at_least(1)));
}

void add_output(std::vector<CaseKey>& keys) {
  keys.push_back(make_key<CaseConfig>(
      {"output.period", "time", "of the cycle that begins at time 0, for all that goes by phases"},
      [](auto& c) { return &c.output.period; }, positive()));
  keys.push_back(make_key<CaseConfig>(
      {"output.history.every", "steps", "steps between two lines of the CSV files"},
      [](auto& c) { return &c.output.history.every; }, at_least(1)));
  add_series(
      keys, "fields", "outputs of velocity and pressure", [](auto& c) -> auto& { return c.output.fields; });
  keys.push_back(make_key<CaseConfig>({"output.fields.vorticity", "", "true: the vorticity as well"},
                                      [](auto& c) { return &c.output.fields.vorticity; }));
  add_series(
      keys, "surfaces", "outputs of the bodies' surfaces", [](auto& c) -> auto& { return c.output.surfaces; });
  add_phase_average(keys);
}

void add_checkpoint(std::vector<CaseKey>& keys) {
  keys.push_back(make_key<CaseConfig>(
      {"checkpoint.every", "steps", "steps between two checkpoints, beside those that are written as a run stops"},
      [](auto& c) { return &c.checkpoint.every; }, at_least(1)));
  keys.push_back(make_key<CaseConfig>(
      {"checkpoint.minutes", "minutes", "wall-clock time between two checkpoints"},
      [](auto& c) { return &c.checkpoint.minutes; }, positive()));
  keys.push_back(make_key<CaseConfig>(
      {"checkpoint.keep", "", "the newest checkpoints that stay; 0: none are written, not even as the run stops"},
      [](auto& c) { return &c.checkpoint.keep; }, between(0, 1000)));
}
}  // namespace

std::array<std::string, 6> side_names() { return {"x-", "x+", "y-", "y+", "z-", "z+"}; }

std::string boundary_word(const BoundarySpec& spec) {
  for (const auto& known : boundary_words()) {
    if (known.spec.index() == spec.index()) return known.word;
  }
  return {};
}

std::vector<Key<CaseConfig>> case_keys() {
  std::vector<CaseKey> keys;
  keys.push_back(make_key<CaseConfig>({"title", "", "one line that names the case"}, [](auto& c) { return &c.title; }));
  add_units(keys);
  add_box(keys);
  add_fluid(keys);
  add_boundary(keys);
  add_initial(keys);
  add_time(keys);
  add_interaction_keys(keys);
  add_output(keys);
  add_checkpoint(keys);
  return keys;
}

}  // namespace pliant
