#include "structure/overlap.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/error.hpp"
#include "mesh/read_surface.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "structure/load_surface.hpp"
#include "unit/io/temporary_folder.hpp"

namespace pliant {
namespace {
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

CaseConfig empty_case() {
  CaseConfig config;
  config.box.size = {4, 4, 4};
  config.file = "case.toml";
  return config;
}

BodyConfig body(const std::string& name, const SurfaceSpec& surface, Vec3 center) {
  BodyConfig config;
  config.name = name;
  config.surface = surface;
  config.center = center;
  return config;
}

std::vector<std::string> overlaps(const CaseConfig& config) { return find_overlaps(config, place_bodies(config)); }

TEST(Overlap, NamesBothBodiesAndThePlace) {
  auto config = empty_case();
  config.bodies = {body("a", SphereSurface{4, 0.5}, {1, 1, 1}), body("b", SphereSurface{4, 0.5}, {1.9, 1, 1}),
                   body("c", SphereSurface{4, 0.5}, {1, 3, 1})};
  EXPECT_THAT(overlaps(config),
              ElementsAre(AllOf(HasSubstr("body.a and case.toml: body.b overlap at the start"), HasSubstr("(1.4"))));
  config.bodies[1].center.x = 2.01;
  EXPECT_THAT(overlaps(config), IsEmpty());
}

TEST(Overlap, SeesThroughPeriodicSidesOnly) {
  auto config = empty_case();
  config.bodies = {body("a", SphereSurface{4, 0.5}, {0.6, 1, 1}), body("b", SphereSurface{4, 0.5}, {3.5, 1, 1})};
  EXPECT_THAT(overlaps(config), IsEmpty());
  config.bodies[0].center.x = 0.4;
  EXPECT_THAT(overlaps(config), ElementsAre(HasSubstr("overlap")));
  config.bodies[0].center.x = 0.4 + 40;  // ten boxes away is the same place
  EXPECT_THAT(overlaps(config), ElementsAre(HasSubstr("overlap")));
  config.bodies[0].center.x = 0.4;
  config.boundary[0] = config.boundary[1] = WallSide{};
  EXPECT_THAT(overlaps(config), IsEmpty());
}

TEST(Overlap, FindsOneInsideTheOtherAndBothInOnePlace) {
  auto config = empty_case();
  config.bodies = {body("small", SphereSurface{4, 0.2}, {2, 2, 2}), body("large", SphereSurface{8, 1.5}, {2, 2.5, 2})};
  EXPECT_THAT(overlaps(config), ElementsAre(HasSubstr("body.small lies inside case.toml: body.large")));
  config.bodies[0] = body("leaf", PlateSurface{{0.5, 0.3}, 0.1}, {2, 2, 2});
  EXPECT_THAT(overlaps(config), ElementsAre(HasSubstr("body.leaf lies inside")));
  config.bodies[0] = config.bodies[1];
  config.bodies[0].name = "twin";
  EXPECT_EQ(overlaps(config).size(), 1u);
  config.bodies = {body("leaf", PlateSurface{{0.5, 0.3}, 0.1}, {2, 2, 2}),
                   body("twin", PlateSurface{{0.5, 0.3}, 0.1}, {2, 2, 2})};
  EXPECT_EQ(overlaps(config).size(), 1u);
}

TEST(Overlap, LeavesBodiesAloneThatTouchOrShareABall) {
  auto config = empty_case();
  config.bodies = {body("a", BoxSurface{{1, 1, 1}, 0.3}, {1, 1, 1}), body("b", BoxSurface{{1, 1, 1}, 0.3}, {2, 1, 1}),
                   body("c", BoxSurface{{1, 1, 1}, 0.4}, {1, 2, 1}),
                   body("leaf", HalfDiscSurface{0.4, 0.1}, {1.5, 2.7, 1})};
  EXPECT_THAT(overlaps(config), IsEmpty());
  // A disc that just fills the end of a tube with the same circle, and a plate that stands on another.
  config.bodies = {body("tube", CylinderSurface{1, 3, 0.2, CylinderEnds::open}, {2, 2, 2}),
                   body("lid", DiscSurface{1, 0.2}, {2, 2, 0.5})};
  EXPECT_THAT(overlaps(config), IsEmpty());
  config.bodies = {body("floor", PlateSurface{{2, 2}, 0.3}, {2, 2, 2}),
                   body("leaf", PlateSurface{{0.5, 0.4}, 0.1}, {2, 2, 2.2})};
  config.bodies[1].rotation = {{1, 0, 0}, 90};
  EXPECT_THAT(overlaps(config), IsEmpty());
  config.bodies[1].center.z = 2.19;
  EXPECT_EQ(overlaps(config).size(), 1u);
  // In a tube, and through its end: inside its bounding ball, but not inside.
  config.bodies = {body("tube", CylinderSurface{1, 3, 0.2, CylinderEnds::open}, {2, 2, 2}),
                   body("core", SphereSurface{4, 0.8}, {2, 2, 2})};
  EXPECT_THAT(overlaps(config), IsEmpty());
  config.bodies[1].center.x = 2.3;
  EXPECT_THAT(overlaps(config), ElementsAre(HasSubstr("overlap")));
}

TEST(Overlap, FindsAlignedBoxesWithSidesInCommonPlanes) {
  auto config = empty_case();
  for (const double shift : {0.5, 0.3, 0.01, -0.5}) {
    config.bodies = {body("a", BoxSurface{{1, 1, 1}, 0.25}, {2, 2, 2}),
                     body("b", BoxSurface{{1, 1, 1}, 0.25}, {2 + shift, 2, 2})};
    EXPECT_EQ(overlaps(config).size(), 1u) << shift;
  }
}

/// The parts of a left ventricle about their common plate.
std::vector<BodyConfig> heart() {
  const Vec3 mitral{1.4, 2, 3}, aortic{2.65, 2, 3};
  return {body("plate", PlateWithHolesSurface{{4, 4}, {{-0.6, 0, 0.5}, {0.65, 0, 0.35}}, 0.2, 0.1}, {2, 2, 3}),
          body("sack", VentricleSurface{1.32, 2.5, 0.2, 0}, {2, 2, 3}),
          body("inlet", ChannelSurface{0.5, 0.6, 0.1}, mitral), body("outlet", ChannelSurface{0.35, 0.6, 0.1}, aortic),
          body("valve", NaturalValveSurface{.radius = 0.5, .edge = 0.1}, mitral)};
}

TEST(Overlap, LeavesPartsAloneThatShareABorderOrStandOnAPlate) {
  auto config = empty_case();
  config.bodies = heart();
  EXPECT_THAT(overlaps(config), IsEmpty());
  // The plate may be higher than round-off allows, as of a file with six digits.
  config.bodies[1].center.z -= 1e-7;
  EXPECT_THAT(overlaps(config), IsEmpty());
}

TEST(Overlap, DrawsTheFacesOfAValveThatDoesNotFit) {
  auto config = empty_case();
  config.bodies = heart();
  std::get<NaturalValveSurface>(config.bodies[4].surface).radius = 0.56;
  config.bodies[4].center.z += 0.05;  // its annulus in the channel, which is too narrow for it
  SurfaceData picture;
  const auto problems = find_overlaps(config, place_bodies(config), 20, &picture);
  EXPECT_THAT(problems, ElementsAre(AllOf(HasSubstr("body.plate"), HasSubstr("body.valve overlap")),
                                    AllOf(HasSubstr("body.inlet"), HasSubstr("body.valve overlap"))));
  ASSERT_FALSE(picture.faces.empty());
  // All of them lie about the annulus, and they can be written.
  for (const Vec3 x : picture.positions) EXPECT_LT(norm(x - config.bodies[4].center), 0.9);
  EXPECT_LT(picture.faces.size(), 400u);
  const TemporaryFolder folder;
  const int n = static_cast<int>(picture.positions.size());
  write_surface(folder.path() / "picture.ply", {TriangleMesh(n, picture.faces), picture.positions});
}

TEST(Overlap, DrawsWhereASurfaceCrossesItself) {
  const TemporaryFolder folder;
  // Two sheets through each other, in one file.
  const std::vector<Vec3> places{{0, 0, -1},   {1, 0, 1}, {-1, 0, 1}, {0, -1, 0}, {0.5, 2, 0},
                                 {-0.5, 2, 0}, {5, 0, 0}, {6, 0, 0},  {5, 1, 0}};
  write_surface(folder.path() / "crossed.gts", {TriangleMesh(9, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}), places});
  auto config = empty_case();
  config.box.size = {20, 20, 20};
  config.folder = folder.path();
  config.bodies = {body("a", FileSurface{"crossed.gts", 1, true}, {10, 10, 10})};
  SurfaceData picture;
  const auto problems = find_overlaps(config, place_bodies(config), 20, &picture);
  EXPECT_THAT(problems, ElementsAre(HasSubstr("crosses itself")));
  EXPECT_EQ(picture.faces.size(), 2u);
  EXPECT_EQ(picture.positions[0], places[0] + config.bodies[0].center);
}

TEST(Overlap, LooksAtAHingedBodyAtTheAngleItBeginsWith) {
  auto config = empty_case();
  auto leaf = body("leaf", PlateSurface{{1, 1}, 0.25}, {2, 2, 2});
  leaf.motion = MotionKind::hinge;
  leaf.hinge.point = {1.5, 2, 2};
  leaf.hinge.axis = {0, 1, 0};
  // A ball at the free edge of the plate as it lies, one below where it hangs.
  config.bodies = {leaf, body("ahead", SphereSurface{4, 0.2}, {2.5, 2, 2}),
                   body("below", SphereSurface{4, 0.2}, {1.5, 2, 1})};
  EXPECT_THAT(overlaps(config), ElementsAre(AllOf(HasSubstr("body.leaf and"), HasSubstr("body.ahead"))));
  config.bodies[0].hinge.angle = 90;
  EXPECT_THAT(overlaps(config), ElementsAre(AllOf(HasSubstr("body.leaf and"), HasSubstr("body.below"))));
  config.bodies[0].hinge.angle = 45;
  EXPECT_THAT(overlaps(config), IsEmpty());
}

TEST(Overlap, LeavesRandomCopiesAlone) {
  auto config = empty_case();
  config.boundary[4] = config.boundary[5] = FreeSlipSide{};
  config.bodies = {body("a", SphereSurface{4, 0.1}, {}), body("rod", EllipsoidSurface{4, {0.2, 0.1, 0.05}}, {}),
                   body("plate", PlateSurface{{3, 3}, 0.2}, {2, 2, 2})};
  config.bodies[0].placement.count = 2000;
  config.bodies[1].placement.count = 100;
  config.bodies[1].placement.orientation = OrientationKind::random;
  config.bodies[2].rotation = {{1, 0, 0}, 40};
  EXPECT_THAT(overlaps(config), IsEmpty());
}

TEST(Overlap, CountsTheRest) {
  const TemporaryFolder folder;
  std::ofstream file(folder.path() / "places.csv");
  for (int i = 0; i < 40; ++i) file << 0.1 * i << ",1,1\n";
  file.close();
  auto config = empty_case();
  config.folder = folder.path();
  config.bodies = {body("a", SphereSurface{2, 0.06}, {})};
  config.bodies[0].placement.positions = "places.csv";
  const auto problems = overlaps(config);  // a closed chain of 40 across the periodic side
  ASSERT_EQ(problems.size(), 21u);
  EXPECT_THAT(problems[0], AllOf(HasSubstr("body.a-0001"), HasSubstr("body.a-0002"), HasSubstr("file of positions")));
  EXPECT_THAT(problems[20], HasSubstr("20 more"));
}

TEST(LoadShape, KeepsTheSelectionsOfAShapeThroughItsFile) {
  const TemporaryFolder folder;
  const auto made = load_shape(body("a", VentricleSurface{1.32, 3.52, 0.3, 0}, {}), folder.path());
  write_surface(folder.path() / "sack.gts", made);
  const auto read = load_shape(body("a", FileSurface{"sack.gts", 1.0, true}, {}), folder.path());
  EXPECT_EQ(read.positions, made.positions);
  ASSERT_EQ(read.selections.size(), made.selections.size());
  for (std::size_t i = 0; i < made.selections.size(); ++i) {
    EXPECT_EQ(read.selections[i].name, made.selections[i].name);
    EXPECT_EQ(read.selections[i].vertices, made.selections[i].vertices);
  }
}

TEST(LoadShape, BringsTheSelectionsThatTheCaseIsToldOf) {
  for (const SurfaceSpec& surface :
       {SurfaceSpec(ChannelSurface{}), SurfaceSpec(VentricleSurface{}), SurfaceSpec(MechanicalLeafletSurface{}),
        SurfaceSpec(PlateWithHolesSurface{{2, 2}, {{0.5, 0, 0.3}, {-0.5, 0, 0.2}}}), SurfaceSpec(NaturalValveSurface{}),
        SurfaceSpec(NaturalValveSurface{.leaflet = ValveLeaflet::anterior}),
        SurfaceSpec(NaturalValveSurface{.leaflet = ValveLeaflet::posterior}), SurfaceSpec(SphereSurface{})}) {
    const auto shape = load_shape(body("a", surface, {}), ".");
    std::vector<std::string> brought;
    for (const auto& selection : shape.selections) brought.push_back(selection.name);
    EXPECT_THAT(brought, testing::UnorderedElementsAreArray(selections_of_shape(surface)));
    EXPECT_EQ(is_open_surface(surface), !shape.mesh.is_closed());
  }
}

TEST(LoadShape, TakesOpenAndClosedFilesAsTheyAreAnnounced) {
  const TemporaryFolder folder;
  const auto load = [&](bool open) {
    auto config = body("a", FileSurface{"surface.ply", 2.0, open}, {});
    return load_shape(config, folder.path());
  };
  auto sphere = make_icosphere(2, 1.0);
  write_surface(folder.path() / "surface.ply", sphere);
  EXPECT_NEAR(norm(load(false).positions[0]), 2, 1e-14);
  EXPECT_THROW(load(true), InputError);
  std::vector<Face> faces(sphere.mesh.vertices_of_face().begin(), sphere.mesh.vertices_of_face().end());
  auto open = faces;
  open.pop_back();
  write_surface(folder.path() / "surface.ply", {TriangleMesh(sphere.mesh.n_vertices(), open), sphere.positions});
  EXPECT_EQ(load(true).mesh.n_border_edges(), 3);
  try {
    load(false);
    FAIL();
  } catch (const InputError& error) { EXPECT_THAT(error.what(), HasSubstr("surface.open = true")); }
}

TEST(LoadShape, RefusesAClosedSurfaceInTwoPieces) {
  const TemporaryFolder folder;
  const auto sphere = make_icosphere(2, 1.0);
  auto positions = sphere.positions;
  std::vector<Face> faces(sphere.mesh.vertices_of_face().begin(), sphere.mesh.vertices_of_face().end());
  const int n = sphere.mesh.n_vertices();
  for (const Vec3 x : sphere.positions) positions.push_back(x + Vec3{3, 0, 0});
  for (const Face& face : sphere.mesh.vertices_of_face()) faces.push_back({face[0] + n, face[1] + n, face[2] + n});
  write_surface(folder.path() / "pair.gts", {TriangleMesh(2 * n, faces), positions});
  try {
    load_shape(body("a", FileSurface{"pair.gts"}, {}), folder.path());
    FAIL();
  } catch (const InputError& error) { EXPECT_THAT(error.what(), HasSubstr("2 closed pieces")); }
}

TEST(Overlap, FindsAFileThatCrossesItself) {
  const TemporaryFolder folder;
  auto sphere = make_icosphere(6, 1.0);
  for (Vec3& x : sphere.positions)
    if (x.z > 0.8) x.z -= 2.5;  // the cap is pushed out through the other side
  write_surface(folder.path() / "surface.ply", sphere);
  auto config = empty_case();
  config.folder = folder.path();
  config.bodies = {body("a", FileSurface{"surface.ply", 0.5}, {2, 2, 2})};
  EXPECT_THAT(overlaps(config), ElementsAre(AllOf(HasSubstr("body.a"), HasSubstr("crosses itself"))));
}

}  // namespace
}  // namespace pliant
