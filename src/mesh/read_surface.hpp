#pragma once
#include <filesystem>

#include "mesh/check_mesh.hpp"

namespace pliant {

/// Reads a surface as it is, unchecked; the format follows the extension. Throws InputError with every line that is
/// wrong.
SurfaceData read_surface_data(const std::filesystem::path& path);

/// Reads and checks a surface; the format follows the extension: .gts, .stl, .obj or .ply.
/// Throws InputError with every problem, with file and line.
Surface read_surface(const std::filesystem::path& path, Closure closure = Closure::any);

/// Writes a surface in full precision, through a temporary file and a rename; extension .gts, .stl, .obj or .ply.
/// Throws InputError for an unknown extension, RunError if the file cannot be written.
void write_surface(const std::filesystem::path& path, const Surface& surface);

}  // namespace pliant
