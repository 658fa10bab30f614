#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case_text.hpp"
#include "config/print_case.hpp"

namespace pliant {
namespace {
using test::problems_of;
using test::read_text;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string body_with(const std::string& surface, const std::string& more = "") {
  return "box.size = [8, 8, 8]\n[[body]]\nname = \"a\"\ncoupling = \"one-way\"\nsurface = { " + surface + " }\n" + more;
}
template <class Shape>
Shape shape_of(const std::string& surface) {
  return std::get<Shape>(read_text(body_with(surface)).bodies[0].surface);
}

TEST(SurfaceKeys, MakeEveryShape) {
  EXPECT_EQ(shape_of<EllipsoidSurface>("shape = \"ellipsoid\", semi_axes = [1, 2, 3], frequency = 5").semi_axes,
            (Vec3{1, 2, 3}));
  EXPECT_EQ(shape_of<RedCellSurface>("shape = \"red-cell\", radius = 3.91, frequency = 5").radius, 3.91);
  EXPECT_EQ(shape_of<PlateSurface>("shape = \"plate\", size = [2, 1], edge = 0.2").size[0], 2);
  EXPECT_EQ(shape_of<DiscSurface>("shape = \"disc\", diameter = 3, edge = 0.2").radius, 1.5);
  EXPECT_EQ(shape_of<HalfDiscSurface>("shape = \"half-disc\", radius = 2, edge = 0.2").edge, 0.2);
  const auto tube = shape_of<CylinderSurface>("shape = \"cylinder\", radius = 2, height = 3, ends = \"open\"");
  EXPECT_EQ(tube.height, 3);
  EXPECT_EQ(tube.ends, CylinderEnds::open);
  EXPECT_EQ(shape_of<BoxSurface>("shape = \"box\", size = [1, 2, 3], edge = 0.3").size, (Vec3{1, 2, 3}));
  EXPECT_TRUE(shape_of<FileSurface>("file = \"leaf.gts\", open = true").open);
  EXPECT_FALSE(shape_of<FileSurface>("file = \"leaf.gts\"").open);
}

TEST(SurfaceKeys, TheResolvedPrintOutReadsBack) {
  for (const char* surface :
       {"shape = \"sphere\"", "shape = \"ellipsoid\", semi_axes = [1, 2, 3]", "shape = \"plate\", size = [2, 1]",
        "shape = \"disc\"", "shape = \"half-disc\"", "shape = \"cylinder\", ends = \"open\"", "shape = \"box\"",
        "file = \"leaf.gts\", open = true"})
    for (const char* more : {"center = [1, 2, 3]\nrotation = { axis = [1, 0, 0], angle = 30 }\n",
                             "count = 5\nseed = 7\ngap = 0.1\norientation = \"random\"\nregion = { lower = [0, 1, 2], "
                             "upper = [4, 5, 6] }\n",
                             "positions = \"places.csv\"\n"}) {
      const auto config = read_text(body_with(surface, more));
      const auto again = read_text(to_toml(config));
      EXPECT_EQ(resolved_case(config), resolved_case(again)) << to_toml(config);
    }
}

TEST(SurfaceKeys, SayWhichSurfacesAreOpen) {
  EXPECT_FALSE(is_open_surface(SphereSurface{}));
  EXPECT_FALSE(is_open_surface(BoxSurface{}));
  EXPECT_FALSE(is_open_surface(CylinderSurface{}));
  EXPECT_TRUE(is_open_surface(CylinderSurface{1, 1, 0.1, CylinderEnds::open}));
  EXPECT_TRUE(is_open_surface(PlateSurface{}));
  EXPECT_TRUE(is_open_surface(DiscSurface{}));
  EXPECT_TRUE(is_open_surface(HalfDiscSurface{}));
  EXPECT_FALSE(is_open_surface(FileSurface{"a.gts", 1.0}));
  EXPECT_TRUE(is_open_surface(FileSurface{"a.gts", 1.0, true}));
}

TEST(SurfaceKeys, BelongToTheirShapes) {
  EXPECT_THAT(problems_of(body_with("shape = \"plate\", radius = 1")),
              ElementsAre(AllOf(HasSubstr("surface.radius has no effect"), HasSubstr("\"half-disc\""))));
  EXPECT_THAT(problems_of(body_with("file = \"a.gts\", edge = 1")), ElementsAre(HasSubstr("exclude each other")));
  EXPECT_THAT(problems_of(body_with("shape = \"disc\", open = true")), ElementsAre(HasSubstr("surface.open has no")));
  EXPECT_THAT(problems_of(body_with("shape = \"box\", size = [1, 2]")), ElementsAre(HasSubstr("surface.size must be")));
  EXPECT_THAT(problems_of(body_with("shape = \"plate\", size = [1, -2]")),
              ElementsAre(HasSubstr("surface.size component y must be > 0")));
  EXPECT_THAT(problems_of(body_with("shape = \"plate\"", "potentials.volume = { stiffness = 1 }")),
              ElementsAre(HasSubstr("surface is open")));
}

TEST(PlacementKeys, GoTogetherAsTheyShould) {
  const std::string sphere = "shape = \"sphere\", radius = 0.1";
  EXPECT_THAT(problems_of(body_with(sphere, "count = 3\nregion.upper = [4, 4, 4]\n")), IsEmpty());
  EXPECT_THAT(problems_of(body_with(sphere, "count = 3\nregion.upper = [4, 0, 9]\n")),
              ElementsAre(HasSubstr("reaches from 0 to 0 along y"), HasSubstr("is 9 long along z")));
  EXPECT_THAT(problems_of(body_with(sphere, "seed = 3\n")), ElementsAre(HasSubstr("seed has no effect")));
  EXPECT_THAT(problems_of(body_with(sphere, "positions = \"a.csv\"\ngap = 1\n")),
              ElementsAre(HasSubstr("gap has no effect")));
  EXPECT_THAT(problems_of(body_with(sphere, "rotation.axis = [0, 0, 0]\n")),
              ElementsAre(HasSubstr("rotation.axis must not be 0")));
}

}  // namespace
}  // namespace pliant
