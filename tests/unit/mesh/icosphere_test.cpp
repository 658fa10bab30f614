#include "mesh/shapes/icosphere.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "core/error.hpp"
#include "mesh/check_mesh.hpp"
#include "mesh/geometry.hpp"

namespace pliant {
namespace {

TEST(Icosphere, HasTheKnownCountsAndIsSoundAtEveryFrequency) {
  for (int f : {1, 2, 3, 4, 5, 6, 7, 8, 12}) {
    const auto sphere = make_icosphere(f, 1.5);
    EXPECT_EQ(sphere.mesh.n_vertices(), 10 * f * f + 2);
    EXPECT_EQ(sphere.mesh.n_faces(), 20 * f * f);
    EXPECT_EQ(sphere.mesh.n_edges(), 30 * f * f);
    for (const Vec3& x : sphere.positions) EXPECT_NEAR(norm(x), 1.5, 1e-14);
    SurfaceData data{"sphere", sphere.positions, {}, {}, {}};
    data.faces.assign(sphere.mesh.vertices_of_face().begin(), sphere.mesh.vertices_of_face().end());
    EXPECT_EQ(find_mesh_problems(data, Closure::closed), std::vector<std::string>{});
  }
}

TEST(Icosphere, IsCentredAndNearlyEven) {
  const auto sphere = make_icosphere(8, 1.0);
  EXPECT_LT(norm(mean_position(sphere.positions)), 1e-14);
  const auto lengths = edge_lengths(sphere.mesh, sphere.positions);
  const auto [least, most] = std::minmax_element(lengths.begin(), lengths.end());
  EXPECT_LT(*most / *least, 1.3);
}

TEST(Icosphere, FollowingFacesAreNearInSpace) {
  const auto sphere = make_icosphere(16, 1.0);
  const auto centroids = face_centroids(sphere.mesh, sphere.positions);
  double mean_step = 0;
  for (std::size_t f = 1; f < centroids.size(); ++f) mean_step += norm(centroids[f] - centroids[f - 1]);
  mean_step /= static_cast<double>(centroids.size());
  EXPECT_LT(mean_step, 0.1);  // an edge is 0.07 long; in random order the mean is 1.33
}

TEST(Icosphere, RefusesBadSizes) {
  EXPECT_THROW(make_icosphere(0, 1.0), InputError);
  EXPECT_THROW(make_icosphere(4, -1.0), InputError);
}

}  // namespace
}  // namespace pliant
