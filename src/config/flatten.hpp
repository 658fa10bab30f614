#pragma once
#include <toml++/toml.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "config/case_document.hpp"

namespace pliant {

/// The paths that a scope knows: keys, and the tables above them.
struct KnownPaths {
  std::set<std::string> keys, sections;
  std::set<std::string> left_out;  ///< tables at the top that are left to the caller
  std::vector<std::string> names;  ///< what may be suggested for an unknown key

  static KnownPaths of_case();
  static KnownPaths of_body();
  static KnownPaths of_signal();
  static KnownPaths of_cavity();
  static KnownPaths of_patch();
  static KnownPaths of_part(PartKind kind);
};

/// Names the place of a node for messages.
using OriginOf = std::function<std::string(const toml::node&)>;

/// Appends the entries of `table` to `scope`, writing out the shorthands of [boundary]. Unknown keys go to `problems`.
/// The array "body" of a case, its tables "signals" and "cavity", the arrays "patches" of its sides, and the tables of
/// a body's parts are left to the caller.
void flatten(const toml::table& table, const KnownPaths& known, const OriginOf& origin_of, Scope& scope,
             std::vector<std::string>& problems);

/// The sides that a key of [boundary] names: "z" both sides of z, "z-" one, anything else none.
std::vector<std::string> sides_named(std::string_view key);

/// A TOML value as JSON; tables become objects.
Json to_json(const toml::node& node);

}  // namespace pliant
