#pragma once
#include <iosfwd>
#include <string>

#include "mesh/formats/ply_header.hpp"
#include "mesh/surface.hpp"
#include "mesh/surface_data.hpp"

namespace pliant {

/// Reads a PLY file (format 1.0, ascii or binary of either byte order): x, y and z of the element "vertex", of any
/// type, and the triangles vertex_indices or vertex_index of the element "face", of any integer type and counted from
/// 0; other properties and elements are passed over. In text each item is a line. `source` names the input in
/// messages. Throws InputError with every line (text) or item and its first byte from 0 (binary) that is wrong, about
/// twenty at most: in the header, truncated or left over data, faces that are no triangles. Indices out of range are
/// left to find_mesh_problems.
SurfaceData read_ply(std::istream& input, const std::string& source);

/// Writes a PLY file that reads back to the same bits: doubles, in text with 17 digits.
void write_ply(std::ostream& output, const Surface& surface, PlyEncoding encoding);

}  // namespace pliant
