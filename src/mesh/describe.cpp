#include "mesh/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/angles.hpp"
#include "mesh/geometry.hpp"

namespace pliant {

int count_components(const TriangleMesh& mesh) {
  std::vector<int> parent(mesh.n_vertices());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  int components = mesh.n_vertices();
  for (const auto& [a, b] : mesh.vertices_of_edge()) {
    const int from = root(a), to = root(b);
    if (from != to) {
      parent[from] = to;
      --components;
    }
  }
  return components;
}

namespace {

/// Whether the faces around every vertex form one fan: neighbours equal faces (ring) or exceed them by one (open fan).
bool has_single_fans(const TriangleMesh& mesh) {
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    const auto faces = mesh.faces_of_vertex(v);
    for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
      const auto& a = mesh.edges_of_face()[faces[i]];
      const auto& b = mesh.edges_of_face()[faces[i + 1]];
      if (std::none_of(a.begin(), a.end(), [&](int e) { return std::find(b.begin(), b.end(), e) != b.end(); }))
        return false;
    }
  }
  return true;
}

}  // namespace

MeshReport describe(const Surface& surface) {
  const TriangleMesh& mesh = surface.mesh;
  MeshReport report;
  report.n_vertices = mesh.n_vertices();
  report.n_edges = mesh.n_edges();
  report.n_faces = mesh.n_faces();
  report.n_border_edges = mesh.n_border_edges();
  report.n_components = count_components(mesh);
  report.euler_characteristic = report.n_vertices - report.n_edges + report.n_faces;
  report.closed = mesh.is_closed();
  report.manifold = has_single_fans(mesh);
  report.area = total_area(mesh, surface.positions);
  if (report.closed) report.volume = enclosed_volume(mesh, surface.positions);
  if (mesh.n_faces() == 0) return report;

  const auto lengths = edge_lengths(mesh, surface.positions);
  report.edge_min = *std::min_element(lengths.begin(), lengths.end());
  report.edge_max = *std::max_element(lengths.begin(), lengths.end());
  report.edge_mean = std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
  report.angle_min = 180;
  for (const auto& corners : face_angles(mesh, surface.positions))
    for (double angle : corners) {
      report.angle_min = std::min(report.angle_min, angle / degree);
      report.angle_max = std::max(report.angle_max, angle / degree);
    }
  report.lower = report.upper = surface.positions[0];
  for (const Vec3& x : surface.positions)
    for (int d = 0; d < 3; ++d) {
      report.lower[d] = std::min(report.lower[d], x[d]);
      report.upper[d] = std::max(report.upper[d], x[d]);
    }
  return report;
}

std::string format(const MeshReport& r) {
  std::string text;
  const auto line = [&](const char* name, const std::string& value) { text += fmt::format("{:<20}{}\n", name, value); };
  line("vertices", fmt::format("{}", r.n_vertices));
  line("edges", fmt::format("{}", r.n_edges));
  line("faces", fmt::format("{}", r.n_faces));
  line("components", fmt::format("{}", r.n_components));
  line("Euler number", fmt::format("{}", r.euler_characteristic));
  line("closed", r.closed ? "yes" : fmt::format("no, {} border edges", r.n_border_edges));
  line("manifold", r.manifold ? "yes" : "no, fans of faces meet in a point");
  line("area", fmt::format("{:.10g}", r.area));
  if (r.closed) line("volume", fmt::format("{:.10g}", r.volume));
  line("edge length", fmt::format("min {:.6g}, mean {:.6g}, max {:.6g}", r.edge_min, r.edge_mean, r.edge_max));
  line("angles [deg]", fmt::format("min {:.4g}, max {:.4g}", r.angle_min, r.angle_max));
  line("bounding box", fmt::format("[{:.6g}, {:.6g}] x [{:.6g}, {:.6g}] x [{:.6g}, {:.6g}]", r.lower.x, r.upper.x,
                                   r.lower.y, r.upper.y, r.lower.z, r.upper.z));
  return text;
}

}  // namespace pliant
