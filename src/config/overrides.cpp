#include "config/overrides.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

#include "config/edit_distance.hpp"
#include "config/flatten.hpp"
#include "config/named_scopes.hpp"

namespace pliant {
namespace {
/// The parts of a dotted key; quotes around a part are dropped.
std::vector<std::string> split_key(std::string_view key) {
  std::vector<std::string> parts(1);
  char quote = 0;
  for (char c : key) {
    if (quote ? c == quote : (c == '"' || c == '\'')) quote = quote ? 0 : c;
    else if (c == '.' && !quote) parts.emplace_back();
    else if (quote || !std::isspace(static_cast<unsigned char>(c))) parts.back() += c;
  }
  return parts;
}

/// {a: {b: value}} for the parts a, b.
toml::table nest(std::span<const std::string> parts, const toml::node& value) {
  toml::table table;
  if (parts.size() == 1) table.insert_or_assign(parts[0], value);
  else table.insert_or_assign(parts[0], nest(parts.subspan(1), value));
  return table;
}

bool is_bare_text(std::string_view text) {
  return !text.empty() && text.find_first_of("\"'[]{}\n") == std::string_view::npos;
}

/// The value as a table with the one key "value".
std::optional<toml::table> parse_value(const std::string& text) {
  try {
    auto table = toml::parse("value = " + text);
    if (table.size() == 1 && table.contains("value")) return table;
  } catch (const toml::parse_error&) {}
  if (is_bare_text(text)) return toml::table{{"value", text}};
  return std::nullopt;
}

template <class Config>
std::vector<std::string> other_ways_of_saying(const std::string& path, const std::vector<Key<Config>>& keys) {
  std::vector<std::string> paths;
  for (const auto& key : keys) {
    const bool excludes_path = std::count(key.excludes.begin(), key.excludes.end(), path) > 0;
    if (key.path == path) paths.insert(paths.end(), key.excludes.begin(), key.excludes.end());
    if (excludes_path) paths.push_back(key.path);
  }
  return paths;
}

/// An empty table would change nothing, which is not what the user wants.
bool says_nothing(const Scope& over, std::size_t problems_before, const CaseDocument& document) {
  return over.entries.empty() && document.problems.size() == problems_before;
}

template <class Config>
void lay_over(Scope& scope, const Scope& over, const std::vector<Key<Config>>& keys) {
  for (const auto& entry : over.entries) {
    const auto others = other_ways_of_saying(entry.path, keys);
    std::erase_if(scope.entries, [&](const Entry& old) {
      return old.path == entry.path || std::count(others.begin(), others.end(), old.path) > 0;
    });
  }
  scope.entries.insert(scope.entries.end(), over.entries.begin(), over.entries.end());
  scope.sections.insert(over.sections.begin(), over.sections.end());
}

template <class Config>
void lay_over(std::vector<NamedScope>& all, const std::vector<NamedScope>& over, const std::vector<Key<Config>>& keys) {
  for (const auto& one : over) {
    const auto same = std::find_if(all.begin(), all.end(), [&](const auto& old) { return old.name == one.name; });
    if (same == all.end()) all.push_back(one);
    else lay_over(same->scope, one.scope, keys);
  }
}

Scope* find_body(CaseDocument& document, const std::string& name) {
  for (auto& body : document.bodies) {
    const auto* entry = body.find("name");
    if (entry && entry->value == name) return &body;
  }
  return nullptr;
}

std::string known_bodies(const CaseDocument& document) {
  std::string names;
  for (const auto& body : document.bodies) {
    if (const auto* entry = body.find("name"); entry && entry->value.is_string())
      names += (names.empty() ? "" : ", ") + entry->value.get<std::string>();
  }
  return names.empty() ? "the case has no body" : "the case has: " + names;
}
/// boundary.SIDE.patches.NAME.key: a key of one patch. True if the parts are of that form.
bool apply_to_patch(std::span<const std::string> parts, const toml::node& node, const OriginOf& origin_of,
                    CaseDocument& document) {
  if (parts.size() < 5 || parts[0] != "boundary" || parts[2] != "patches") return false;
  const auto prefix = fmt::format("boundary.{}.patches.{}.", parts[1], parts[3]);
  std::string known;
  for (auto& patch : document.patches) {
    known += (known.empty() ? "" : ", ") + patch.scope.prefix.substr(0, patch.scope.prefix.size() - 1);
    if (patch.scope.prefix != prefix) continue;
    Scope over;
    over.prefix = prefix;
    flatten(nest(parts.subspan(4), node), KnownPaths::of_patch(), origin_of, over, document.problems);
    lay_over(patch.scope, over, patch_keys());
    return true;
  }
  document.problems.push_back(
      fmt::format("{}: there is no such patch; the case has: {}", origin_of(node), known.empty() ? "none" : known));
  return true;
}

/// What a table says of signals, cavities, and of all the patches of a side. True if it says anything.
bool lay_named_scopes_over(const toml::table& table, const OriginOf& origin_of, CaseDocument& document) {
  const auto signals = read_signals(table, origin_of, document.problems);
  lay_over(document.signals, signals, signal_keys());
  const auto cavities = read_cavities(table, origin_of, document.problems);
  lay_over(document.cavities, cavities, cavity_keys());
  const auto [sides, patches] = read_patches(table, origin_of, document.problems);
  for (int side : sides) std::erase_if(document.patches, [side](const PatchScope& old) { return old.side == side; });
  document.patches.insert(document.patches.end(), patches.begin(), patches.end());
  return !signals.empty() || !cavities.empty() || !sides.empty();
}

template <class Visit>
void with_keys_of(PartKind kind, Visit visit) {
  if (kind == PartKind::selection) visit(selection_keys());
  if (kind == PartKind::tether) visit(tether_keys());
  if (kind == PartKind::cord) visit(cord_keys());
  if (kind == PartKind::pull) visit(pull_keys());
}

/// What a table says of the named parts of a body.
void lay_parts_over(const toml::table& table, const std::string& prefix, const OriginOf& origin_of,
                    CaseDocument& document) {
  const auto parts = read_parts(table, prefix, origin_of, document.problems);
  for (const auto& over : parts) {
    auto& all = document.parts;
    const auto same =
        std::find_if(all.begin(), all.end(), [&](const auto& old) { return old.scope.prefix == over.scope.prefix; });
    if (same == all.end()) all.push_back(over);
    else with_keys_of(over.kind, [&](const auto& keys) { lay_over(same->scope, over.scope, keys); });
  }
}
}  // namespace

void apply_override(const std::string& text, CaseDocument& document) {
  const auto origin = "--set " + text;
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    document.problems.push_back(fmt::format("{}: write it as key.path=value", origin));
    return;
  }
  const auto parts = split_key(std::string_view(text).substr(0, equals));
  const auto value = parse_value(text.substr(equals + 1));
  const bool has_empty_part = std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part.empty(); });
  if (!value || has_empty_part) {
    document.problems.push_back(fmt::format("{}: {}", origin,
                                            value ? "the key has an empty part; write it as key.path=value"
                                                  : "the value is not valid TOML; put strings in quotes"));
    return;
  }
  const OriginOf origin_of = [&](const toml::node&) { return origin; };
  const toml::node& node = *value->get("value");
  Scope over;
  const auto problems_before = document.problems.size();
  if (apply_to_patch(parts, node, origin_of, document)) return;
  if (parts[0] != "body") {
    const auto table = nest(parts, node);
    flatten(table, KnownPaths::of_case(), origin_of, over, document.problems);
    if (!lay_named_scopes_over(table, origin_of, document) && says_nothing(over, problems_before, document))
      document.problems.push_back(fmt::format("{}: sets no key; name the key and its value", origin));
    return lay_over(document.root, over, case_keys());
  }
  auto* body = parts.size() < 3 ? nullptr : find_body(document, parts[1]);
  if (!body) {
    document.problems.push_back(
        fmt::format("{}: write body.NAME.key=value with the name of a body; {}", origin, known_bodies(document)));
    return;
  }
  over.prefix = body->prefix;
  const auto table = nest(std::span(parts).subspan(2), node);
  flatten(table, KnownPaths::of_body(), origin_of, over, document.problems);
  lay_parts_over(table, over.prefix, origin_of, document);
  lay_over(*body, over, body_keys());
}

}  // namespace pliant
