#pragma once
#include <array>
#include <span>
#include <vector>

namespace pliant {

/// The vertices of a face, counter-clockwise seen from outside.
using Face = std::array<int, 3>;

/// Connectivity of an oriented two-manifold of triangles, closed or with borders; it never changes. Positions live
/// elsewhere.
///
/// An edge is numbered by its first appearance along the faces, so edges are as local in memory as faces are.
/// Edge e runs from vertices_of_edge()[e][0] to [1] in the direction of its first face; its second face runs the other
/// way.
class TriangleMesh {
 public:
  TriangleMesh() = default;

  /// Builds all arrays in O(n log n). Throws InputError if the faces are no oriented manifold (index out of range, an
  /// edge of three faces, a flipped face); find_mesh_problems() says where, with lines.
  TriangleMesh(int n_vertices, std::vector<Face> faces);

  int n_vertices() const { return n_vertices_; }
  int n_edges() const { return static_cast<int>(vertices_of_edge_.size()); }
  int n_faces() const { return static_cast<int>(vertices_of_face_.size()); }
  int n_border_edges() const { return n_border_edges_; }
  /// Every edge has two faces.
  bool is_closed() const { return n_border_edges_ == 0 && n_faces() > 0; }

  std::span<const Face> vertices_of_face() const { return vertices_of_face_; }
  /// edges_of_face()[f][k] joins the vertices k and k + 1 of face f.
  std::span<const std::array<int, 3>> edges_of_face() const { return edges_of_face_; }
  std::span<const std::array<int, 2>> vertices_of_edge() const { return vertices_of_edge_; }
  /// The second face is -1 at a border.
  std::span<const std::array<int, 2>> faces_of_edge() const { return faces_of_edge_; }
  /// The paper's v1234: start and end of the edge, the vertex opposite in its first face and in its second (-1:
  /// border).
  std::span<const std::array<int, 4>> hinge_of_edge() const { return hinge_of_edge_; }

  /// Faces around a vertex, counter-clockwise; at a border from the first face of the fan to the last.
  std::span<const int> faces_of_vertex(int v) const { return slice(faces_of_vertex_, face_start_, v); }
  /// Neighbours of a vertex, counter-clockwise; at a border one more than faces.
  std::span<const int> neighbours_of_vertex(int v) const { return slice(neighbours_, neighbour_start_, v); }

 private:
  static std::span<const int> slice(const std::vector<int>& items, const std::vector<int>& start, int v) {
    return {items.data() + start[v], items.data() + start[v + 1]};
  }
  void build_edges();
  void build_rings();

  int n_vertices_ = 0;
  int n_border_edges_ = 0;
  std::vector<Face> vertices_of_face_;
  std::vector<std::array<int, 3>> edges_of_face_;
  std::vector<std::array<int, 2>> vertices_of_edge_, faces_of_edge_;
  std::vector<std::array<int, 4>> hinge_of_edge_;
  std::vector<int> face_start_, faces_of_vertex_, neighbour_start_, neighbours_;
};

}  // namespace pliant
