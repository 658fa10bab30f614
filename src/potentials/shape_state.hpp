#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"
#include "potentials/inner_stress.hpp"

namespace pliant {

/// A surface at one instant with what several potentials share: computed once an evaluation, memory kept between them.
/// The mesh must outlive it.
class ShapeState {
 public:
  explicit ShapeState(const TriangleMesh& mesh);
  ShapeState(const TriangleMesh& mesh, std::span<const Vec3> positions) : ShapeState(mesh) { update(positions); }

  /// Takes new positions (n_vertices of them; kept by reference until the next update).
  void update(std::span<const Vec3> positions);

  const TriangleMesh& mesh() const { return *mesh_; }
  std::span<const Vec3> positions() const { return positions_; }
  /// Along the outward normal, length twice the area.
  Vec3 face_vector(std::size_t face) const {
    const double* r = face_records_.data() + 4 * face;
    return {r[0], r[1], r[2]};
  }
  /// 1 / |face vector|.
  double inverse_length(std::size_t face) const { return face_records_[4 * face + 3]; }
  double area() const { return area_; }
  /// Enclosed volume; only means something for a closed surface.
  double volume() const { return volume_; }

  /// Where potentials add up what they do to this surface.
  InnerStress& scratch() const { return scratch_; }

  // For loops over batches of eight (lane_records.hpp); arrays reach to the end of the last one.
  const double* position_records() const { return position_records_.data(); }
  /// Face vector and inverse length.
  const double* face_records() const { return face_records_.data(); }
  const double* face_areas() const { return face_areas_.data(); }
  /// From an edge's first vertex to its second.
  const double* edge_vectors(int component) const { return edge_vectors_[static_cast<std::size_t>(component)].data(); }
  const double* inverse_edge_lengths() const { return inverse_edge_lengths_.data(); }

 private:
  void update_faces();
  void update_edges();

  const TriangleMesh* mesh_;
  std::span<const Vec3> positions_;
  std::vector<double> position_records_, face_records_;
  std::array<std::vector<double>, 3> edge_vectors_;
  std::vector<double> face_areas_, inverse_edge_lengths_;
  mutable InnerStress scratch_;
  double area_ = 0, volume_ = 0;
};

/// The forces of a single potential.
template <class Potential>
void add_forces_alone(const Potential& potential, const ShapeState& shape, std::span<Vec3> forces) {
  InnerStress& stress = shape.scratch();
  stress.reset(shape.mesh());
  potential.add_stress(shape, stress);
  stress.add_forces(shape, forces);
}

}  // namespace pliant
