#pragma once
#include <set>
#include <vector>

#include "config/flatten.hpp"

namespace pliant {

/// The tables [signals.NAME] of a case.
std::vector<NamedScope> read_signals(const toml::table& root, const OriginOf& origin_of,
                                     std::vector<std::string>& problems);

/// The tables [cavity.NAME] of a case.
std::vector<NamedScope> read_cavities(const toml::table& root, const OriginOf& origin_of,
                                      std::vector<std::string>& problems);

/// The tables [body.selection.NAME], [body.tether.NAME], ... of a body with this prefix.
std::vector<PartScope> read_parts(const toml::table& body, const std::string& prefix, const OriginOf& origin_of,
                                  std::vector<std::string>& problems);

struct PatchLists {
  std::set<int> sides;  ///< those that have a list of patches, be it empty
  std::vector<PatchScope> patches;
};

/// The lists of patches under the sides of [boundary].
PatchLists read_patches(const toml::table& root, const OriginOf& origin_of, std::vector<std::string>& problems);

}  // namespace pliant
