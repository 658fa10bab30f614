#pragma once
#include <array>
#include <functional>
#include <vector>

#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// A point of the plane of parameters (s, t) over which a patch lies.
using ChartPoint = std::array<double, 2>;

/// A vertex of a border of a patch, given beforehand: it stays where it is.
struct BorderVertex {
  ChartPoint chart;
  Vec3 place;
};

/// A piece of a smooth surface over a part of the plane of parameters.
struct Patch {
  /// The surface: one to one, and regular (its two derivatives are nowhere parallel).
  std::function<Vec3(ChartPoint)> surface;
  /// How long edges shall be about a point; it changes by less than the distance between two points.
  std::function<double(Vec3)> edge;
  /// Counter-clockwise; in the chart every vertex can be seen from `middle`.
  std::vector<BorderVertex> outline;
  /// Convex polygons in the chart, counter-clockwise, farther apart than their edges are long.
  std::vector<std::vector<BorderVertex>> holes;
  ChartPoint middle{0, 0};
  bool keeps_middle = false;  ///< the middle is a vertex of the mesh
};

/// Triangles over a patch: first the vertices of the outline, then those of the holes as they come, then the middle if
/// it is kept. Faces follow the chart's orientation.
struct PatchMesh {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
};

/// Covers a patch with nearly equilateral triangles whose sides are about as long as asked: vertices are put into long
/// edges and taken from short ones, edges flipped to the larger smallest angle, vertices moved to the middle of what is
/// around them; last the smallest angles are made as large as moves of single vertices can. The vertices lie on the
/// surface. The same input gives the same bits. Throws InputError if holes are too close to each other or to the
/// outline.
PatchMesh mesh_patch(const Patch& patch);

}  // namespace pliant
