#pragma once
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "mesh/surface.hpp"
#include "structure/placement.hpp"

namespace pliant {

/// A body of the case file: the shape that its copies share, about its own origin, and where each copy is.
struct PlacedBody {
  Surface shape;
  BoundingSphere sphere;  ///< of the shape
  std::vector<Placement> placements;
};

/// Reads the shapes and places every copy of every body; element b belongs to config.bodies[b]. Bodies with a center or
/// with positions come first; those with a count then take random places, in the order of the file, where the ball
/// around a copy stays `gap` off all other such balls, off the surfaces of single bodies, and off bounded sides. Shapes
/// that are far from round waste room: their balls count, not their surfaces.
///
/// The places follow from the case alone: they are the same on every rank. Throws InputError with every problem, among
/// them bodies that find no place and names that clash with those of copies.
std::vector<PlacedBody> place_bodies(const CaseConfig& config);

}  // namespace pliant
