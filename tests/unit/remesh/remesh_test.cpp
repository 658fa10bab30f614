#include "remesh/remesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "mesh/crossing.hpp"
#include "mesh/describe.hpp"
#include "mesh/geometry.hpp"
#include "mesh/shapes/box.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "mesh/shapes/plate.hpp"
#include "mesh/shapes/ventricle.hpp"

namespace pliant {
namespace {
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

SurfaceData data_of(const Surface& surface) {
  SurfaceData data{"scan", surface.positions, {}, {}, {}};
  data.faces.assign(surface.mesh.vertices_of_face().begin(), surface.mesh.vertices_of_face().end());
  return data;
}

/// Another surface in the same data.
void add(SurfaceData& data, const Surface& surface, Vec3 shift) {
  const int first = static_cast<int>(data.positions.size());
  for (const Vec3 x : surface.positions) data.positions.push_back(x + shift);
  for (const auto& [a, b, c] : surface.mesh.vertices_of_face()) data.faces.push_back({a + first, b + first, c + first});
}

/// Every face with corners of its own, as STL has it, every third turned around.
SurfaceData torn_apart(const SurfaceData& data) {
  SurfaceData soup{"soup", {}, {}, {}, {}};
  for (std::size_t f = 0; f < data.faces.size(); ++f) {
    const int n = static_cast<int>(soup.positions.size());
    for (int v : data.faces[f]) soup.positions.push_back(data.positions[v]);
    soup.faces.push_back(f % 3 == 0 ? Face{n, n + 2, n + 1} : Face{n, n + 1, n + 2});
  }
  return soup;
}

TEST(Remesh, MakesEvenFacesOfASoundSurface) {
  const auto sphere = make_icosphere(20, 1.0);
  const auto [surface, mended] = remesh(data_of(sphere), {.edge = 0.15});
  EXPECT_THAT(mended, IsEmpty());
  const auto report = describe(surface);
  EXPECT_TRUE(surface.mesh.is_closed());
  EXPECT_EQ(report.euler_characteristic, 2);
  EXPECT_NEAR(report.edge_mean, 0.15, 0.02);
  EXPECT_GT(report.angle_min, 25);
  EXPECT_NEAR(report.volume, 4.0 / 3.0 * std::acos(-1.0), 0.05);
}

TEST(Remesh, MendsATornScanWithHolesAndStrayPieces) {
  auto data = data_of(make_icosphere(16, 1.0));
  data.faces.erase(data.faces.begin() + 100, data.faces.begin() + 103);  // a hole
  add(data, make_icosphere(2, 0.03), {3, 0, 0});                         // dirt
  data.faces.push_back(data.faces[50]);                                  // a double face
  data.positions.push_back({7, 7, 7});                                   // a vertex without use
  auto soup = torn_apart(data);
  soup.faces.push_back({0, 0, 1});
  const auto [surface, mended] = remesh(soup, {.edge = 0.12, .fill_holes = 1.0});
  EXPECT_TRUE(surface.mesh.is_closed());
  const auto report = describe(surface);
  EXPECT_EQ(report.n_components, 1);
  EXPECT_NEAR(report.volume, 4.0 / 3.0 * std::acos(-1.0), 0.05);
  EXPECT_GT(report.angle_min, 20);
  EXPECT_THAT(mended, Contains(HasSubstr("vertices at the place of another were merged")));
  EXPECT_THAT(mended, Contains(HasSubstr("faces that are double")));
  EXPECT_THAT(mended, Contains(HasSubstr("turned to the side of their neighbours")));
  EXPECT_THAT(mended, Contains(HasSubstr("1 stray pieces")));
  EXPECT_THAT(mended, Contains(HasSubstr("1 holes were filled")));
}

TEST(Remesh, KeepsBordersAndSharpEdges) {
  const auto [box, nothing] = remesh(data_of(make_box({1, 1, 1}, 0.1)), {.edge = 0.2});
  EXPECT_NEAR(enclosed_volume(box.mesh, box.positions), 1, 1e-12);
  EXPECT_NEAR(total_area(box.mesh, box.positions), 6, 1e-12);
  const auto sack = make_ventricle({1, 2, 0.1, 0});
  const auto [coarse, mended] = remesh(data_of(sack), {.edge = 0.2});
  EXPECT_THAT(mended, IsEmpty());
  EXPECT_GT(coarse.mesh.n_border_edges(), 20);
  for (std::size_t e = 0; e < coarse.mesh.vertices_of_edge().size(); ++e)
    if (coarse.mesh.faces_of_edge()[e][1] < 0)
      for (int v : coarse.mesh.vertices_of_edge()[e]) {
        EXPECT_NEAR(coarse.positions[v].z, 0, 1e-12);
        EXPECT_NEAR(std::hypot(coarse.positions[v].x, coarse.positions[v].y), 1, 0.003);
      }
}

TEST(Remesh, TakesCrossingsAway) {
  // A cap pushed through the other side.
  auto data = data_of(make_icosphere(12, 1.0));
  for (Vec3& x : data.positions)
    if (x.z > 0.97) x.z = -1.15;
  const auto [surface, mended] = remesh(data, {.edge = 0.15});
  EXPECT_FALSE(find_self_crossing({surface.mesh, surface.positions}, 1e-12));
  EXPECT_TRUE(surface.mesh.is_closed());
  EXPECT_EQ(describe(surface).euler_characteristic, 2);
  EXPECT_GT(describe(surface).angle_min, 25);
  ASSERT_EQ(mended.size(), 1u);
  EXPECT_THAT(mended[0], HasSubstr("crossings of the surface with itself were taken away"));
}

TEST(Remesh, RefusesCrossingsThatItCannotTakeAway) {
  auto data = data_of(make_plate(2, 2, 0.2));
  auto other = make_plate(1, 1, 0.2);
  for (Vec3& x : other.positions) x = {x.x, 0.03, x.y};
  add(data, other, {});
  try {
    remesh(data, {.edge = 0.15});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("scan: the surface crosses itself"));
    EXPECT_THAT(error.what(), HasSubstr("the first at ("));
  }
}

TEST(Remesh, IsTheSameBitForBitEachTime) {
  const auto data = torn_apart(data_of(make_icosphere(8, 1.0)));
  const auto first = remesh(data, {.edge = 0.2}), second = remesh(data, {.edge = 0.2});
  EXPECT_EQ(first.surface.positions, second.surface.positions);
}

TEST(Remesh, RefusesWhatMakesNoMesh) {
  EXPECT_THROW(remesh(data_of(make_icosphere(2, 1.0)), {.edge = 0}), InputError);
  EXPECT_THROW(remesh(data_of(make_icosphere(2, 1.0)), {.edge = 1e-6}), InputError);
  EXPECT_THROW(remesh({"empty", {}, {}, {}, {}}, {.edge = 1}), InputError);
}

}  // namespace
}  // namespace pliant
