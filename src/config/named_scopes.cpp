#include "config/named_scopes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace pliant {
namespace {
void read_list(const toml::node& node, const std::string& side, const OriginOf& origin_of, PatchLists& lists,
               std::vector<std::string>& problems) {
  const auto names = side_names();
  const int number = static_cast<int>(std::find(names.begin(), names.end(), side) - names.begin());
  lists.sides.insert(number);
  const auto* array = node.as_array();
  const auto key = fmt::format("boundary.{}.patches", side);
  if (array == nullptr) {
    problems.push_back(
        fmt::format("{}: {} must be a list of tables; write patches = [{{ ... }}, ...]", origin_of(node), key));
    return;
  }
  const auto known = KnownPaths::of_patch();
  for (std::size_t n = 0; n < array->size(); ++n) {
    const auto& element = *array->get(n);
    const auto* table = element.as_table();
    if (table == nullptr) {
      problems.push_back(
          fmt::format("{}: {}[{}] must be a table; write {{ name = \"...\", ... }}", origin_of(element), key, n));
      continue;
    }
    PatchScope patch;
    const auto name = (*table)["name"].value<std::string>();
    patch.side = number;
    patch.scope.prefix = name ? fmt::format("{}.{}.", key, *name) : fmt::format("{}[{}].", key, n);
    patch.scope.origin = origin_of(element);
    flatten(*table, known, origin_of, patch.scope, problems);
    lists.patches.push_back(std::move(patch));
  }
}
}  // namespace

std::vector<SignalScope> read_signals(const toml::table& root, const OriginOf& origin_of,
                                      std::vector<std::string>& problems) {
  std::vector<SignalScope> signals;
  const auto* node = root.get("signals");
  if (node == nullptr) return signals;
  if (!node->is_table()) {
    problems.push_back(fmt::format("{}: signals must be a table of signals; write [signals.NAME]", origin_of(*node)));
    return signals;
  }
  const auto known = KnownPaths::of_signal();
  for (const auto& [key, element] : *node->as_table()) {
    const std::string name(key.str());
    if (!element.is_table()) {
      problems.push_back(fmt::format("{}: signals.{} must be a table; write {} = {{ formula = \"...\" }}",
                                     origin_of(element), name, name));
      continue;
    }
    SignalScope signal;
    signal.name = name;
    signal.scope.prefix = fmt::format("signals.{}.", name);
    signal.scope.origin = origin_of(element);
    flatten(*element.as_table(), known, origin_of, signal.scope, problems);
    signals.push_back(std::move(signal));
  }
  return signals;
}

PatchLists read_patches(const toml::table& root, const OriginOf& origin_of, std::vector<std::string>& problems) {
  PatchLists lists;
  const auto* boundary = root.get("boundary");
  if (boundary == nullptr || !boundary->is_table()) return lists;
  for (const auto& [key, side] : *boundary->as_table()) {
    const auto* table = side.as_table();
    const auto* list = table == nullptr ? nullptr : table->get("patches");
    if (list == nullptr) continue;
    for (const auto& name : sides_named(key.str())) read_list(*list, name, origin_of, lists, problems);
  }
  return lists;
}

}  // namespace pliant
