#include "mesh/lids.hpp"

#include <map>

#include "mesh/geometry.hpp"

namespace pliant {

LiddedSurface::LiddedSurface(const TriangleMesh& mesh)
    : faces_(mesh.vertices_of_face().begin(), mesh.vertices_of_face().end()) {
  std::multimap<int, int> next;  // along the borders, as their faces run
  const auto edges = mesh.vertices_of_edge();
  const auto faces = mesh.faces_of_edge();
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (faces[e][1] < 0) next.emplace(edges[e][0], edges[e][1]);
  while (!next.empty()) {
    std::vector<int> border;
    for (auto edge = next.begin(); edge != next.end(); edge = next.find(border.back())) {
      if (border.empty()) border.push_back(edge->first);
      border.push_back(edge->second);
      next.erase(edge);
    }
    border.pop_back();  // where it began
    borders_.push_back(std::move(border));
  }
  for (std::size_t b = 0; b < borders_.size(); ++b) {
    const auto& border = borders_[b];
    const int hub = mesh.n_vertices() + static_cast<int>(b);
    for (std::size_t n = 0; n < border.size(); ++n) faces_.push_back({border[(n + 1) % border.size()], border[n], hub});
  }
}

std::vector<Vec3> LiddedSurface::with_hubs(std::span<const Vec3> of_vertices) const {
  std::vector<Vec3> all(of_vertices.begin(), of_vertices.end());
  for (const auto& border : borders_) {
    Vec3 sum;
    for (int v : border) sum += of_vertices[static_cast<std::size_t>(v)];
    all.push_back(sum / static_cast<double>(border.size()));
  }
  return all;
}

VolumeAndRate enclosed_volume_and_rate(std::span<const Face> faces, std::span<const Vec3> positions,
                                       std::span<const Vec3> velocities) {
  VolumeAndRate sum;
  if (positions.empty()) return sum;
  // From a point of the surface, not the origin: a body far away would lose digits.
  const Vec3 apex = positions[0];
  for (const Face& face : faces) {
    const Vec3 area = face_vector(face, positions);
    sum.volume += dot(positions[static_cast<std::size_t>(face[0])] - apex, area) / 6;
    for (int v : face) sum.rate += dot(velocities[static_cast<std::size_t>(v)], area) / 6;
  }
  return sum;
}

}  // namespace pliant
