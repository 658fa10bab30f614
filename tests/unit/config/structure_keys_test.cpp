#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case_text.hpp"
#include "config/print_case.hpp"

namespace pliant::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// A deformable plate; `more` begins on line 7.
std::string sheet(const std::string& more) {
  return "box.size = [8, 8, 8]\n[[body]]\nname = \"flag\"\nmotion = \"deformable\"\ncoupling = \"one-way\"\n"
         "surface = { shape = \"plate\" }\n" +
         more;
}

constexpr auto flag = R"toml(thickness = 0.01
density = 2
young = 100
fibre = [1, 0, 0]
young_across = 50
pinned = ["pole", "tip"]
watch = ["ends"]
inner_damping = 0.5
potentials = { membrane = { law = "skalak", shear = 3, ratio = 10 }, pressure = { value = 2 } }
[body.selection.pole]
plane = { point = [-0.5, 0, 0], normal = [1, 0, 0] }
border = true
[body.selection]
tip = { sphere = { center = [0.5, 0, 0], radius = 0.2 } }
ends = { extreme = { direction = [0, 1, 0], fraction = 0.1 } }
[body.tether.hold]
selection = "pole"
stiffness = 4
[body.cord.stay]
from = "tip"
point = [2, 0, 0]
stiffness = 5
rest_fraction = 0.9
ends = "middle"
[body.cord.brace]
from = "tip"
to = "pole"
stiffness = 5
rest_length = 0.3
[body.pull.wind]
selection = "ends"
force = [0, 0, 1]
)toml";

TEST(StructureKeys, AreRead) {
  const auto body = read_text(sheet(flag)).bodies[0];
  EXPECT_EQ(body.material.young, 100);
  EXPECT_EQ(body.material.poisson, 1.0 / 3.0);
  EXPECT_EQ(body.material.young_across, 50);
  EXPECT_EQ(body.inner_damping, 0.5);
  EXPECT_FALSE(body.mass_per_vertex);
  EXPECT_THAT(body.pinned, ElementsAre("pole", "tip"));
  EXPECT_THAT(body.watch, ElementsAre("ends"));
  EXPECT_EQ(body.potentials.membrane->law, MembraneLaw::skalak);
  EXPECT_EQ(body.potentials.membrane->ratio, 10);
  EXPECT_EQ(body.potentials.pressure->value, 2);
  ASSERT_EQ(body.selections.size(), 3u);
  ASSERT_EQ(body.cords.size(), 2u);
  for (const auto& selection : body.selections) {
    if (selection.name == "pole") {
      EXPECT_TRUE(selection.border);
      EXPECT_EQ(selection.plane->side, PlaneSide::on);
      EXPECT_EQ(selection.plane->point, (Vec3{-0.5, 0, 0}));
      EXPECT_FALSE(selection.sphere);
    }
  }
  const auto& stay = body.cords[0].name == "stay" ? body.cords[0] : body.cords[1];
  EXPECT_EQ(stay.ends, CordEnds::middle);
  EXPECT_EQ(stay.rest_fraction, 0.9);
  EXPECT_EQ(body.tethers[0].selection, "pole");
  EXPECT_EQ(body.pulls[0].force, (Vec3{0, 0, 1}));
}

TEST(StructureKeys, PrintOutReadsBackAsTheSameCase) {
  const auto config = read_text(sheet(flag));
  EXPECT_EQ(resolved_case(read_text(to_toml(config))), resolved_case(config));
}

TEST(StructureKeys, CanBeOverridden) {
  const auto body =
      read_text(sheet(flag), {"body.flag.selection.tip.sphere.radius=0.3", "body.flag.pull.wind.force=[1,0,0]",
                              "body.flag.cord.stay.rest_length=1", "body.flag.mass_per_vertex=2",
                              "body.flag.selection.rim={border=true}", "body.flag.pinned=[\"rim\"]"})
          .bodies[0];
  ASSERT_EQ(body.selections.size(), 4u);
  for (const auto& selection : body.selections) {
    if (selection.name == "tip") { EXPECT_EQ(selection.sphere->radius, 0.3); }
    EXPECT_EQ(selection.border, selection.name == "pole" || selection.name == "rim");
  }
  EXPECT_EQ(body.pulls[0].force, (Vec3{1, 0, 0}));
  for (const auto& cord : body.cords) EXPECT_EQ(cord.rest_length, cord.name == "stay" ? 1.0 : 0.3);
  EXPECT_EQ(body.mass_per_vertex, 2) << "and the density, which it excludes, is dropped";
  EXPECT_FALSE(body.material.density);
}

TEST(StructureKeys, ProblemsNameTheirKeyAndLine) {
  EXPECT_THAT(
      problems_of(sheet(R"(pinned = ["pole", 3]
[body.selection.a]
[body.selection.b]
shpere = { center = [0, 0, 0], radius = 1 }
[body.selection.c]
sphere = { radius = -1 }
[body.tether.t]
selection = "d"
[body.cord.c]
from = "c"
stiffness = 1
[body.pull]
p = 3
)")),
      UnorderedElementsAre(
          AllOf(HasSubstr("case.toml:7: body.flag.pinned entry 2 must be a string")),
          AllOf(HasSubstr("case.toml:8: body.flag.selection.a selects nothing")),
          AllOf(HasSubstr("case.toml:10: unknown key body.flag.selection.b.shpere"), HasSubstr(".sphere")),
          AllOf(HasSubstr("body.flag.selection.b selects nothing")),
          AllOf(HasSubstr("case.toml:12: body.flag.selection.c.sphere.radius must be > 0")),
          AllOf(HasSubstr("body.flag.selection.c.sphere.center is missing")),
          AllOf(HasSubstr("case.toml:14: body.flag.tether.t.selection names \"d\""), HasSubstr("\"a\", \"b\", \"c\"")),
          AllOf(HasSubstr("body.flag.tether.t.stiffness is missing")),
          AllOf(HasSubstr("case.toml:15: body.flag.cord.c has one end only")),
          AllOf(HasSubstr("case.toml:19: body.flag.pull.p must be a table"))));
}

TEST(StructureKeys, MaterialIsConsistent) {
  EXPECT_THAT(problems_of(sheet("young = 1")), ElementsAre(HasSubstr("case.toml:7: body.flag.young is the modulus")));
  EXPECT_THAT(problems_of(sheet("density = 1")),
              ElementsAre(HasSubstr("case.toml:7: body.flag.density has no effect")));
  EXPECT_THAT(problems_of(sheet("thickness = 0.1\ndensity = 1\nmass_per_vertex = 1")),
              ElementsAre(AllOf(HasSubstr("mass_per_vertex"), HasSubstr("exclude each other"))));
  EXPECT_THAT(problems_of(sheet("thickness = 0.1\nmass_per_vertex = 1\nyoung = 3")), IsEmpty());
  EXPECT_THAT(problems_of(sheet("mass_per_vertex = 0")),
              ElementsAre(HasSubstr("case.toml:7: body.flag.mass_per_vertex is 0")));
  EXPECT_THAT(problems_of(sheet("fibre = [1, 0, 0]")), ElementsAre(HasSubstr("case.toml:7: body.flag.fibre directs")));
  EXPECT_THAT(
      problems_of(sheet("thickness = 0.1\nyoung = 6\nyoung_across = 1\nfibre = [1, 0, 0]")),
      ElementsAre(AllOf(HasSubstr("case.toml:9: body.flag.young_across"), HasSubstr("6 times as stiff along"))));
  EXPECT_THAT(problems_of(sheet("potentials.pressure.value = 1")),
              ElementsAre(HasSubstr("case.toml:7: body.flag.potentials.pressure")));
}

TEST(StructureKeys, BelongToDeformableBodies) {
  EXPECT_THAT(problems_of("box.size = [8, 8, 8]\n[[body]]\nname = \"a\"\nmotion = \"fixed\"\n"
                          "surface = { shape = \"plate\" }\n[body.selection.rim]\nborder = true\n"),
              ElementsAre(AllOf(HasSubstr("case.toml:6: body.a.selection.rim"), HasSubstr("\"fixed\""))));
  EXPECT_THAT(problems_of(sheet("[body.selection.rim]\nborder = true\n"), {"body.flag.motion=fixed"}), IsEmpty());
  EXPECT_THAT(problems_of("box.size = [8, 8, 8]\n[[body]]\nname = \"a\"\nmotion = \"deformable\"\n"
                          "coupling = \"one-way\"\nsurface = { shape = \"sphere\" }\n[body.selection.rim]\n"
                          "border = true\n"),
              ElementsAre(AllOf(HasSubstr("case.toml:7: body.a.selection.rim"), HasSubstr("closed"))));
}

}  // namespace
}  // namespace pliant::test
