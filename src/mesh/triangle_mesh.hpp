#pragma once
#include <array>
#include <memory>
#include <span>
#include <vector>

namespace pliant {

/// The vertices of a face, counter-clockwise seen from outside.
using Face = std::array<int, 3>;

/// Connectivity of an oriented two-manifold of triangles, closed or with borders; it never changes, so copies share it.
/// Positions live elsewhere.
///
/// An edge is numbered by its first appearance along the faces, so edges are as local in memory as faces are.
/// Edge e runs from vertices_of_edge()[e][0] to [1] in the direction of its first face; its second face runs the other
/// way.
class TriangleMesh {
 public:
  TriangleMesh() : arrays_(std::make_shared<const Arrays>()) {}

  /// Builds all arrays in O(n log n). Throws InputError if the faces are no oriented manifold (index out of range, an
  /// edge of three faces, a flipped face); find_mesh_problems() says where, with lines.
  TriangleMesh(int n_vertices, std::vector<Face> faces);

  int n_vertices() const { return arrays_->n_vertices; }
  int n_edges() const { return static_cast<int>(arrays_->vertices_of_edge.size()); }
  int n_faces() const { return static_cast<int>(arrays_->vertices_of_face.size()); }
  int n_border_edges() const { return arrays_->n_border_edges; }
  /// Every edge has two faces.
  bool is_closed() const { return n_border_edges() == 0 && n_faces() > 0; }

  std::span<const Face> vertices_of_face() const { return arrays_->vertices_of_face; }
  /// edges_of_face()[f][k] joins the vertices k and k + 1 of face f.
  std::span<const std::array<int, 3>> edges_of_face() const { return arrays_->edges_of_face; }
  std::span<const std::array<int, 2>> vertices_of_edge() const { return arrays_->vertices_of_edge; }
  /// The second face is -1 at a border.
  std::span<const std::array<int, 2>> faces_of_edge() const { return arrays_->faces_of_edge; }
  /// The paper's v1234: start and end of the edge, the vertex opposite in its first face and in its second (-1:
  /// border).
  std::span<const std::array<int, 4>> hinge_of_edge() const { return arrays_->hinge_of_edge; }

  /// Faces around a vertex, counter-clockwise; at a border from the first face of the fan to the last.
  std::span<const int> faces_of_vertex(int v) const { return slice(arrays_->faces_of_vertex, arrays_->face_start, v); }
  /// The corners at a vertex, 3 f + k for vertex k of face f, ascending.
  std::span<const int> corners_of_vertex(int v) const {
    return slice(arrays_->corners_of_vertex, arrays_->face_start, v);
  }
  /// Neighbours of a vertex, counter-clockwise; at a border one more than faces.
  std::span<const int> neighbours_of_vertex(int v) const { return slice(arrays_->neighbours, arrays_->neighbour_start, v); }

 private:
  struct Arrays {
    int n_vertices = 0;
    int n_border_edges = 0;
    std::vector<Face> vertices_of_face;
    std::vector<std::array<int, 3>> edges_of_face;
    std::vector<std::array<int, 2>> vertices_of_edge, faces_of_edge;
    std::vector<std::array<int, 4>> hinge_of_edge;
    std::vector<int> face_start, faces_of_vertex, corners_of_vertex, neighbour_start, neighbours;

    int n_faces() const { return static_cast<int>(vertices_of_face.size()); }
    int n_edges() const { return static_cast<int>(vertices_of_edge.size()); }
    void build_edges();
    void build_rings();
  };
  static std::span<const int> slice(const std::vector<int>& items, const std::vector<int>& start, int v) {
    return {items.data() + start[v], items.data() + start[v + 1]};
  }

  std::shared_ptr<const Arrays> arrays_;
};

}  // namespace pliant
