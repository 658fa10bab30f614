#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/patch_geometry.hpp"
#include "config/print_case.hpp"
#include "unit/config/case_text.hpp"

namespace pliant::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr auto ventricle = R"toml(
[box]
size = [4, 4, 2]
origin = [-2, -2, 0]
cells = [40, 40, 10]
[signals.mitral]
table = [[0, 0], [0.3, 1], [0.6, 0]]
period = 1.0
[signals]
beat = { formula = "sin(2*pi*t)", scale = 2 }
[boundary]
x = "wall"
y = "wall"
"z-" = "wall"
[boundary."z+"]
type = "wall"
patches = [
  { name = "mitral", shape = "disc", center = [0.6, 0.0], radius = 0.5, flow_rate = "mitral", phase = [0.0, 0.62], profile = "parabolic" },
  { name = "aorta", shape = "rectangle", center = [-0.7, 0.0], size = [0.6, 0.8], flow_rate = "mitral", phase = [0.62, 1.0] },
  { name = "tank", shape = "outside", radius = 1.6, balance = true },
]
)toml";

/// A case with this list of patches on z+.
std::string with_patches(const std::string& patches,
                         const std::string& others = "x = \"wall\"\ny = \"wall\"\n\"z-\" = \"wall\"\n") {
  return "[box]\nsize = [4, 4, 2]\norigin = [-2, -2, 0]\ncells = [40, 40, 10]\n[boundary]\n" + others +
         "\"z+\" = { type = \"wall\", patches = [" + patches + "] }\n";
}
const std::string balance = "{ name = \"out\", radius = 0.5, balance = true }";
std::string disc(const std::string& name, const std::string& rest) {
  return "{ name = \"" + name + "\", flow_rate = \"1\", " + rest + " }, ";
}

TEST(Patches, AreReadWithTheirSignals) {
  const auto config = read_text(ventricle);
  ASSERT_EQ(config.signals.size(), 2u);
  EXPECT_EQ(config.signals.at("mitral").table[1], (std::array<double, 2>{0.3, 1}));
  EXPECT_EQ(config.signals.at("beat").scale, 2);
  const auto& patches = std::get<WallSide>(config.boundary[5]).patches;
  ASSERT_EQ(patches.size(), 3u);
  EXPECT_EQ(patches[0].profile, PatchProfile::parabolic);
  EXPECT_EQ(patches[0].phase, (std::array<double, 2>{0.0, 0.62}));
  EXPECT_EQ(patches[1].size, (std::array<double, 2>{0.6, 0.8}));
  EXPECT_EQ(patches[2].shape, PatchShape::outside);
  EXPECT_TRUE(patches[2].balance);
}

TEST(Patches, PrintOutReadsBackAsTheSameCase) {
  const auto config = read_text(ventricle);
  EXPECT_EQ(resolved_case(read_text(to_toml(config))), resolved_case(config));
}

TEST(Patches, CanBeOverridden) {
  const auto config = read_text(
      ventricle, {"boundary.z+.patches.mitral.radius=0.4", "signals.mitral.scale=3", "signals.beat.table=[[0, 1]]"});
  EXPECT_EQ(std::get<WallSide>(config.boundary[5]).patches[0].radius, 0.4);
  EXPECT_EQ(config.signals.at("mitral").scale, 3);
  EXPECT_EQ(config.signals.at("beat").formula, "");
  const auto bare = read_text(ventricle, {"boundary.z+.patches=[]"});
  EXPECT_THAT(std::get<WallSide>(bare.boundary[5]).patches, IsEmpty());
  EXPECT_THAT(problems_of(ventricle, {"boundary.z=periodic"}), IsEmpty());
  EXPECT_THAT(problems_of(ventricle, {"boundary.z+.patches.mitrl.radius=0.4"}),
              ElementsAre(AllOf(HasSubstr("no such patch"), HasSubstr("boundary.z+.patches.mitral"))));
  EXPECT_THAT(problems_of(ventricle, {"boundary.z+.patches.mitral.radios=0.4"}), ElementsAre(HasSubstr("unknown key")));
}

TEST(Patches, ProblemsNameTheirKeyAndLine) {
  const auto problems = problems_of(R"([box]
size = [4, 4, 2]
[signals.mitral]
[signals.beat]
formula = "t"
table = [[0, 1]]
perod = 1
[boundary]
x = "wall"
"z-" = "wall"
[boundary."z+"]
type = "wall"
patches = [
  { shape = "disc" },
  { name = "a", shape = "disk" },
  { name = "b", radius = -1, phase = [0, 2], flow_rate = "1" },
  { name = "c", shape = "rectangle", size = [1, 1], radius = 1, balance = true },
  3,
]
)");
  EXPECT_THAT(problems,
              UnorderedElementsAre(
                  AllOf(HasSubstr("case.toml:3: signals.mitral has no values")),
                  AllOf(HasSubstr("case.toml:5: signals.beat.formula and table"), HasSubstr("case.toml:6")),
                  AllOf(HasSubstr("case.toml:7: unknown key signals.beat.perod"), HasSubstr("signals.beat.period")),
                  AllOf(HasSubstr("case.toml:14: boundary.z+.patches[0].name is missing")),
                  AllOf(HasSubstr("case.toml:15: boundary.z+.patches.a.shape"), HasSubstr("annulus")),
                  AllOf(HasSubstr("case.toml:16: boundary.z+.patches.b.radius must be > 0")),
                  AllOf(HasSubstr("case.toml:16: boundary.z+.patches.b.phase second number")),
                  AllOf(HasSubstr("case.toml:17: boundary.z+.patches.c.radius has no effect")),
                  AllOf(HasSubstr("case.toml:18: boundary.z+.patches[4] must be a table"))));
}

TEST(Patches, NeedOneThatBalances) {
  EXPECT_THAT(problems_of(with_patches(disc("in", "radius = 0.5"))),
              ElementsAre(AllOf(HasSubstr("boundary.z+.patches.in"), HasSubstr("nothing lets it out"))));
  EXPECT_THAT(
      problems_of(with_patches(disc("in", "radius = 0.5"), "x = \"outflow\"\ny = \"wall\"\n\"z-\" = \"wall\"\n")),
      IsEmpty());
  const std::string one = "{ name = \"a\", center = [1, 1], radius = 0.5, balance = true }";
  EXPECT_THAT(problems_of(with_patches(balance + "," + one)),
              ElementsAre(AllOf(HasSubstr("patches.a.balance"), HasSubstr("only one"))));
  EXPECT_THAT(problems_of(with_patches(balance, "x = \"outflow\"\ny = \"wall\"\n\"z-\" = \"wall\"\n")),
              ElementsAre(AllOf(HasSubstr("patches.out.balance"), HasSubstr("outflow side"))));
  EXPECT_THAT(problems_of(with_patches(
                  balance, "x = \"wall\"\ny = \"wall\"\n\"z-\" = { type = \"inflow\", velocity = [0, 0, 1] }\n")),
              IsEmpty());
}

TEST(Patches, AreRefusedWhereTheyCannotBe) {
  const auto problem = [](const std::string& rest) { return problems_of(with_patches(disc("in", rest) + balance)); };
  EXPECT_THAT(problem("center = [1, 1], radius = 0.5"), IsEmpty());
  EXPECT_THAT(problem("center = [0.8, 0], radius = 0.5"),
              ElementsAre(AllOf(HasSubstr("overlaps"), HasSubstr("patches.out"))));
  EXPECT_THAT(problem("center = [1.6, 1], radius = 0.5"),
              ElementsAre(AllOf(HasSubstr("patches.in"), HasSubstr("beyond the side"))));
  EXPECT_THAT(problem("center = [1, 1], radius = 0.05"), ElementsAre(HasSubstr("needs at least 4")));
  EXPECT_THAT(problem("center = [1, 1]"), ElementsAre(HasSubstr("patches.in has no radius")));
  EXPECT_THAT(problem("shape = \"annulus\", radius = 1, inner_radius = 1.1"),
              ElementsAre(HasSubstr("not less than the radius")));
  EXPECT_THAT(problem("shape = \"annulus\", radius = 1.05, inner_radius = 1"),
              ElementsAre(HasSubstr("less than a cell")));
  EXPECT_THAT(problem("shape = \"annulus\", radius = 1"), ElementsAre(HasSubstr("inner_radius")));
  EXPECT_THAT(problem("shape = \"annulus\", radius = 1, inner_radius = 0.5"), IsEmpty()) << "they touch";
  EXPECT_THAT(problem("shape = \"rectangle\", center = [1, 1], size = [0.5, 0.05]"), ElementsAre(HasSubstr("along y")));
  EXPECT_THAT(problem("shape = \"rectangle\", center = [1, 1]"), ElementsAre(HasSubstr("no size")));
  EXPECT_THAT(problem("shape = \"outside\", profile = \"parabolic\""), ElementsAre(HasSubstr("profile")));
  EXPECT_THAT(problem("shape = \"outside\", radius = 0.3"), ElementsAre(HasSubstr("overlaps")));
  EXPECT_THAT(problem("shape = \"outside\", radius = 2.9"), ElementsAre(HasSubstr("covers 0 faces")));
  EXPECT_THAT(problem("center = [1, 1], radius = 0.5, phase = [0.5, 0.2]"),
              ElementsAre(HasSubstr("must end after it begins")));
  EXPECT_THAT(problems_of(with_patches("{ name = \"in\", center = [1, 1], radius = 0.5 }, " + balance)),
              ElementsAre(HasSubstr("has no flow_rate")));
  EXPECT_THAT(problems_of(with_patches(disc("out", "center = [1, 1], radius = 0.5") + balance)),
              ElementsAre(HasSubstr("name of another patch")));
  EXPECT_THAT(problems_of(with_patches(disc("a b", "center = [1, 1], radius = 0.5") + balance)),
              ElementsAre(HasSubstr("letters, digits")));
}

TEST(Patches, LieOnWallsOfZ) {
  const auto on = [](const std::string& side, const std::string& type) {
    return problems_of("[boundary]\nz = \"wall\"\n\"" + side + "\" = { type = \"" + type + "\", patches = [" + balance +
                       "] }\n");
  };
  EXPECT_THAT(on("x", "wall"), testing::Contains(AllOf(HasSubstr("boundary.x-"), HasSubstr("only the sides \"z-\""))));
  EXPECT_THAT(
      problems_of(
          "[box]\norigin = [-0.5, -0.5, 0]\n[boundary]\n\"z-\" = \"wall\"\n\"z+\" = { type = \"outflow\", patches = [" +
          disc("in", "radius = 0.3") + "] }\n"),
      ElementsAre(AllOf(HasSubstr("boundary.z+.patches.in"), HasSubstr("type \"outflow\""))));
}

TEST(PatchGeometry, ShapesThatTouchShareTheFacesOut) {
  PatchPlane plane{{-1, -1}, {2, 2}, {20, 20}, {false, false}};
  PatchConfig inner, ring, rest;
  inner.radius = 0.5;
  ring.shape = PatchShape::annulus;
  ring.inner_radius = 0.5;
  ring.radius = 0.8;
  rest.shape = PatchShape::outside;
  rest.radius = 0.8;
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 20; ++i) {
      const auto at = plane.face_center(i, j);
      EXPECT_EQ(is_in_shape(inner, plane, at) + is_in_shape(ring, plane, at) + is_in_shape(rest, plane, at), 1);
    }
}

TEST(PatchGeometry, RectanglesOnGridLinesCoverTheirOwnArea) {
  const PatchPlane plane{{-1, -1}, {2, 2}, {20, 20}, {false, false}};
  PatchConfig patch;
  patch.shape = PatchShape::rectangle;
  for (double center : {0.0, 0.1, 0.05, -0.35}) {
    patch.center = {center, 0};
    patch.size = {0.6, 2};
    const auto owners = patch_of_faces({patch}, plane);
    EXPECT_EQ(std::count(owners.begin(), owners.end(), 0), 6 * 20) << center;
  }
}

TEST(PatchGeometry, GoesOnAcrossPeriodicEdges) {
  const PatchPlane plane{{0, 0}, {2, 2}, {20, 20}, {true, false}};
  PatchConfig patch;
  patch.radius = 0.5;
  patch.center = {0, 1};
  EXPECT_TRUE(is_in_shape(patch, plane, {1.9, 1}));
  EXPECT_FALSE(is_in_shape(patch, plane, {1, 1}));
}

}  // namespace
}  // namespace pliant::test
