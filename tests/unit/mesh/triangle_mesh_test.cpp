#include "mesh/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "patches.hpp"

namespace pliant {
namespace {

/// What must hold for every mesh.
void expect_consistent(const TriangleMesh& mesh) {
  const auto faces = mesh.vertices_of_face();
  for (int e = 0; e < mesh.n_edges(); ++e) {
    const auto [a, b, c, d] = mesh.hinge_of_edge()[e];
    EXPECT_EQ(mesh.vertices_of_edge()[e], (std::array{a, b}));
    const auto [first, second] = mesh.faces_of_edge()[e];
    const auto contains_cycle = [&](int f, Face cycle) {
      for (int k = 0; k < 3; ++k)
        if (faces[f] == Face{cycle[k], cycle[(k + 1) % 3], cycle[(k + 2) % 3]}) return true;
      return false;
    };
    EXPECT_TRUE(contains_cycle(first, {a, b, c}));
    EXPECT_EQ(second < 0, d < 0);
    if (second >= 0) { EXPECT_TRUE(contains_cycle(second, {b, a, d})); }
  }
  for (int f = 0; f < mesh.n_faces(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto edge = mesh.vertices_of_edge()[mesh.edges_of_face()[f][k]];
      EXPECT_EQ((std::set{edge[0], edge[1]}), (std::set{faces[f][k], faces[f][(k + 1) % 3]}));
    }
  std::vector<std::set<int>> faces_around(mesh.n_vertices()), neighbours(mesh.n_vertices());
  for (int f = 0; f < mesh.n_faces(); ++f)
    for (int v : faces[f]) faces_around[v].insert(f);
  for (const auto& [a, b] : mesh.vertices_of_edge()) {
    neighbours[a].insert(b);
    neighbours[b].insert(a);
  }
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    const auto ring = mesh.neighbours_of_vertex(v);
    const auto fan = mesh.faces_of_vertex(v);
    EXPECT_EQ(std::set<int>(ring.begin(), ring.end()), neighbours[v]);
    EXPECT_EQ(ring.size(), neighbours[v].size());
    EXPECT_EQ(std::set<int>(fan.begin(), fan.end()), faces_around[v]);
    EXPECT_EQ(fan.size(), faces_around[v].size());
    for (std::size_t i = 0; i < fan.size(); ++i) {  // face i spans neighbours i and i + 1, counter-clockwise
      const Face& face = faces[fan[i]];
      const auto corner = std::find(face.begin(), face.end(), v) - face.begin();
      EXPECT_EQ(face[(corner + 1) % 3], ring[i]);
      EXPECT_EQ(face[(corner + 2) % 3], ring[(i + 1) % ring.size()]);
    }
  }
}

TEST(TriangleMesh, IsConsistentOnAClosedSurface) {
  const auto sphere = make_icosphere(3, 1.0);
  EXPECT_TRUE(sphere.mesh.is_closed());
  expect_consistent(sphere.mesh);
}

TEST(TriangleMesh, IsConsistentOnAPatchWithBorders) {
  const auto patch = make_lattice_patch(3);
  EXPECT_FALSE(patch.mesh.is_closed());
  EXPECT_EQ(patch.mesh.n_border_edges(), 12);
  EXPECT_EQ(patch.mesh.n_vertices() - patch.mesh.n_edges() + patch.mesh.n_faces(), 1);
  expect_consistent(patch.mesh);
}

TEST(TriangleMesh, RefusesWhatIsNoOrientedManifold) {
  EXPECT_THROW(TriangleMesh(3, {{0, 1, 3}}), InputError);
  EXPECT_THROW(TriangleMesh(3, {{0, 1, 1}}), InputError);
  EXPECT_THROW(TriangleMesh(4, {{0, 1, 2}, {0, 1, 3}}), InputError);
  EXPECT_THROW(TriangleMesh(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), InputError);
}

}  // namespace
}  // namespace pliant
