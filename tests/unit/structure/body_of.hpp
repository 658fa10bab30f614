#pragma once
#include "structure/load_surface.hpp"
#include "structure/make_body.hpp"
#include "structure/placement.hpp"

namespace pliant {

/// A body at its place, on a grid of the given mean spacing.
inline DeformableBody body_of(const BodyConfig& config, double mean_spacing = 0) {
  Surface surface = load_shape(config, ".");
  surface.positions = place(surface.positions, given_placement(config));
  return make_body(config, std::move(surface), mean_spacing, 1.0);
}

}  // namespace pliant
