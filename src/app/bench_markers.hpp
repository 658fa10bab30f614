#pragma once
#include <vector>

#include "grid/grid.hpp"

namespace pliant {

/// How markers follow each other.
enum class MarkerOrder {
  natural,  ///< sphere after sphere, each face after its neighbour, as bodies have them
  random,   ///< all over the box
};

/// Markers and the ends of their probes, in one order.
struct BenchMarkers {
  std::vector<Vec3> positions, ends;
};

/// n markers: the centroids of the 1280 faces of spheres at random places, the last of them unfinished. For a grid of
/// unit spacing: faces have edges of about one spacing and probes a length of 1.5, as real cases choose them; smaller
/// in a box of few cells. Spheres may overlap; all points are within the bounded sides. The same at every run and on
/// every rank.
BenchMarkers make_bench_markers(const Grid& grid, int n, MarkerOrder order);

}  // namespace pliant
