#pragma once
#include <optional>
#include <string>
#include <vector>

#include "mesh/surface.hpp"
#include "mesh/surface_data.hpp"

namespace pliant {

struct RemeshOptions {
  double edge = 0.1;                      ///< how long edges shall be
  std::optional<double> fill_holes = {};  ///< holes with borders up to this length are filled; none: no hole is
  double sharp_angle = 40;                ///< degrees between faces from which an edge is kept as it is
  int iterations = 10;
};

struct RemeshResult {
  Surface surface;
  std::vector<std::string> mended;  ///< a sentence for each kind of thing that was wrong
};

/// Makes a sound surface of nearly equilateral faces of what may be a raw scan: merges vertices at one place, drops
/// faces without area, double ones and stray pieces of less than a hundredth of the largest one's area, orients the
/// faces alike (outward if closed), stitches borders, fills holes if asked, takes self-crossings away where that is
/// possible, and remeshes evenly; borders and sharp edges stay where they are. By CGAL (Polygon mesh processing, D.
/// Loriot et al.). Throws InputError for what cannot be mended, and in builds without CGAL.
RemeshResult remesh(SurfaceData data, const RemeshOptions& options);

}  // namespace pliant
