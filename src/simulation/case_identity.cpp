#include "simulation/case_identity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "config/print_case.hpp"
#include "io/checksum.hpp"

namespace pliant {
namespace {

constexpr std::array may_change{"title",          "output",   "cavity",    "checkpoint",   "time.end",
                                "time.max_steps", "time.cfl", "time.step", "time.max_step"};

bool is_in(const std::string& key, const std::string& part) {
  return key == part || key.compare(0, part.size() + 1, part + ".") == 0;
}

// Every value under its dotted key; the elements of lists of tables by their names.
void flatten(const Json& value, const std::string& key, std::map<std::string, Json>& flat) {
  const auto below = [&](const std::string& name) { return key.empty() ? name : key + "." + name; };
  const bool is_list_of_tables = value.is_array() && !value.empty() && value.front().is_object();
  if (value.is_object()) {
    for (const auto& [name, child] : value.items()) flatten(child, below(name), flat);
  } else if (is_list_of_tables) {
    for (std::size_t n = 0; n < value.size(); ++n) {
      const auto name = below(value[n].value("name", fmt::to_string(n)));
      flat[name] = "given";
      flatten(value[n], name, flat);
    }
  } else if (std::none_of(may_change.begin(), may_change.end(), [&](const char* part) { return is_in(key, part); })) {
    flat[key] = value;
  }
}

std::string say(const std::map<std::string, Json>& values, const std::string& key) {
  const auto found = values.find(key);
  if (found == values.end()) return "not given";
  return found->second == "given" ? "given" : found->second.dump();
}

}  // namespace

Json case_identity(const CaseConfig& config) {
  std::map<std::string, Json> flat;
  flatten(resolved_case(config), "", flat);
  const auto add_file = [&](const std::string& key, const std::filesystem::path& file) {
    flat[key + " (checksum of its contents)"] = checksum_of_file(config.folder / file);
  };
  for (const auto& body : config.bodies) {
    const auto key = "body." + body.name;
    if (const auto* surface = std::get_if<FileSurface>(&body.surface)) add_file(key + ".surface.file", surface->file);
    if (const auto& positions = body.placement.positions) add_file(key + ".positions", *positions);
  }
  for (const auto& [name, signal] : config.signals)
    if (!signal.csv.empty()) add_file("signals." + name + ".csv", signal.csv);
  return flat;
}

std::vector<std::string> differences(const Json& in_case, const Json& in_checkpoint) {
  const auto now = in_case.get<std::map<std::string, Json>>(), then = in_checkpoint.get<std::map<std::string, Json>>();
  auto keys = now;
  keys.insert(then.begin(), then.end());
  std::vector<std::string> found;
  std::string missing;  // a whole table, of which no key need be told
  for (const auto& [key, value] : keys) {
    if (!missing.empty() && is_in(key, missing)) continue;
    const auto a = say(now, key), b = say(then, key);
    if (now.contains(key) != then.contains(key)) missing = key;
    if (a != b) found.push_back(fmt::format("{} is {} in the case, {} in the checkpoint", key, a, b));
  }
  return found;
}

}  // namespace pliant
