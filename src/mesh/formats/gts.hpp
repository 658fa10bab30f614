#pragma once
#include <iosfwd>
#include <string>

#include "mesh/surface.hpp"
#include "mesh/surface_data.hpp"

namespace pliant {

/// Reads a GTS surface: a line "vertices edges faces", then the vertices (x y z), the edges (two vertices) and the
/// faces (three edges), counted from 1; lines that begin with # or ! are comments, anywhere in the file. Comments of
/// the form "# selection NAME v v v ..." name vertices, counted from 1 as well; a name may come in several lines.
/// `source` names the input in messages. Throws InputError with every line that is wrong (about twenty at most).
SurfaceData read_gts(std::istream& input, const std::string& source);

/// Writes a GTS surface that reads back to the same bits, selections included: 17 digits.
void write_gts(std::ostream& output, const Surface& surface);

}  // namespace pliant
