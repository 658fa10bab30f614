#pragma once
#include <filesystem>

#include "config/case_config.hpp"
#include "mesh/surface.hpp"

namespace pliant {

/// The surface of a body about its own origin, scaled but not turned yet, checked: sound, closed and outward, or open
/// where is_open_surface says so. A closed surface must be in one piece: its pieces would be bodies of their own. An
/// open one may have several (the leaflets of a valve). Paths start at `folder`. Throws InputError with every problem.
Surface load_shape(const BodyConfig& config, const std::filesystem::path& folder);

}  // namespace pliant
