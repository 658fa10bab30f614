#include "config/flatten.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "config/edit_distance.hpp"

namespace pliant {
namespace {
template <class Config>
KnownPaths known_paths(const std::vector<Key<Config>>& keys) {
  KnownPaths known;
  for (const auto& key : keys) {
    known.keys.insert(key.path);
    known.names.push_back(key.path);
    for (auto dot = key.path.find('.'); dot != std::string::npos; dot = key.path.find('.', dot + 1)) {
      const auto section = key.path.substr(0, dot);
      if (known.sections.insert(section).second) known.names.push_back(section);
    }
  }
  return known;
}

class Flattener {
 public:
  Flattener(const KnownPaths& known, const OriginOf& origin_of, Scope& scope, std::vector<std::string>& problems)
      : known_(known), origin_of_(origin_of), scope_(scope), problems_(problems) {}

  void table(const toml::table& table, const std::string& above) {
    for (const auto& [key, node] : table) {
      if (above.empty() && known_.left_out.count(std::string(key.str())) > 0) continue;
      if (above.rfind("boundary.", 0) == 0 && key.str() == "patches") continue;
      child(above.empty() ? std::string(key.str()) : above + "." + std::string(key.str()), node);
    }
  }

 private:
  void child(const std::string& path, const toml::node& node) {
    if (path == "boundary" && node.is_table()) return boundary(*node.as_table());
    if (known_.keys.count(path)) return add(path, to_json(node), node);
    if (!known_.sections.count(path)) return unknown(path, node);
    scope_.sections.insert(path);
    if (const auto* inner = node.as_table()) return table(*inner, path);
    problems_.push_back(fmt::format("{}: {}{} must be a table of keys, not {}; write {} = {{ ... }}", origin_of_(node),
                                    scope_.prefix, path, describe_value(to_json(node)), path));
  }

  void boundary(const toml::table& table_of_sides) {
    for (const auto& [key, node] : table_of_sides) {
      const auto sides = sides_named(key.str());
      if (sides.empty()) unknown("boundary." + std::string(key.str()), node);
      for (const auto& side : sides) {
        const auto path = "boundary." + side;
        if (const auto* inner = node.as_table()) {
          scope_.sections.insert(path);
          table(*inner, path);
        } else {
          add(path + ".type", to_json(node), node);
        }
      }
    }
  }

  void add(const std::string& path, Json value, const toml::node& node) {
    if (const auto* earlier = scope_.find(path)) {
      problems_.push_back(fmt::format("{}: {}{} is already set at {}; give it once", origin_of_(node), scope_.prefix,
                                      path, earlier->origin));
      return;
    }
    scope_.entries.push_back({path, std::move(value), origin_of_(node)});
  }

  void unknown(const std::string& path, const toml::node& node) {
    problems_.push_back(fmt::format("{}: unknown key {}{}; the nearest known key is {}{}", origin_of_(node),
                                    scope_.prefix, path, scope_.prefix, nearest_name(path, known_.names)));
  }

  const KnownPaths& known_;
  const OriginOf& origin_of_;
  Scope& scope_;
  std::vector<std::string>& problems_;
};
}  // namespace

std::vector<std::string> sides_named(std::string_view key) {
  std::vector<std::string> sides;
  for (const auto& side : side_names()) {
    if (key == side || key == side.substr(0, 1)) sides.push_back(side);
  }
  return sides;
}

KnownPaths KnownPaths::of_case() {
  auto known = known_paths(case_keys());
  for (const auto* name : {"boundary.x", "boundary.y", "boundary.z", "body", "signals", "cavity", "boundary.z-.patches",
                           "boundary.z+.patches"})
    known.names.push_back(name);
  known.left_out = {"body", "signals", "cavity"};
  return known;
}

KnownPaths KnownPaths::of_body() {
  auto known = known_paths(body_keys());
  for (const auto& [word, kind] : words_of<PartKind>()) {
    known.left_out.insert(word);
    known.names.push_back(word);
  }
  return known;
}

KnownPaths KnownPaths::of_part(PartKind kind) {
  switch (kind) {
    case PartKind::selection:
      return known_paths(selection_keys());
    case PartKind::tether:
      return known_paths(tether_keys());
    case PartKind::cord:
      return known_paths(cord_keys());
    case PartKind::pull:
      return known_paths(pull_keys());
  }
  return {};
}
KnownPaths KnownPaths::of_signal() { return known_paths(signal_keys()); }
KnownPaths KnownPaths::of_cavity() { return known_paths(cavity_keys()); }
KnownPaths KnownPaths::of_patch() { return known_paths(patch_keys()); }

void flatten(const toml::table& table, const KnownPaths& known, const OriginOf& origin_of, Scope& scope,
             std::vector<std::string>& problems) {
  Flattener(known, origin_of, scope, problems).table(table, "");
}

Json to_json(const toml::node& node) {
  if (const auto* value = node.as_string()) return value->get();
  if (const auto* value = node.as_integer()) return value->get();
  if (const auto* value = node.as_floating_point()) return value->get();
  if (const auto* value = node.as_boolean()) return value->get();
  if (const auto* array = node.as_array()) {
    auto list = Json::array();
    for (const auto& element : *array) list.push_back(to_json(element));
    return list;
  }
  if (const auto* table = node.as_table()) {
    auto object = Json::object();
    for (const auto& [key, element] : *table) object[std::string(key.str())] = to_json(element);
    return object;
  }
  std::ostringstream date;
  node.visit([&](const auto& value) {
    if constexpr (!toml::is_table<decltype(value)> && !toml::is_array<decltype(value)>) date << value.get();
  });
  return date.str();
}

}  // namespace pliant
