#pragma once
#include <vector>

#include "config/case_config.hpp"
#include "config/key.hpp"

namespace pliant {

/// Every key of a case file outside [[body]], in the order of the docs. The order matters to the reader as well: a key
/// that chooses an alternative (boundary type, surface shape) stands before the keys of that alternative.
std::vector<Key<CaseConfig>> case_keys();

/// Every key of one [[body]].
std::vector<Key<BodyConfig>> body_keys();

/// Every key of one [signals.NAME].
std::vector<Key<SignalConfig>> signal_keys();

/// Every key of one [cavity.NAME].
std::vector<Key<CavityConfig>> cavity_keys();

/// Every key of one of a side's patches.
std::vector<Key<PatchConfig>> patch_keys();
/// Every key of one of a body's [body.selection.NAME], [body.tether.NAME], [body.cord.NAME], [body.pull.NAME].
std::vector<Key<SelectionConfig>> selection_keys();
std::vector<Key<TetherConfig>> tether_keys();
std::vector<Key<CordConfig>> cord_keys();
std::vector<Key<PullConfig>> pull_keys();

/// The keys of a body's surface, and those of its place and copies; they append to `keys`.
void add_surface_keys(std::vector<Key<BodyConfig>>& keys);
void add_placement_keys(std::vector<Key<BodyConfig>>& keys);

/// The names of the sides, in the order of BoundaryConfig: "x-", "x+", ... "z+".
std::array<std::string, 6> side_names();

/// The word for a boundary condition: "periodic", "wall", "free-slip".
std::string boundary_word(const BoundarySpec& spec);

}  // namespace pliant
