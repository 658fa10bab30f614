#pragma once
#include "config/key_table.hpp"

namespace pliant {

/// Keys of how a body moves and is coupled to the flow.
void add_motion_keys(std::vector<Key<BodyConfig>>& keys);

/// Keys of what a deformable body is made of, and of its potentials.
void add_structure_keys(std::vector<Key<BodyConfig>>& keys);

/// Keys of the case that all bodies share: forcing, strong coupling, repulsion.
void add_interaction_keys(std::vector<Key<CaseConfig>>& keys);

}  // namespace pliant
