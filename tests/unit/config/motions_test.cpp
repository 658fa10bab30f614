#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case_text.hpp"

namespace pliant {
namespace {
using test::problems_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A case with one ball that moves so, on line 4; `more` begins on line 6.
std::string ball(const std::string& motion, const std::string& more = "") {
  return "box.size = [8, 8, 8]\n[[body]]\nname = \"a\"\nmotion = \"" + motion +
         "\"\nsurface = { shape = \"sphere\", radius = 0.5 }\n" + more;
}
std::string plate(const std::string& motion, const std::string& more = "") {
  return "box.size = [8, 8, 8]\n[[body]]\nname = \"a\"\nmotion = \"" + motion +
         "\"\nsurface = { shape = \"plate\" }\n" + more;
}

TEST(Motions, SoundOnesPass) {
  for (const char* motion : {"fixed", "prescribed", "rigid", "hinge"})
    EXPECT_THAT(problems_of(ball(motion)), IsEmpty());
  EXPECT_THAT(problems_of(ball("deformable", "coupling = \"one-way\"")), IsEmpty());
  EXPECT_THAT(problems_of(ball("prescribed", "coupling = \"one-way\"")), IsEmpty());
  EXPECT_THAT(problems_of(plate("fixed")), IsEmpty());
  EXPECT_THAT(problems_of(plate("rigid", "thickness = 0.1")), IsEmpty());
  EXPECT_THAT(problems_of(ball("hinge", "hinge = { min_angle = -10, max_angle = 10, angle = 10 }")), IsEmpty());
  EXPECT_THAT(problems_of(ball("fixed") + "[repulsion]\nrange = 4\nstrength = 1"), IsEmpty());
  EXPECT_THAT(problems_of(ball("fixed") + "[forcing]\ngravity = [0, 0, -1]"), IsEmpty()) << "nothing that falls";
}

TEST(Motions, OnlyDeformableBodiesMoveWithTheFlow) {
  for (const char* coupling : {"force-spreading", "local-mass"}) {
    EXPECT_THAT(problems_of(ball("deformable", "coupling = \"" + std::string(coupling) + "\"")), IsEmpty());
    EXPECT_THAT(problems_of(ball("rigid", "coupling = \"" + std::string(coupling) + "\"")),
                ElementsAre(AllOf(HasSubstr("case.toml:6: body.a.coupling is \"" + std::string(coupling) + "\""),
                                  HasSubstr("deformable"))));
  }
}

TEST(Motions, SchedulesAreForBodiesWhosePlaceIsKnown) {
  const std::string schedule = "schedule = { period = 28.8, phase = [0.62, 1.0] }";
  for (const char* motion : {"fixed", "prescribed"}) EXPECT_THAT(problems_of(ball(motion, schedule)), IsEmpty());
  EXPECT_THAT(problems_of(ball("fixed", "schedule = { period = 1, phase = [0.9, 0.1] }")), IsEmpty());
  for (const char* motion : {"rigid", "hinge", "deformable"})
    EXPECT_THAT(problems_of(ball(motion, schedule)),
                ElementsAre(AllOf(HasSubstr("body.a.schedule is given, but motion is"), HasSubstr(motion))));
  EXPECT_THAT(problems_of(ball("fixed", "schedule = { period = 1, phase = [0.3, 0.3] }")),
              ElementsAre(HasSubstr("case.toml:6: body.a.schedule.phase begins and ends at 0.3")));
  EXPECT_THAT(problems_of(ball("fixed", "schedule = { period = 0, phase = [0.3, 1.3] }")),
              ElementsAre(HasSubstr("schedule.period must be > 0"), HasSubstr("schedule.phase second number must be")));
  EXPECT_THAT(problems_of(ball("fixed", "schedule = { phase = [0.3, 1] }")),
              ElementsAre(HasSubstr("schedule.period is missing")));
  EXPECT_THAT(problems_of(ball("prescribed", "coupling = \"one-way\"\n" + schedule)),
              ElementsAre(HasSubstr("body.a.schedule is given, but coupling is \"one-way\"")));
}

TEST(Motions, FreeBodiesActOnTheFlow) {
  for (const char* motion : {"rigid", "hinge"})
    EXPECT_THAT(problems_of(ball(motion, "coupling = \"one-way\"")),
                ElementsAre(AllOf(HasSubstr("case.toml:6: body.a.coupling is \"one-way\""), HasSubstr(motion))));
}

TEST(Motions, FormsOfTractionSuitThem) {
  for (const char* motion : {"fixed", "prescribed", "rigid", "hinge"})
    EXPECT_THAT(problems_of(ball(motion, "traction.form = \"drag\"")),
                ElementsAre(HasSubstr("case.toml:6: body.a.traction.form is \"drag\"")));
  EXPECT_THAT(problems_of(ball("deformable", "coupling = \"one-way\"\ntraction.form = \"quadratic\"")),
              ElementsAre(HasSubstr("case.toml:7: body.a.traction.form is \"quadratic\"")));
  EXPECT_THAT(problems_of(ball("rigid", "loads = \"probes\"\ntraction.form = \"none\"")),
              ElementsAre(HasSubstr("case.toml:6: body.a.loads is \"probes\"")));
  EXPECT_THAT(problems_of(ball("rigid", "traction.form = \"none\"")), IsEmpty());
}

TEST(Motions, AxesHaveADirection) {
  EXPECT_THAT(problems_of(ball("hinge", "hinge.axis = [0, 0, 0]")),
              ElementsAre(HasSubstr("case.toml:6: body.a.hinge.axis must not be 0")));
  EXPECT_THAT(problems_of(ball("prescribed", "path = { angle = \"t\", axis = [0, 0, 0] }")),
              ElementsAre(HasSubstr("case.toml:6: body.a.path.axis must not be 0")));
}

TEST(Motions, HingesStartBetweenTheirStops) {
  EXPECT_THAT(problems_of(ball("hinge", "hinge = { min_angle = 20, max_angle = 10 }")),
              ElementsAre(HasSubstr("body.a.hinge.min_angle is 20, above hinge.max_angle = 10")));
  EXPECT_THAT(problems_of(ball("hinge", "hinge = { min_angle = 5 }")),
              ElementsAre(AllOf(HasSubstr("case.toml:2: body.a.hinge.angle starts at 0 degrees"),
                                HasSubstr("below hinge.min_angle = 5"))));
  EXPECT_THAT(problems_of(ball("hinge", "hinge = { max_angle = 5, angle = 6 }")),
              ElementsAre(HasSubstr("above hinge.max_angle = 5")));
  EXPECT_THAT(problems_of(ball("hinge", "count = 3")),
              ElementsAre(HasSubstr("case.toml:6: body.a.count makes copies")));
  EXPECT_THAT(problems_of(ball("hinge", "positions = \"places.csv\"")),
              ElementsAre(HasSubstr("body.a.positions makes copies")));
}

TEST(Motions, OpenSurfacesNeedAWallToHaveAMass) {
  for (const char* motion : {"rigid", "hinge"})
    for (const char* more : {"", "mass = 2"})
      EXPECT_THAT(problems_of(plate(motion, more)), ElementsAre(HasSubstr("case.toml:2: body.a.thickness is 0")));
}

TEST(Motions, AxesAreFreeOrHeld) {
  EXPECT_THAT(problems_of(ball("rigid", "free_rotation = [1, 0.5, 0]")),
              ElementsAre(HasSubstr("case.toml:6: body.a.free_rotation has the component 0.5 along y")));
  EXPECT_THAT(problems_of(ball("rigid", "free_translation = [0, 0, 1]")), IsEmpty());
}

TEST(Motions, RepulsionHasARangeAndAStrength) {
  EXPECT_THAT(problems_of(ball("fixed") + "[repulsion]\nrange = 1"),
              ElementsAre(HasSubstr("case.toml:7: repulsion.range is given, but repulsion.strength is 0")));
  EXPECT_THAT(problems_of(ball("fixed") + "[repulsion]\nstrength = 1"),
              ElementsAre(HasSubstr("case.toml:7: repulsion.strength is given, but repulsion.range is 0")));
  EXPECT_THAT(problems_of("[repulsion]\nstrength = 1\nrange = 3\n[box]\nsize = [8, 5, 4]\n[boundary]\nz = \"wall\""),
              ElementsAre(HasSubstr("case.toml:3: repulsion.range is 3, more than half of the periodic direction y")));
}

TEST(Motions, TightSurfacesAreOpenAndStandStill) {
  EXPECT_THAT(problems_of(ball("fixed", "tight = true")),
              ElementsAre(HasSubstr("case.toml:6: body.a.tight is true, but the surface is closed")));
  EXPECT_THAT(problems_of(plate("fixed",
                                "tight = true\ntight_parts = [\"half\"]\n[body.selection]\nhalf = { plane = "
                                "{ point = [0, 0, 0], normal = [1, 0, 0], side = \"beyond\" } }")),
              IsEmpty());
  EXPECT_THAT(problems_of(plate("fixed", "tight_parts = [\"border\"]\n[body.selection]\nborder = { border = true }")),
              ElementsAre(HasSubstr("body.a.tight_parts names parts of a tight surface, but tight is false")));
  EXPECT_THAT(
      problems_of(plate("fixed", "tight = true\n[body.selection]\nborder = { border = true }")),
      ElementsAre(HasSubstr("body.a.selection.border is of vertices that move one by one, or of a part of a tight")));
  EXPECT_THAT(problems_of(plate("fixed", "tight = true\ntight_parts = [\"hafl\"]")),
              ElementsAre(HasSubstr("body.a.tight_parts names \"hafl\", which is no selection of the body")));
}

TEST(Motions, AllProblemsAreTold) {
  EXPECT_EQ(problems_of(ball("hinge",
                             "coupling = \"one-way\"\ntraction.form = \"drag\"\nhinge = { axis = [0, 0, 0], "
                             "max_angle = -1 }\ncount = 2"))
                .size(),
            5u);
}

}  // namespace
}  // namespace pliant
