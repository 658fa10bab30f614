#pragma once
#include <optional>
#include <span>

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

/// A point of `a` that lies on `b` within `depth`, well inside one of its faces, with the normals along one line: two
/// sheets on top of each other.
std::optional<Vec3> find_common_sheet(const SurfaceView& a, const SurfaceView& b, double depth);

}  // namespace pliant
