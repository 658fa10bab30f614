#pragma once
#include <iosfwd>
#include <string>

#include "mesh/surface.hpp"
#include "mesh/surface_data.hpp"

namespace pliant {

/// Reads an STL file, text or binary; corners at exactly the same place become one vertex.
/// Throws InputError with file and line (text) or byte count (binary).
SurfaceData read_stl(std::istream& input, const std::string& source);

/// Writes a text STL file with 17 digits.
void write_stl(std::ostream& output, const Surface& surface);

}  // namespace pliant
