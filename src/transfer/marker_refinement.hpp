#pragma once
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// Longest edge of a forcing marker's triangle, in grid spacings, that still holds the flow: with longer ones fluid
/// passes between the markers (measured: bench/markers.md).
inline constexpr double longest_marker_edge = 1.35;

/// Into how many parts n each edge of a face must be split, so that the edges of its n^2 congruent parts are at most
/// longest_marker_edge spacings long. At least 1. Throws InputError if a length or the spacing is not positive, or if
/// n would exceed 1000.
int refinement_for(double longest_edge, double spacing);
/// The same for every face of a mesh at given positions (n_vertices of them).
std::vector<int> refinement_for(const TriangleMesh& mesh, std::span<const Vec3> positions, double spacing);

/// How many grid spacings the markers of a closed body should stand inside its surface. Forcing is spread over about a
/// cell, so that a body acts on the flow as if it were larger by about a fifth of a cell (W.-P. Breugem, J. Comput.
/// Phys. 231, 2012); this takes it back. Measured on a spinning and an oscillating sphere: bench/markers.md.
inline constexpr double marker_retraction = 0.2;

/// What a layout places: one entry a marker.
struct MarkerSet {
  std::vector<Vec3> positions, velocities, normals;  ///< normals: of unit length, of the marker's face
  std::vector<double> areas;                         ///< those of a face's markers are equal
};

/// Markers of a surface: each face is split, virtually, into n^2 congruent triangles, and their centroids are its
/// markers, so that structural mesh and forcing are independent (numerics: section "Transfer"). n = 1 is the centroid.
///
/// Markers are numbered by face; position and velocity are interpolated linearly from the face's vertices, and forces
/// return with the same weights: total force, and torque about any point, are the same before and after to round-off.
class MarkerLayout {
 public:
  MarkerLayout() = default;
  /// The same n for every face. Throws InputError if it is below 1.
  explicit MarkerLayout(const TriangleMesh& mesh, int parts = 1);
  /// n of each face (n_faces of them). Throws InputError if one is below 1, or if there are too many markers to count.
  MarkerLayout(const TriangleMesh& mesh, std::span<const int> parts);

  int n_markers() const { return first_marker_.empty() ? 0 : first_marker_.back(); }
  int n_faces() const { return static_cast<int>(faces_.size()); }
  /// Markers of a face: first_marker(f) .. first_marker(f + 1) - 1.
  int first_marker(int face) const { return first_marker_[static_cast<std::size_t>(face)]; }
  int face_of(int marker) const { return face_of_marker_[static_cast<std::size_t>(marker)]; }
  /// Weights of the three vertices of the marker's face, summing to 1.
  Vec3 weights(int marker) const;

  /// Where the markers are for vertices at these positions with these velocities; sizes the set.
  void place(std::span<const Vec3> positions, std::span<const Vec3> velocities, MarkerSet& markers) const;

  /// The same, then moves the markers of a closed body inwards by a length, each along the normal of its face and with
  /// the velocity of the body there (that of a rigid body exactly). Areas stay: a marker forces as much fluid as
  /// before.
  void place_inside(std::span<const Vec3> positions, std::span<const Vec3> velocities, double retraction,
                    MarkerSet& markers) const;

  /// Moves the markers of an open surface away from its borders, within their faces' planes, from then on: by a length
  /// at a border, by less farther away, by nothing from ten times that length on. Areas stay.
  void draw_in(const TriangleMesh& mesh, std::span<const Vec3> positions, double length);

  /// Values of vertices (accelerations, say) at the markers; n_markers of them.
  void interpolate(std::span<const Vec3> of_vertices, std::span<Vec3> at_markers) const;

  /// Adds forces on markers to those on the vertices of their faces.
  void add_to_vertices(std::span<const Vec3> marker_forces, std::span<Vec3> vertex_forces) const;
  /// Adds forces on markers to those on their faces (n_faces).
  void add_to_faces(std::span<const Vec3> marker_forces, std::span<Vec3> face_forces) const;

 private:
  struct Pattern {
    int parts = 0;
    std::vector<Vec3> weights;
  };
  void build(const TriangleMesh& mesh, std::span<const int> parts);
  const Pattern& pattern_of(std::size_t face) const {
    return patterns_[static_cast<std::size_t>(pattern_of_face_[face])];
  }

  struct Moved {
    std::size_t marker = 0;
    Vec3 weights;
  };

  std::vector<Face> faces_;
  std::vector<Moved> moved_;       // those that do not stand where their pattern says; ascending
  std::vector<Pattern> patterns_;  // one for each n in use
  std::vector<int> pattern_of_face_, first_marker_, face_of_marker_;
};

}  // namespace pliant
