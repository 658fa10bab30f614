#pragma once
#include <string>
#include <vector>

#include "mesh/surface.hpp"
#include "mesh/surface_data.hpp"

namespace pliant {

/// What a surface must be: without borders, with borders, or either.
enum class Closure { closed, open, any };

/// Every reason why the data is no usable surface, each a sentence with file and line (or number of the item) and what
/// to do: no faces, index out of range, value that is not finite, degenerate face, duplicate face, non-manifold edge,
/// flipped face, hole (Closure::closed), no border (Closure::open), duplicate or unused vertex, inward normals.
/// At most `limit` are spelt out; one more line counts the rest. Empty: the data is sound.
std::vector<std::string> find_mesh_problems(const SurfaceData& data, Closure closure, std::size_t limit = 20);

/// Checks the data and builds its surface. Throws InputError with every problem.
Surface make_surface(SurfaceData data, Closure closure);

}  // namespace pliant
