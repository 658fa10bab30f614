#pragma once
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// A surface whose every border is closed by a lid: a fan from the mean of the border's vertices, flat if the border
/// is. A closed surface has no lids.
class LiddedSurface {
 public:
  explicit LiddedSurface(const TriangleMesh& mesh);

  int n_lids() const { return static_cast<int>(borders_.size()); }
  /// Of the surface, then of the lids. The hub of lid b is vertex n_vertices + b.
  std::span<const Face> faces() const { return faces_; }
  /// Positions or velocities of the surface's vertices with those of the hubs behind them.
  std::vector<Vec3> with_hubs(std::span<const Vec3> of_vertices) const;

 private:
  std::vector<std::vector<int>> borders_;  // vertices of each
  std::vector<Face> faces_;
};

/// The volume inside closed faces, negative if their normals point inwards, and its rate at these velocities.
struct VolumeAndRate {
  double volume = 0, rate = 0;
};
VolumeAndRate enclosed_volume_and_rate(std::span<const Face> faces, std::span<const Vec3> positions,
                                       std::span<const Vec3> velocities);

}  // namespace pliant
