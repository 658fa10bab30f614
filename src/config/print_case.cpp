#include "config/print_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "config/key_table.hpp"

namespace pliant {
namespace {
void insert(Json& tree, std::string_view path, Json value) {
  const auto dot = path.find('.');
  auto& child = tree[std::string(path.substr(0, dot))];
  if (dot == std::string_view::npos) child = std::move(value);
  else insert(child, path.substr(dot + 1), std::move(value));
}

template <class Config>
Json resolve(const std::vector<Key<Config>>& keys, const Config& config) {
  auto tree = Json::object();
  for (const auto& key : keys) {
    auto value = key.get(config);
    if (!value.is_null()) insert(tree, key.path, std::move(value));
  }
  return tree;
}

template <class Config>
void add_parts(Json& tree, PartKind kind, const std::vector<Key<Config>>& keys, const std::vector<Config>& parts) {
  for (const auto& part : parts) tree[word_for(kind)][part.name] = resolve(keys, part);
}

Json resolve_body(const BodyConfig& body) {
  auto tree = resolve(body_keys(), body);
  add_parts(tree, PartKind::selection, selection_keys(), body.selections);
  add_parts(tree, PartKind::tether, tether_keys(), body.tethers);
  add_parts(tree, PartKind::cord, cord_keys(), body.cords);
  add_parts(tree, PartKind::pull, pull_keys(), body.pulls);
  return tree;
}

std::string quoted_key(const std::string& key) {
  const bool bare = std::all_of(key.begin(), key.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  return bare ? key : "\"" + key + "\"";
}

/// A value on one line; tables inline.
std::string inline_toml(const Json& value) {
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& [key, element] : value.items()) {
    if (!text.empty()) text += ", ";
    text += value.is_object() ? quoted_key(key) + " = " + inline_toml(element) : inline_toml(element);
  }
  return value.is_object() ? "{ " + text + " }" : "[" + text + "]";
}

std::string lines(const Json& table) {
  std::string text;
  for (const auto& [key, value] : table.items()) text += fmt::format("{} = {}\n", quoted_key(key), inline_toml(value));
  return text;
}
}  // namespace

Json resolved_case(const CaseConfig& config) {
  auto tree = resolve(case_keys(), config);
  for (const auto& [name, signal] : config.signals) tree["signals"][name] = resolve(signal_keys(), signal);
  for (const auto& cavity : config.cavities) tree["cavity"][cavity.name] = resolve(cavity_keys(), cavity);
  for (std::size_t side = 0; side < 6; ++side)
    if (const auto* patches = patches_of(config.boundary[side]))
      for (const auto& patch : *patches)
        tree["boundary"][side_names()[side]]["patches"].push_back(resolve(patch_keys(), patch));
  for (const auto& body : config.bodies) tree["body"].push_back(resolve_body(body));
  return tree;
}

std::string to_toml(const CaseConfig& config) {
  auto tree = resolved_case(config);
  std::string text;
  for (const auto& [key, value] : tree.items()) {
    if (!value.is_structured()) text += fmt::format("{} = {}\n", key, value.dump());
    else if (value.is_object()) text += fmt::format("\n[{}]\n{}", key, lines(value));
  }
  if (!tree.contains("body")) return text;
  for (auto& body : tree["body"]) {
    const auto potentials = body.value("potentials", Json());
    body.erase("potentials");
    text += "\n[[body]]\n" + lines(body);
    if (!potentials.is_null()) text += "\n[body.potentials]\n" + lines(potentials);
  }
  return text;
}

}  // namespace pliant
