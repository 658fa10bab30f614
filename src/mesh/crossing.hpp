#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// Connectivity and positions of a surface, as a view.
struct SurfaceView {
  const TriangleMesh& mesh;
  std::span<const Vec3> positions;
};

/// A point where an edge of one surface passes through a face of the other, its borders included, and reaches further
/// than `depth` on both sides; none if no edge does.
std::optional<Vec3> find_crossing(const SurfaceView& a, const SurfaceView& b, double depth);

/// A point where an edge of a surface crosses one of its own faces that it shares no vertex with.
std::optional<Vec3> find_self_crossing(const SurfaceView& surface, double depth);

/// Faces of two surfaces that have to do with each other, ascending.
struct FacePairs {
  std::vector<int> of_a, of_b;
};

/// All faces through which edges of the other surface pass, as find_crossing() has it, and the faces of these edges.
FacePairs find_crossing_faces(const SurfaceView& a, const SurfaceView& b, double depth);

/// The same of one surface, as find_self_crossing() has it.
std::vector<int> find_self_crossing_faces(const SurfaceView& surface, double depth);

/// A point of `a` that lies on `b` within `depth`, well inside one of its faces, with the normals along one line: two
/// sheets on top of each other.
std::optional<Vec3> find_common_sheet(const SurfaceView& a, const SurfaceView& b, double depth);

}  // namespace pliant
