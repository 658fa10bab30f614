#pragma once
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// A surface at one instant with what several potentials share: computed once an evaluation, memory kept between them.
/// The mesh must outlive it.
class ShapeState {
 public:
  explicit ShapeState(const TriangleMesh& mesh)
      : mesh_(&mesh), face_vectors_(mesh.n_faces()), inverse_lengths_(mesh.n_faces()) {}
  ShapeState(const TriangleMesh& mesh, std::span<const Vec3> positions) : ShapeState(mesh) { update(positions); }

  /// Takes new positions (n_vertices of them; kept by reference until the next update).
  void update(std::span<const Vec3> positions);

  const TriangleMesh& mesh() const { return *mesh_; }
  std::span<const Vec3> positions() const { return positions_; }
  /// Along the outward normal, length twice the area.
  std::span<const Vec3> face_vectors() const { return face_vectors_; }
  /// 1 / |face vector|.
  std::span<const double> inverse_lengths() const { return inverse_lengths_; }
  double area() const { return area_; }
  /// Enclosed volume; only means something for a closed surface.
  double volume() const { return volume_; }

 private:
  const TriangleMesh* mesh_;
  std::span<const Vec3> positions_;
  std::vector<Vec3> face_vectors_;
  std::vector<double> inverse_lengths_;
  double area_ = 0, volume_ = 0;
};

}  // namespace pliant
