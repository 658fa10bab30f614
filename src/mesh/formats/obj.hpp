#pragma once
#include <iosfwd>
#include <string>

#include "mesh/surface.hpp"
#include "mesh/surface_data.hpp"

namespace pliant {

/// Reads the vertices and faces of a Wavefront OBJ file; a face of n > 3 vertices becomes a fan, all else is passed
/// over. Throws InputError with every line that is wrong.
SurfaceData read_obj(std::istream& input, const std::string& source);

/// Writes vertices (17 digits) and faces.
void write_obj(std::ostream& output, const Surface& surface);

}  // namespace pliant
