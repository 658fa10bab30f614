#include "config/read_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "config/case_document.hpp"
#include "config/quantity.hpp"
#include "config/validate.hpp"
#include "core/error.hpp"

namespace pliant {
namespace {
class Reader {
 public:
  Reader(CaseDocument document, bool overridden) : document_(std::move(document)), overridden_(overridden) {
    problems_ = std::move(document_.problems);
  }

  CaseConfig read() {
    CaseConfig config;
    config.file = document_.file;
    config.folder = document_.file.has_parent_path() ? document_.file.parent_path() : ".";
    origins_ = &config.origins;
    read_scales();
    apply(case_keys(), document_.root, config);
    read_signals(config);
    read_cavities(config);
    read_patches(config);
    for (const auto& scope : document_.bodies) {
      BodyConfig body;
      apply(body_keys(), scope, body);
      if (!scope.find("surface.shape") && !scope.find("surface.file"))
        complain(scope, "surface", scope.origin,
                 "is missing; write surface = { shape = \"sphere\", ... } or surface = { file = \"...\" }");
      config.origins.emplace(scope.prefix.substr(0, scope.prefix.size() - 1), scope.origin);
      read_parts(scope.prefix, body);
      config.bodies.push_back(std::move(body));
    }
    return config;
  }

  std::vector<std::string>& problems() { return problems_; }
  const std::set<std::string>& suspect() const { return suspect_; }

 private:
  // Before all else: other keys are turned into the case's own units as they are read.
  void read_scales() {
    CaseConfig scratch;
    for (const auto& key : case_keys())
      if (const auto* entry = document_.root.find(key.path); entry && key.path.rfind("units.", 0) == 0) {
        key.set(scratch, entry->value);
      }
    if (scratch.units) scales_ = scales_of(*scratch.units);
    has_units_ = document_.root.sections.count("units") > 0;
    if (has_units_ && !document_.root.find("units.velocity") && !document_.root.find("units.time"))
      complain(document_.root, "units.velocity", document_.file.string(),
               "is missing: the velocity that is 1 in the case's own units, or units.time instead");
  }

  void read_signals(CaseConfig& config) {
    for (const auto& [name, given] : document_.signals) {
      const auto key = "signals." + name;
      config.origins.emplace(key, given.origin);
      auto& signal = config.signals[name];
      auto scope = given;
      read_scale(scope, signal);
      apply(signal_keys(), scope, signal);
      read_signal_units(scope, signal);
      if (!scope.find("table") && !scope.find("csv") && !scope.find("formula")) {
        suspect_.insert(key);
        problems_.push_back(
            fmt::format("{}: {} has no values; give it table = [[t, v], ...], csv = \"FILE\" or formula = \"...\"",
                        scope.origin, key));
      }
    }
  }

  // Any unit will do, and tells what the signal is.
  void read_scale(Scope& scope, SignalConfig& signal) {
    for (auto& entry : scope.entries) {
      if (entry.path != "scale" || !entry.value.is_string()) continue;
      std::string what;
      const auto text = entry.value.get<std::string>();
      const auto quantity = read_quantity(text, what);
      std::optional<std::string> problem;
      if (!quantity) problem = fmt::format("is \"{}\": {}", text, what);
      else if (const auto* unit = scope.find("unit.v"))
        problem =
            fmt::format("is \"{}\", and unit.v ({}) gives the values a unit too; give one of them", text, unit->origin);
      else entry.value = to_own_units(entry.value, {.dimension = quantity->dimension}, scales(), problem);
      if (problem) {
        if (!is_excused(problem)) complain(scope, "scale", entry.origin, *problem);
        entry.value = 1;
      } else {
        signal.dimension = quantity->dimension;
      }
    }
  }

  void read_signal_units(const Scope& scope, SignalConfig& signal) {
    const auto factor = [&](const char* path, std::optional<Dimension> wanted) -> std::optional<Quantity> {
      const auto* entry = scope.find(path);
      if (!entry || suspect_.count(scope.prefix + path) > 0) return std::nullopt;
      const auto text = entry->value.get<std::string>();
      std::string what;
      const auto unit = read_unit(text, what);
      std::optional<std::string> problem;
      if (!unit) problem = "is not understood: " + what;
      else if (wanted && unit->dimension != *wanted)
        problem = fmt::format("is \"{}\", {}, but must be {}", text, describe(unit->dimension), describe(*wanted));
      else if (!scales_ && unit->dimension != Dimension{})
        problem = fmt::format("is \"{}\", {}", text, how_to_give_scales());
      if (!problem) return unit;
      if (!is_excused(problem)) complain(scope, path, entry->origin, *problem);
      return std::nullopt;
    };
    const UnitScales scales = scales_.value_or(UnitScales{});
    if (const auto t = factor("unit.t", Dimension{0, 1, 0}))
      signal.time_unit = in_own_units(*t, {t->dimension}, scales);
    if (const auto v = factor("unit.v", std::nullopt)) {
      signal.value_unit = in_own_units(*v, {v->dimension}, scales);
      signal.dimension = v->dimension;
    }
    constexpr Dimension flow_rate{3, -1, 0};
    const auto* volume = scope.find("volume");
    if (signal.volume && signal.dimension.value_or(flow_rate) != flow_rate)
      complain(scope, "volume", volume->origin,
               fmt::format("is what a flow rate carries, but the unit of the values makes them {}",
                           describe(*signal.dimension)));
    else if (signal.volume) signal.dimension = flow_rate;
  }

  const UnitScales* scales() const { return scales_ ? &*scales_ : nullptr; }

  // Scales that are there, but wrong, are complained about already.
  bool is_excused(const std::optional<std::string>& problem) const {
    return has_units_ && !scales_ && problem->find(how_to_give_scales()) != std::string::npos;
  }

  void read_cavities(CaseConfig& config) {
    for (const auto& [name, scope] : document_.cavities) {
      config.origins.emplace("cavity." + name, scope.origin);
      apply(cavity_keys(), scope, config.cavities.emplace_back());
      config.cavities.back().name = name;
    }
  }

  void read_patches(CaseConfig& config) {
    for (const auto& [side, scope] : document_.patches) {
      PatchConfig patch;
      const auto key = scope.prefix.substr(0, scope.prefix.size() - 1);
      config.origins.emplace(key, scope.origin);
      apply(patch_keys(), scope, patch);
      const auto at = static_cast<std::size_t>(side);
      const bool forgiven = overridden_ && scope.origin.rfind("--set", 0) != 0;
      if (auto* patches = patches_of(config.boundary[at])) patches->push_back(std::move(patch));
      else if (!forgiven && suspect_.count("boundary." + side_names()[at] + ".type") == 0)
        problems_.push_back(
            fmt::format("{}: {} is on a side of type \"{}\"; only \"wall\" and \"free-slip\" sides of z have patches",
                        scope.origin, key, boundary_word(config.boundary[at])));
    }
  }

  void read_parts(const std::string& prefix, BodyConfig& body) {
    for (const auto& part : document_.parts) {
      if (part.body != prefix) continue;
      origins_->emplace(part.scope.prefix.substr(0, part.scope.prefix.size() - 1), part.scope.origin);
      if (part.kind == PartKind::selection) read_part(selection_keys(), part, body.selections);
      if (part.kind == PartKind::tether) read_part(tether_keys(), part, body.tethers);
      if (part.kind == PartKind::cord) read_part(cord_keys(), part, body.cords);
      if (part.kind == PartKind::pull) read_part(pull_keys(), part, body.pulls);
    }
  }

  template <class Config>
  void read_part(const std::vector<Key<Config>>& keys, const PartScope& part, std::vector<Config>& all) {
    apply(keys, part.scope, all.emplace_back());
    all.back().name = part.name;
  }

  void complain(const Scope& scope, const std::string& path, const std::string& origin, const std::string& what) {
    suspect_.insert(scope.prefix + path);
    problems_.push_back(fmt::format("{}: {}{} {}", origin, scope.prefix, path, what));
  }

  template <class Config>
  void apply(const std::vector<Key<Config>>& keys, const Scope& scope, Config& config) {
    for (const auto& key : keys) {
      const auto* entry = scope.find(key.path);
      if (!entry) continue;
      origins_->emplace(scope.prefix + key.path, entry->origin);
      std::optional<std::string> problem;
      const auto value = with_own_units(key, entry->value, problem);
      if (!problem) problem = key.set(config, value);
      if (problem && !is_excused(problem)) complain(scope, key.path, entry->origin, *problem);
      else if (problem) suspect_.insert(scope.prefix + key.path);
    }
    for (const auto& key : keys) {
      check_meaning(key, keys, scope, config);
      check_presence(key, scope);
    }
  }

  // Where a formula may stand, a quantity is one that is constant.
  template <class Config>
  Json with_own_units(const Key<Config>& key, const Json& value, std::optional<std::string>& problem) const {
    const auto unit = key.quantity();
    if (!unit) return value;
    if (key.type != ValueCodec<std::string>::type_name()) return to_own_units(value, *unit, scales(), problem);
    if (!value.is_string() || !looks_like_quantity(value.get_ref<const std::string&>())) return value;
    const Json number = to_own_units(value, *unit, scales(), problem);
    return problem ? value : Json(fmt::format("{}", number.get<double>()));
  }

  template <class Config>
  void check_meaning(const Key<Config>& key, const std::vector<Key<Config>>& keys, const Scope& scope,
                     const Config& config) {
    const auto* entry = scope.find(key.path);
    if (!entry) return;
    for (const auto& rival : keys) {
      const auto* second = scope.find(rival.path);
      if (!second || std::count(rival.excludes.begin(), rival.excludes.end(), key.path) == 0) continue;
      return complain(scope, key.path, entry->origin,
                      fmt::format("and {} ({}) exclude each other; give one of them", rival.path, second->origin));
    }
    // An override that changes a choice makes keys of the file meaningless; that is not the file's fault.
    const bool forgiven = overridden_ && entry->origin.rfind("--set", 0) != 0;
    if (key.applies && !key.applies(config) && !forgiven)
      complain(scope, key.path, entry->origin, fmt::format("has no effect: it counts only when {}", key.condition));
  }

  template <class Config>
  void check_presence(const Key<Config>& key, const Scope& scope) {
    if (key.presence != Presence::required || scope.find(key.path)) return;
    const auto dot = key.path.rfind('.');
    const bool asked = dot == std::string::npos || scope.sections.count(key.path.substr(0, dot)) > 0;
    if (asked)
      complain(scope, key.path, scope.origin.empty() ? document_.file.string() : scope.origin,
               fmt::format("is missing: {} ({})", key.doc, key.type));
  }

  CaseDocument document_;
  bool overridden_;
  std::vector<std::string> problems_;
  std::set<std::string> suspect_;
  std::map<std::string, std::string>* origins_ = nullptr;
  std::optional<UnitScales> scales_;
  bool has_units_ = false;
};
}  // namespace

std::filesystem::path find_case_file(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error) ? path / "case.toml" : path;
}

CaseConfig read_case(const std::filesystem::path& path, std::span<const std::string> overrides, int ranks,
                     const CaseCheck& further) {
  Reader reader(read_document(find_case_file(path), overrides), !overrides.empty());
  auto config = reader.read();
  auto problems = std::move(reader.problems());
  for (auto& problem : validate(config, ranks, reader.suspect())) problems.push_back(std::move(problem));
  if (further) further(config, reader.suspect(), problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return config;
}

}  // namespace pliant
