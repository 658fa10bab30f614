#include "mesh/triangle_mesh.hpp"

#include <algorithm>
#include <string>

#include "core/error.hpp"

namespace pliant {
namespace {

/// Side k of face f, from its smaller to its larger vertex.
struct HalfEdge {
  int low, high, face, side;
};

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("triangle mesh: " + what + "; check the surface with `pliant mesh info`");
}

}  // namespace

TriangleMesh::TriangleMesh(int n_vertices, std::vector<Face> faces) {
  auto arrays = std::make_shared<Arrays>();
  arrays->n_vertices = n_vertices;
  arrays->vertices_of_face = std::move(faces);
  for (std::size_t f = 0; f < arrays->vertices_of_face.size(); ++f) {
    const Face& face = arrays->vertices_of_face[f];
    for (int v : face)
      if (v < 0 || v >= n_vertices)
        refuse("face " + std::to_string(f) + " names vertex " + std::to_string(v) + ", but there are " +
               std::to_string(n_vertices));
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0])
      refuse("face " + std::to_string(f) + " names a vertex twice");
  }
  arrays->build_edges();
  arrays->build_rings();
  arrays_ = std::move(arrays);
}

void TriangleMesh::Arrays::build_edges() {
  std::vector<HalfEdge> halves;
  halves.reserve(3 * vertices_of_face.size());
  for (int f = 0; f < n_faces(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = vertices_of_face[f][k], b = vertices_of_face[f][(k + 1) % 3];
      halves.push_back({std::min(a, b), std::max(a, b), f, k});
    }
  // Halves are made in order of faces; a stable sort keeps that order within an edge.
  std::stable_sort(halves.begin(), halves.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  });
  // twin[3 f + k]: the other half of the same edge, or -1.
  std::vector<int> twin(halves.size(), -1);
  for (std::size_t i = 0; i < halves.size();) {
    std::size_t end = i + 1;
    while (end < halves.size() && halves[end].low == halves[i].low && halves[end].high == halves[i].high) ++end;
    if (end - i > 2)
      refuse("edge " + std::to_string(halves[i].low) + "-" + std::to_string(halves[i].high) + " has " +
             std::to_string(end - i) + " faces");
    if (end - i == 2) {
      const HalfEdge &first = halves[i], &second = halves[i + 1];
      if (vertices_of_face[first.face][first.side] == vertices_of_face[second.face][second.side])
        refuse("faces " + std::to_string(first.face) + " and " + std::to_string(second.face) +
               " are oriented against each other");
      twin[3 * first.face + first.side] = 3 * second.face + second.side;
      twin[3 * second.face + second.side] = 3 * first.face + first.side;
    }
    i = end;
  }

  edges_of_face.assign(vertices_of_face.size(), {-1, -1, -1});
  for (int f = 0; f < n_faces(); ++f)
    for (int k = 0; k < 3; ++k) {
      if (edges_of_face[f][k] >= 0) continue;
      const Face& face = vertices_of_face[f];
      const int edge = n_edges(), other = twin[3 * f + k];
      edges_of_face[f][k] = edge;
      vertices_of_edge.push_back({face[k], face[(k + 1) % 3]});
      if (other < 0) {
        ++n_border_edges;
        faces_of_edge.push_back({f, -1});
        hinge_of_edge.push_back({face[k], face[(k + 1) % 3], face[(k + 2) % 3], -1});
        continue;
      }
      edges_of_face[other / 3][other % 3] = edge;
      faces_of_edge.push_back({f, other / 3});
      hinge_of_edge.push_back(
          {face[k], face[(k + 1) % 3], face[(k + 2) % 3], vertices_of_face[other / 3][(other % 3 + 2) % 3]});
    }
}

void TriangleMesh::Arrays::build_rings() {
  std::vector<int> start(n_vertices + 1, 0);
  for (const Face& face : vertices_of_face)
    for (int v : face) ++start[v + 1];
  for (int v = 0; v < n_vertices; ++v) start[v + 1] += start[v];
  std::vector<int> corners(3 * vertices_of_face.size());  // 3 f + k, grouped by vertex
  std::vector<int> next_free(start.begin(), start.end() - 1);
  for (int f = 0; f < n_faces(); ++f)
    for (int k = 0; k < 3; ++k) corners[next_free[vertices_of_face[f][k]]++] = 3 * f + k;

  // The face across side `side` of face f (-1: border), as a corner at vertex v.
  const auto across = [&](int f, int side, int v) {
    const auto& pair = faces_of_edge[edges_of_face[f][side]];
    const int other = pair[0] == f ? pair[1] : pair[0];
    if (other < 0) return -1;
    const Face& face = vertices_of_face[other];
    return 3 * other + (face[0] == v ? 0 : face[1] == v ? 1 : 2);
  };

  face_start = start;
  faces_of_vertex.reserve(corners.size());
  neighbour_start.assign(1, 0);
  std::vector<char> visited(corners.size(), 0);
  for (int v = 0; v < n_vertices; ++v) {
    // Fans with a border first, from the face that has the border on its clockwise side; then whole rings.
    for (const bool want_border : {true, false})
      for (int i = start[v]; i < start[v + 1]; ++i) {
        int corner = corners[i];
        if (visited[corner] || (want_border && across(corner / 3, corner % 3, v) >= 0)) continue;
        const bool open_fan = want_border;
        while (corner >= 0 && !visited[corner]) {
          visited[corner] = 1;
          const int f = corner / 3, k = corner % 3;
          faces_of_vertex.push_back(f);
          neighbours.push_back(vertices_of_face[f][(k + 1) % 3]);
          const int next = across(f, (k + 2) % 3, v);
          if (next < 0 && open_fan) neighbours.push_back(vertices_of_face[f][(k + 2) % 3]);
          corner = next;
        }
      }
    neighbour_start.push_back(static_cast<int>(neighbours.size()));
  }
  corners_of_vertex = std::move(corners);
}

}  // namespace pliant
