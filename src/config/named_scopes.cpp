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

/// A table of named tables.
struct NamedTables {
  std::string word, form, prefix, example;
  KnownPaths known;
};

template <class Take>
void read_tables(const toml::table& above, const NamedTables& tables, const OriginOf& origin_of,
                 std::vector<std::string>& problems, Take take) {
  const auto* node = above.get(tables.word);
  if (node == nullptr) return;
  if (!node->is_table()) {
    const auto all = tables.prefix.substr(0, tables.prefix.size() - 1);
    problems.push_back(fmt::format("{}: {} must be a table of {}; write {}", origin_of(*node), all,
                                   tables.word == "signals" ? "signals" : "named tables", tables.form));
    return;
  }
  for (const auto& [key, element] : *node->as_table()) {
    const std::string name(key.str());
    if (!element.is_table()) {
      problems.push_back(fmt::format("{}: {}{} must be a table; write {} = {{ {} }}", origin_of(element), tables.prefix,
                                     name, name, tables.example));
      continue;
    }
    Scope scope;
    scope.prefix = fmt::format("{}{}.", tables.prefix, name);
    scope.origin = origin_of(element);
    flatten(*element.as_table(), tables.known, origin_of, scope, problems);
    take(name, std::move(scope));
  }
}
}  // namespace

std::vector<NamedScope> read_signals(const toml::table& root, const OriginOf& origin_of,
                                     std::vector<std::string>& problems) {
  std::vector<NamedScope> signals;
  const NamedTables tables{"signals", "[signals.NAME]", "signals.", "formula = \"...\"", KnownPaths::of_signal()};
  read_tables(root, tables, origin_of, problems, [&](const std::string& name, Scope scope) {
    signals.push_back({name, std::move(scope)});
  });
  return signals;
}

std::vector<NamedScope> read_cavities(const toml::table& root, const OriginOf& origin_of,
                                      std::vector<std::string>& problems) {
  std::vector<NamedScope> cavities;
  const NamedTables tables{"cavity", "[cavity.NAME]", "cavity.", "body = \"...\"", KnownPaths::of_cavity()};
  read_tables(root, tables, origin_of, problems, [&](const std::string& name, Scope scope) {
    cavities.push_back({name, std::move(scope)});
  });
  return cavities;
}

std::vector<PartScope> read_parts(const toml::table& body, const std::string& prefix, const OriginOf& origin_of,
                                  std::vector<std::string>& problems) {
  std::vector<PartScope> parts;
  for (const auto& [word, kind] : words_of<PartKind>()) {
    const NamedTables tables{word, "[body." + word + ".NAME]", prefix + word + ".", "...", KnownPaths::of_part(kind)};
    read_tables(body, tables, origin_of, problems, [&, part = kind](const std::string& name, Scope scope) {
      parts.push_back({prefix, part, name, std::move(scope)});
    });
  }
  return parts;
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
