#pragma once
#include <set>
#include <string>
#include <vector>

#include "config/case_config.hpp"

namespace pliant {

/// Everything that is wrong with the patches of the sides: shapes, overlaps, faces of the grid, and who balances the
/// flow. What only the signals can tell is not looked at. `suspect` as in validate.
void check_patches(const CaseConfig& config, const std::set<std::string>& suspect, std::vector<std::string>& problems);

/// True for an outflow side, and for one with a balance patch.
bool lets_out(const BoundarySpec& side);

/// "boundary.z+.patches.mitral"
std::string patch_key(int side, const PatchConfig& patch);

}  // namespace pliant
