#pragma once
#include <span>
#include <vector>

#include "coupling/bodies.hpp"
#include "transfer/force_fields.hpp"
#include "transfer/interpolate.hpp"
#include "transfer/point_router.hpp"

namespace pliant {

/// Velocities of the flow at the vertices of deformable bodies, and forces on these brought to the flow: two maps that
/// are each other's transpose, so that the work of the forces is the flow's gain of energy.
///
/// Both pass through points: the vertices themselves where the faces are small enough for the grid, else the centroids
/// of parts of faces (MarkerLayout). A point m has the area A_m, and the weight w_mv of vertex v:
///   V_v = sum_m w_mv A_m U_m / a_v,   F_m = A_m sum_v w_mv F_v / a_v,   a_v = sum_m w_mv A_m.
class VertexTransfer {
 public:
  /// Requires room for markers.
  VertexTransfer(const Grid& grid, double density);

  /// One body's part of the lists of vertices.
  struct Part {
    Body* body = nullptr;
    const BodyKind* kind = nullptr;
    std::size_t begin = 0, end = 0;  ///< vertices
    std::size_t first_point = 0;

    std::size_t size() const { return end - begin; }
    template <class T>
    std::span<T> of(std::vector<T>& all) const {
      return std::span(all).subspan(begin, size());
    }
  };

  /// From now on the bodies of this rank with that coupling, where their vertices are now. Collective. Throws
  /// CollectiveError that names a body outside the box. The force fields must be empty.
  void place(Bodies& bodies, CouplingKind coupling);

  std::span<const Part> parts() const { return parts_; }
  std::size_t n_vertices() const { return areas_.size(); }
  /// a_v of all vertices.
  std::span<const double> areas() const { return areas_; }

  /// The flow's velocity at the vertices; n_vertices() of them. Ghosts must be filled. Collective.
  void find_velocities(ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w, std::vector<Vec3>& of_vertices);
  /// Puts forces on the vertices into the force fields, whose sum they are to round-off; the caller then moves them to
  /// the flow. Collective in what follows.
  void spread_forces(std::span<const Vec3> of_vertices);
  /// Puts in what changes the velocity of the layer of fluid, a mean grid spacing thick, that the points speak for.
  void spread_increments(std::span<const Vec3> of_vertices);

  ForceFields& fields() { return fields_; }

 private:
  enum class Amount { traction, increment };
  void spread(Amount amount);
  void to_points(std::span<const Vec3> of_vertices);

  Grid grid_;
  double density_;
  PointRouter router_;
  Markers markers_;
  ForceFields fields_;
  std::vector<Part> parts_;
  std::vector<double> areas_;
  // Of all points of this rank's bodies, and of those that it holds for others.
  MarkerSet of_body_;
  std::vector<Vec3> positions_, at_points_, held_vectors_;
  std::vector<double> point_areas_, held_areas_;
  MarkerVectors vectors_;
};

}  // namespace pliant
