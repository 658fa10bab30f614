#include "transfer/marker_refinement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "mesh/geometry.hpp"

namespace pliant {
namespace {

constexpr int most_parts = 1000;

/// Barycentric coordinates of the centroids of n^2 congruent triangles: those that stand as their face does, then the
/// turned ones.
std::vector<Vec3> centroid_weights(int n) {
  std::vector<Vec3> weights;
  weights.reserve(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
  for (int turned = 0; turned < 2; ++turned) {
    const double offset = (1 + turned) / 3.0;
    for (int i = 0; i < n - turned; ++i)
      for (int j = 0; j < n - turned - i; ++j) {
        const double a = (i + offset) / n, b = (j + offset) / n;
        weights.push_back({a, b, 1 - a - b});
      }
  }
  return weights;
}

Vec3 combine(Vec3 w, const Face& face, std::span<const Vec3> values) {
  return w.x * values[static_cast<std::size_t>(face[0])] + w.y * values[static_cast<std::size_t>(face[1])] +
         w.z * values[static_cast<std::size_t>(face[2])];
}

/// A border edge, and the direction away from it within its face.
struct Border {
  Vec3 start, end, inwards;
};

std::vector<Border> borders_of(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  std::vector<Border> borders;
  const auto at = [&](int v) { return positions[static_cast<std::size_t>(v)]; };
  for (std::size_t e = 0; e < mesh.faces_of_edge().size(); ++e) {
    const auto faces = mesh.faces_of_edge()[e];
    if (faces[1] >= 0) continue;
    const auto ends = mesh.vertices_of_edge()[e];
    const Vec3 normal = face_vector(mesh.vertices_of_face()[static_cast<std::size_t>(faces[0])], positions);
    borders.push_back({at(ends[0]), at(ends[1]), normalized(cross(normal, at(ends[1]) - at(ends[0])))});
  }
  return borders;
}

double distance_from(const Border& border, Vec3 x) {
  const Vec3 along = border.end - border.start;
  const double part = std::clamp(dot(x - border.start, along) / dot(along, along), 0.0, 1.0);
  return norm(x - border.start - part * along);
}

}  // namespace

int refinement_for(double longest_edge, double spacing) {
  const double parts = std::ceil(longest_edge / (longest_marker_edge * spacing) * (1 - 1e-12));
  if (!(longest_edge > 0 && spacing > 0 && parts <= most_parts))
    throw InputError(
        fmt::format("a face with an edge of length {:.4g} cannot be refined for a grid of spacing {:.4g}: both must be "
                    "positive, and "
                    "an edge at most {:.4g} spacings long",
                    longest_edge, spacing, longest_marker_edge * most_parts));
  return std::max(1, static_cast<int>(parts));
}

std::vector<int> refinement_for(const TriangleMesh& mesh, std::span<const Vec3> positions, double spacing) {
  const auto lengths = edge_lengths(mesh, positions);
  std::vector<int> parts;
  parts.reserve(static_cast<std::size_t>(mesh.n_faces()));
  for (const auto& edges : mesh.edges_of_face()) {
    double longest = 0;
    for (int e : edges) longest = std::max(longest, lengths[static_cast<std::size_t>(e)]);
    parts.push_back(refinement_for(longest, spacing));
  }
  return parts;
}

MarkerLayout::MarkerLayout(const TriangleMesh& mesh, int parts) {
  const std::vector<int> all(static_cast<std::size_t>(mesh.n_faces()), parts);
  build(mesh, all);
}

MarkerLayout::MarkerLayout(const TriangleMesh& mesh, std::span<const int> parts) { build(mesh, parts); }

void MarkerLayout::build(const TriangleMesh& mesh, std::span<const int> parts) {
  faces_.assign(mesh.vertices_of_face().begin(), mesh.vertices_of_face().end());
  if (parts.size() != faces_.size())
    throw InputError(fmt::format("{} refinements are given for {} faces", parts.size(), faces_.size()));
  long long total = 0;
  for (int n : parts) {
    if (n < 1 || n > most_parts)
      throw InputError(fmt::format("a face cannot be split {} times along its edges: give 1 to {}", n, most_parts));
    total += static_cast<long long>(n) * n;
  }
  if (total > std::numeric_limits<int>::max())
    throw InputError(fmt::format("a surface of {} faces would have {} markers, more than can be counted: refine less",
                                 faces_.size(), total));

  std::vector<int> pattern_of_parts(most_parts + 1, -1);
  first_marker_.push_back(0);
  face_of_marker_.reserve(static_cast<std::size_t>(total));
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    int& pattern = pattern_of_parts[static_cast<std::size_t>(parts[f])];
    if (pattern < 0) {
      pattern = static_cast<int>(patterns_.size());
      patterns_.push_back({parts[f], centroid_weights(parts[f])});
    }
    pattern_of_face_.push_back(pattern);
    first_marker_.push_back(first_marker_.back() + parts[f] * parts[f]);
    face_of_marker_.resize(static_cast<std::size_t>(first_marker_.back()), static_cast<int>(f));
  }
}

Vec3 MarkerLayout::weights(int marker) const {
  const auto moved = std::lower_bound(moved_.begin(), moved_.end(), static_cast<std::size_t>(marker),
                                      [](const Moved& m, std::size_t of) { return m.marker < of; });
  if (moved != moved_.end() && moved->marker == static_cast<std::size_t>(marker)) return moved->weights;
  const int face = face_of(marker);
  return pattern_of(static_cast<std::size_t>(face)).weights[static_cast<std::size_t>(marker - first_marker(face))];
}

void MarkerLayout::place(std::span<const Vec3> positions, std::span<const Vec3> velocities, MarkerSet& markers) const {
  const auto n = static_cast<std::size_t>(n_markers());
  for (auto* vectors : {&markers.positions, &markers.velocities, &markers.normals}) vectors->resize(n);
  markers.areas.resize(n);
  interpolate(positions, markers.positions);
  interpolate(velocities, markers.velocities);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Vec3 vector = face_vector(faces_[f], positions);
    const double length = norm(vector), area = 0.5 * length / static_cast<double>(pattern_of(f).weights.size());
    const Vec3 normal = vector / length;
    for (auto m = static_cast<std::size_t>(first_marker_[f]); m < static_cast<std::size_t>(first_marker_[f + 1]); ++m) {
      markers.areas[m] = area;
      markers.normals[m] = normal;
    }
  }
}

void MarkerLayout::place_inside(std::span<const Vec3> positions, std::span<const Vec3> velocities, double retraction,
                                MarkerSet& markers) const {
  place(positions, velocities, markers);
  for (int f = 0; f < n_faces(); ++f) {
    const Face& face = faces_[static_cast<std::size_t>(f)];
    const auto edge = [&](std::span<const Vec3> values, std::size_t k) {
      return values[static_cast<std::size_t>(face[k])] - values[static_cast<std::size_t>(face[0])];
    };
    const auto first = static_cast<std::size_t>(first_marker(f)), last = static_cast<std::size_t>(first_marker(f + 1));
    const Vec3 normal = markers.normals[first];
    const Vec3 rate =
        (cross(edge(velocities, 1), edge(positions, 2)) + cross(edge(positions, 1), edge(velocities, 2))) /
        norm(face_vector(face, positions));
    const Vec3 normal_rate = rate - dot(rate, normal) * normal;
    for (std::size_t m = first; m < last; ++m) {
      markers.positions[m] -= retraction * normal;
      markers.velocities[m] -= retraction * normal_rate;
    }
  }
}

void MarkerLayout::draw_in(const TriangleMesh& mesh, std::span<const Vec3> positions, double length) {
  moved_.clear();
  const double reach = 10 * length;
  const auto borders = borders_of(mesh, positions);
  std::vector<Border> near;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const auto corner = [&](std::size_t k) { return positions[static_cast<std::size_t>(face[k % 3])]; };
    const Vec3 middle = (corner(0) + corner(1) + corner(2)) / 3;
    const double radius = std::max({norm(corner(0) - middle), norm(corner(1) - middle), norm(corner(2) - middle)});
    near.clear();
    for (const Border& border : borders)
      if (distance_from(border, middle) < reach + radius) near.push_back(border);
    if (near.empty()) continue;
    const Vec3 vector = face_vector(face, positions), scaled = vector / dot(vector, vector);
    const auto& weights = pattern_of(f).weights;
    for (std::size_t n = 0; n < weights.size(); ++n) {
      const Vec3 x = combine(weights[n], face, positions);
      const auto nearest = std::min_element(near.begin(), near.end(), [&](const Border& a, const Border& b) {
        return distance_from(a, x) < distance_from(b, x);
      });
      const Vec3 shift = std::max(0.0, length - distance_from(*nearest, x) / 10) * nearest->inwards;
      Vec3 moved = weights[n];
      for (int k = 0; k < 3; ++k) {
        const auto next = static_cast<std::size_t>(k) + 1;
        moved[k] += dot(cross(scaled, corner(next + 1) - corner(next)), shift);
      }
      moved_.push_back({static_cast<std::size_t>(first_marker_[f]) + n, moved});
    }
  }
}

void MarkerLayout::interpolate(std::span<const Vec3> of_vertices, std::span<Vec3> at_markers) const {
  std::size_t m = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (Vec3 w : pattern_of(f).weights) at_markers[m++] = combine(w, faces_[f], of_vertices);
  for (const auto& [marker, w] : moved_)
    at_markers[marker] = combine(w, faces_[static_cast<std::size_t>(face_of_marker_[marker])], of_vertices);
}

void MarkerLayout::add_to_vertices(std::span<const Vec3> marker_forces, std::span<Vec3> vertex_forces) const {
  std::size_t m = 0;
  auto moved = moved_.begin();
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (Vec3 w : pattern_of(f).weights) {
      if (moved != moved_.end() && moved->marker == m) w = (moved++)->weights;
      const Vec3 force = marker_forces[m++];
      for (int k = 0; k < 3; ++k)
        vertex_forces[static_cast<std::size_t>(faces_[f][static_cast<std::size_t>(k)])] += w[k] * force;
    }
}

void MarkerLayout::add_to_faces(std::span<const Vec3> marker_forces, std::span<Vec3> face_forces) const {
  for (std::size_t m = 0; m < face_of_marker_.size(); ++m)
    face_forces[static_cast<std::size_t>(face_of_marker_[m])] += marker_forces[m];
}

}  // namespace pliant
