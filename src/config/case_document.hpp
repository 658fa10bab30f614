#pragma once
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "config/key_table.hpp"

namespace pliant {

/// One value of a case with the place it came from.
struct Entry {
  std::string path;  ///< of the key, within its scope
  Json value;
  std::string origin;  ///< "case.toml:12" or "--set fluid.viscosity=0.5"
};

/// The entries outside [[body]], or those of one body.
struct Scope {
  std::string prefix;  ///< "" or "body.drop."
  std::string origin;  ///< where the scope begins
  std::vector<Entry> entries;
  std::set<std::string> sections;  ///< tables that were written, even empty ones

  const Entry* find(const std::string& path) const;
};

/// One [signals.NAME] or [cavity.NAME].
struct NamedScope {
  std::string name;
  Scope scope;
};

/// One of the patches of a side (0 .. 5).
struct PatchScope {
  int side = 0;
  Scope scope;
};

/// One of the named tables within a body: [body.selection.NAME] and its like.
struct PartScope {
  std::string body;  ///< prefix of the body: "body.drop."
  PartKind kind = PartKind::selection;
  std::string name;
  Scope scope;
};

/// A case file as a flat list of entries: shorthands written out, unknown keys reported, values not yet looked at.
struct CaseDocument {
  std::filesystem::path file;
  Scope root;
  std::vector<NamedScope> signals;
  std::vector<NamedScope> cavities;
  std::vector<PatchScope> patches;
  std::vector<Scope> bodies;
  std::vector<PartScope> parts;
  std::vector<std::string> problems;
};

/// Reads `file` and lays each "key.path=value" of `overrides` over it. Throws InputError when the file cannot be read
/// or is not TOML; everything else that is wrong is listed in `problems`.
CaseDocument read_document(const std::filesystem::path& file, std::span<const std::string> overrides);

}  // namespace pliant
