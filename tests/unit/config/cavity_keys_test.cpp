#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/print_case.hpp"
#include "unit/config/case_text.hpp"

namespace pliant::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

constexpr auto heart = R"toml(
[box]
size = [4, 4, 4]
cells = [8, 8, 8]
[output]
period = 3.6
fields = { phases = [0.1, 0.3], vorticity = true }
surfaces = { every = 10, phases = [0] }
phase_average = { bins = 20, from = 3.6, every = 5 }
[signals]
beat = { formula = "sin(2*pi*t)", period = 1 }
[cavity.ventricle]
body = "sack"
flow = "beat"
flow_factor = -1
ejection_fraction = 0.3
jet = { origin = [2, 2, 3], threshold = 0.5 }
[cavity.atrium]
body = "sack"
period = 2
[[body]]
name = "sack"
surface = { shape = "sphere" }
center = [2, 2, 2]
)toml";

TEST(Cavities, AreReadAndPrinted) {
  const auto config = read_text(heart);
  EXPECT_EQ(config.output.period, 3.6);
  EXPECT_THAT(config.output.fields.phases, ElementsAre(0.1, 0.3));
  EXPECT_TRUE(config.output.fields.vorticity);
  EXPECT_THAT(config.output.surfaces.phases, ElementsAre(0));
  EXPECT_EQ(config.output.surfaces.every, 10);
  ASSERT_TRUE(config.output.phase_average);
  EXPECT_EQ(config.output.phase_average->bins, 20);
  EXPECT_EQ(config.output.phase_average->from, 3.6);
  EXPECT_EQ(config.output.phase_average->every, 5);
  ASSERT_EQ(config.cavities.size(), 2u);
  const auto& ventricle = config.cavities[config.cavities[0].name == "ventricle" ? 0 : 1];
  EXPECT_EQ(ventricle.body, "sack");
  EXPECT_EQ(ventricle.flow, "beat");
  EXPECT_EQ(ventricle.flow_factor, -1);
  EXPECT_EQ(ventricle.ejection_fraction, 0.3);
  ASSERT_TRUE(ventricle.jet);
  EXPECT_EQ(ventricle.jet->origin, (Vec3{2, 2, 3}));
  EXPECT_EQ(ventricle.jet->axis, (Vec3{0, 0, -1}));
  EXPECT_EQ(ventricle.jet->threshold, 0.5);
  EXPECT_EQ(resolved_case(read_text(to_toml(config))), resolved_case(config));
}

TEST(Cavities, CanBeOverridden) {
  const auto config = read_text(heart, {"cavity.atrium.jet={origin=[0,0,1],threshold=2}", "cavity.third.body=sack",
                                        "output.fields.phases=[0.5]"});
  EXPECT_THAT(config.output.fields.phases, ElementsAre(0.5));
  ASSERT_EQ(config.cavities.size(), 3u);
  for (const auto& cavity : config.cavities)
    if (cavity.name == "atrium") {
      EXPECT_EQ(cavity.jet->threshold, 2);
      EXPECT_EQ(cavity.period, 2);
    }
}

TEST(Cavities, AreRefusedWithPlaceAndReason) {
  const auto head = std::string("[box]\nsize = [4, 4, 4]\n");
  const auto body = std::string("[[body]]\nname = \"sack\"\nsurface = { shape = \"sphere\" }\ncenter = [2, 2, 2]\n");
  EXPECT_THAT(problems_of(head + "[cavity.a]\nflow = \"1\"\n" + body),
              ElementsAre(AllOf(HasSubstr("cavity.a.body is missing"))));
  EXPECT_THAT(
      problems_of(head + "[cavity.a]\nbody = \"bag\"\n" + body),
      ElementsAre(HasSubstr("case.toml:4: cavity.a.body names \"bag\", which is no body; the case has \"sack\"")));
  EXPECT_THAT(
      problems_of(head + "[cavity.a]\nbody = \"sack\"\nejection_fraction = 0.3\n" + body),
      ElementsAre(HasSubstr("cavity.a.ejection_fraction sets the scale of a signal, but flow does not name one")));
  EXPECT_THAT(
      problems_of(head + "[cavity.\"a b\"]\nbody = \"sack\"\njet = { threshold = 1 }\nejection_fraction = 1\n" + body),
      UnorderedElementsAre(HasSubstr("cavity.a b names a file"), HasSubstr("cavity.a b.jet.origin is missing"),
                           HasSubstr("cavity.a b.ejection_fraction must be > 0 and < 1")));
  EXPECT_THAT(problems_of(head + "[cavity.a]\nbody = \"sack\"\njets = 1\n" + body),
              ElementsAre(HasSubstr("unknown key cavity.a.jets; the nearest known key is cavity.a.jet")));
  EXPECT_THAT(problems_of(head + "[output]\nfields.phases = [0.5, 1]\n"),
              ElementsAre(HasSubstr("output.fields.phases entry 2 must be >= 0 and < 1")));
  EXPECT_THAT(
      problems_of(head + "[output]\nfields.phases = [0.5]\nphase_average.bins = 4\n"),
      UnorderedElementsAre(HasSubstr("output.fields.phases goes by the phase of a cycle, but output.period is not"),
                           HasSubstr("output.phase_average.bins goes by the phase")));
}

}  // namespace
}  // namespace pliant::test
