#include "transfer/marker_refinement.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/error.hpp"
#include "mesh/geometry.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "mesh/shapes/plate.hpp"

namespace pliant {
namespace {

// A sphere with its vertices moved about, so that no two faces are alike.
Surface uneven_sphere() {
  auto surface = make_icosphere(3, 0.7);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> by(-0.05, 0.05);
  for (Vec3& x : surface.positions) x += Vec3{3 + by(random), by(random), by(random)};
  return surface;
}

// 1, 2, 3, ... parts in turn.
std::vector<int> mixed_parts(const TriangleMesh& mesh) {
  std::vector<int> parts;
  for (int f = 0; f < mesh.n_faces(); ++f) parts.push_back(1 + f % 6);
  return parts;
}

Vec3 wavy(std::size_t i) {
  const auto x = static_cast<double>(i);
  return {std::sin(x), std::cos(2.1 * x), std::sin(3.7 * x + 1)};
}

TEST(MarkerLayout, OfOnePartIsTheCentroids) {
  const auto surface = uneven_sphere();
  const MarkerLayout layout(surface.mesh);
  MarkerSet markers;
  layout.place(surface.positions, surface.positions, markers);
  const auto centroids = face_centroids(surface.mesh, surface.positions);
  const auto areas = face_areas(surface.mesh, surface.positions);
  const auto normals = face_normals(surface.mesh, surface.positions);
  ASSERT_EQ(layout.n_markers(), surface.mesh.n_faces());
  for (std::size_t f = 0; f < centroids.size(); ++f) {
    EXPECT_LT(norm(markers.positions[f] - centroids[f]), 1e-15 * 4);
    EXPECT_LT(norm(markers.normals[f] - normals[f]), 1e-14);
    EXPECT_DOUBLE_EQ(markers.areas[f], areas[f]);
  }
}

TEST(MarkerLayout, PartsFillTheirFaces) {
  // First and second moments of a face's area: the centroids of congruent parts have the first of the face, and with
  // each part's own second moment (1/n^2 of the face's) the second as well.
  const auto surface = uneven_sphere();
  const auto parts = mixed_parts(surface.mesh);
  const MarkerLayout layout(surface.mesh, parts);
  MarkerSet markers;
  layout.place(surface.positions, surface.positions, markers);
  const auto areas = face_areas(surface.mesh, surface.positions);
  const auto centroids = face_centroids(surface.mesh, surface.positions);
  for (int f = 0; f < layout.n_faces(); ++f) {
    const auto at = static_cast<std::size_t>(f);
    const double n = parts[at];
    double area = 0, second = 0;
    Vec3 first;
    for (int m = layout.first_marker(f); m < layout.first_marker(f + 1); ++m) {
      const auto marker = static_cast<std::size_t>(m);
      ASSERT_EQ(layout.face_of(m), f);
      const Vec3 arm = markers.positions[marker] - centroids[at], w = layout.weights(m);
      EXPECT_GT(std::min({w.x, w.y, w.z}), 0);
      area += markers.areas[marker];
      first += markers.areas[marker] * arm;
      second += markers.areas[marker] * dot(arm, arm);
    }
    double of_face = 0;
    for (int v : surface.mesh.vertices_of_face()[at]) {
      const Vec3 arm = surface.positions[static_cast<std::size_t>(v)] - centroids[at];
      of_face += areas[at] * dot(arm, arm) / 12;
    }
    EXPECT_NEAR(area, areas[at], 1e-14 * areas[at]);
    EXPECT_LT(norm(first), 1e-15);
    EXPECT_NEAR(second + of_face / (n * n), of_face, 1e-13 * of_face);
  }
}

TEST(MarkerLayout, GivesVelocitiesOfLinearFieldsExactly) {
  const auto surface = uneven_sphere();
  const Mat3 gradient{{{0.3, -1, 2}, {0.7, 0.1, -0.4}, {5, 0.2, 0.9}}};
  std::vector<Vec3> velocities;
  for (Vec3 x : surface.positions) velocities.push_back(Vec3{1, 2, 3} + gradient * x);
  const MarkerLayout layout(surface.mesh, mixed_parts(surface.mesh));
  MarkerSet markers;
  layout.place(surface.positions, velocities, markers);
  for (std::size_t m = 0; m < markers.positions.size(); ++m)
    EXPECT_LT(norm(markers.velocities[m] - (Vec3{1, 2, 3} + gradient * markers.positions[m])), 1e-13);
}

TEST(MarkerLayout, PlacesMarkersInsideThatMoveWithTheBody) {
  const auto surface = uneven_sphere();
  const MarkerLayout layout(surface.mesh, mixed_parts(surface.mesh));
  const Vec3 omega{0.3, -1, 2};
  std::vector<Vec3> velocities;
  for (Vec3 x : surface.positions) velocities.push_back(Vec3{1, 2, 3} + cross(omega, x));
  MarkerSet on, in;
  layout.place(surface.positions, velocities, on);
  layout.place_inside(surface.positions, velocities, 0.07, in);
  for (std::size_t m = 0; m < on.positions.size(); ++m) {
    EXPECT_LT(norm(in.positions[m] + 0.07 * on.normals[m] - on.positions[m]), 1e-15);
    EXPECT_LT(norm(in.velocities[m] - (Vec3{1, 2, 3} + cross(omega, in.positions[m]))), 1e-13);
    EXPECT_EQ(in.areas[m], on.areas[m]);
  }
}

TEST(MarkerLayout, DrawsMarkersInFromBorders) {
  auto plate = make_plate(3, 2, 0.3);
  const auto turned = [](Vec3 x) { return Vec3{1 + x.x + 0.5 * x.y, x.y - 0.5 * x.x, 2 * x.x}; };
  MarkerLayout layout(plate.mesh, 2);
  MarkerSet on, in;
  layout.place(plate.positions, plate.positions, on);
  layout.draw_in(plate.mesh, plate.positions, 0.05);
  layout.place(plate.positions, plate.positions, in);
  for (std::size_t m = 0; m < on.positions.size(); ++m) {
    const Vec3 x = on.positions[m], shift = in.positions[m] - x;
    const double distance = std::min(1.5 - std::abs(x.x), 1 - std::abs(x.y));
    EXPECT_NEAR(norm(shift), std::max(0.0, 0.05 - distance / 10), 1e-14);
    const double drawn = std::min(1.5 - std::abs(in.positions[m].x), 1 - std::abs(in.positions[m].y));
    if (std::abs(1.5 - std::abs(x.x) - 1 + std::abs(x.y)) > 0.1) { EXPECT_NEAR(drawn, distance + norm(shift), 1e-14); }
    EXPECT_EQ(in.areas[m], on.areas[m]);
  }
  // As part of the surface: they go where it goes, and give their forces to the same vertices.
  std::vector<Vec3> moved;
  for (Vec3 x : plate.positions) moved.push_back(turned(x));
  layout.place(moved, moved, on);
  Vec3 torque;
  std::vector<Vec3> forces, on_vertices(moved.size());
  for (std::size_t m = 0; m < on.positions.size(); ++m) {
    EXPECT_LT(norm(on.positions[m] - turned(in.positions[m])), 1e-14);
    forces.push_back(wavy(m));
    torque += cross(on.positions[m], forces[m]);
  }
  layout.add_to_vertices(forces, on_vertices);
  for (std::size_t v = 0; v < moved.size(); ++v) torque -= cross(moved[v], on_vertices[v]);
  EXPECT_LT(norm(torque), 1e-11);
}

TEST(MarkerLayout, ReturnsForceAndTorqueWhole) {
  const auto surface = uneven_sphere();
  const MarkerLayout layout(surface.mesh, mixed_parts(surface.mesh));
  MarkerSet markers;
  layout.place(surface.positions, surface.positions, markers);
  std::vector<Vec3> on_markers, on_vertices(surface.positions.size()), on_faces(surface.mesh.vertices_of_face().size());
  for (std::size_t m = 0; m < markers.positions.size(); ++m) on_markers.push_back(wavy(m));
  layout.add_to_vertices(on_markers, on_vertices);
  layout.add_to_faces(on_markers, on_faces);
  Vec3 force, torque, of_faces;
  for (std::size_t m = 0; m < on_markers.size(); ++m) {
    force += on_markers[m];
    torque += cross(markers.positions[m], on_markers[m]);
  }
  for (std::size_t v = 0; v < on_vertices.size(); ++v) {
    force -= on_vertices[v];
    torque -= cross(surface.positions[v], on_vertices[v]);
  }
  for (Vec3 f : on_faces) of_faces += f;
  for (Vec3 f : on_markers) of_faces -= f;
  // Round-off of sums of thousands of terms of size up to 7 (arms of 3 to 4).
  EXPECT_LT(norm(force), 1e-11);
  EXPECT_LT(norm(torque), 1e-11);
  EXPECT_LT(norm(of_faces), 1e-11);
}

TEST(RefinementFor, KeepsMarkersAsCloseAsTheGridAsks) {
  EXPECT_EQ(refinement_for(0.5 * longest_marker_edge, 1), 1);
  EXPECT_EQ(refinement_for(longest_marker_edge, 1), 1);
  EXPECT_EQ(refinement_for(1.01 * longest_marker_edge, 1), 2);
  EXPECT_EQ(refinement_for(3.0 * longest_marker_edge * 0.1, 0.1), 3) << "round-off must not add a part";
  const auto surface = uneven_sphere();
  for (double spacing : {0.02, 0.1, 0.5}) {
    const auto parts = refinement_for(surface.mesh, surface.positions, spacing);
    const auto lengths = edge_lengths(surface.mesh, surface.positions);
    for (std::size_t f = 0; f < parts.size(); ++f) {
      double longest = 0;
      for (int e : surface.mesh.edges_of_face()[f]) longest = std::max(longest, lengths[static_cast<std::size_t>(e)]);
      EXPECT_LE(longest / parts[f], longest_marker_edge * spacing * (1 + 1e-9));
      if (parts[f] > 1) { EXPECT_GT(longest / (parts[f] - 1), longest_marker_edge * spacing); }
    }
  }
}

TEST(RefinementFor, RefusesWhatCannotBeSplit) {
  EXPECT_THROW(refinement_for(0, 1), InputError);
  EXPECT_THROW(refinement_for(1, 0), InputError);
  EXPECT_THROW(refinement_for(std::nan(""), 1), InputError);
  EXPECT_THROW(refinement_for(1, 1e-5), InputError);
  const auto surface = uneven_sphere();
  EXPECT_THROW(MarkerLayout(surface.mesh, 0), InputError);
  EXPECT_THROW(MarkerLayout(surface.mesh, std::vector<int>{1, 2}), InputError);
}

}  // namespace
}  // namespace pliant
