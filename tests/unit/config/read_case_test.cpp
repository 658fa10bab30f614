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
using testing::UnorderedElementsAre;

constexpr auto drop_case = R"(
title = "Drop in shear, Ca = 0.1"
[box]
size   = [8, 8, 8]
origin = [-4, -4, -4]
cells  = [64, 64, 64]
stretching = { z = { law = "tanh", strength = 2.5 } }
[fluid]
density   = 1
viscosity = 1.5
[boundary]
x = "periodic"
y = { type = "free-slip" }
"z-" = { type = "wall", velocity = [-4, 0, 0] }
"z+" = { type = "wall", velocity = [ 4, 0, 0] }
[initial]
flow = "couette"
[time]
end     = 20.0
cfl     = 0.5
viscous = "implicit-z"
[[body]]
name    = "drop"
surface = { shape = "sphere", frequency = 8, diameter = 3 }
center  = [0, 0, 0]
motion  = "deformable"
coupling = "one-way"
mass_per_vertex = 1.0
traction = { form = "drag", coefficient = 100 }
[body.potentials]
edge    = { stiffness = 400, rest_length = 1.0 }
bending = { stiffness = 64 }
volume  = { stiffness = 2e4 }
[output]
history  = { every = 10 }
fields   = { interval = 0.5 }
surfaces = { every = 3 }
)";

TEST(ReadCase, PutsEveryKeyWhereItBelongs) {
  const auto config = read_text(drop_case);
  EXPECT_EQ(config.title, "Drop in shear, Ca = 0.1");
  EXPECT_EQ(config.box.size, (Vec3{8, 8, 8}));
  EXPECT_EQ(config.box.origin, (Vec3{-4, -4, -4}));
  EXPECT_EQ(config.box.cells, (std::array<int, 3>{64, 64, 64}));
  EXPECT_EQ(config.box.stretching_z.law, StretchingLaw::tanh);
  EXPECT_EQ(config.box.stretching_z.strength, 2.5);
  EXPECT_EQ(config.fluid.viscosity, 1.5);
  EXPECT_TRUE(std::holds_alternative<PeriodicSide>(config.boundary[1]));
  EXPECT_TRUE(std::holds_alternative<FreeSlipSide>(config.boundary[2]));
  EXPECT_EQ(std::get<WallSide>(config.boundary[4]).velocity, (Vec3{-4, 0, 0}));
  EXPECT_EQ(std::get<WallSide>(config.boundary[5]).velocity, (Vec3{4, 0, 0}));
  EXPECT_EQ(config.initial.flow, InitialFlow::couette);
  EXPECT_EQ(config.time.end, 20.0);
  EXPECT_EQ(config.time.viscous, ViscousMode::implicit_z);
  ASSERT_EQ(config.bodies.size(), 1u);
  const auto& drop = config.bodies[0];
  EXPECT_EQ(drop.name, "drop");
  EXPECT_EQ(std::get<SphereSurface>(drop.surface).radius, 1.5);
  EXPECT_EQ(drop.traction.form, TractionForm::drag);
  EXPECT_EQ(drop.potentials.edge->stiffness, 400);
  EXPECT_EQ(drop.potentials.bending->reference, ReferenceAngle::initial);
  EXPECT_FALSE(drop.potentials.area);
  EXPECT_EQ(config.output.fields.interval, 0.5);
  EXPECT_EQ(config.output.surfaces.every, 3);
}

TEST(ReadCase, ResolvedPrintOutReadsBackAsTheSameCase) {
  const auto config = read_text(drop_case);
  const auto again = read_text(to_toml(config));
  EXPECT_EQ(resolved_case(config), resolved_case(again));
  EXPECT_EQ(to_toml(config), to_toml(again));
}

TEST(ReadCase, ResolvedPrintOutFillsInEveryDefault) {
  const auto resolved = resolved_case(read_text("title = \"bare\""));
  EXPECT_EQ(resolved["fluid"]["viscosity"], 1.0);
  EXPECT_EQ(resolved["time"]["viscous"], "implicit");
  EXPECT_EQ(resolved["boundary"]["z+"]["type"], "periodic");
  EXPECT_EQ(resolved["box"]["cells"], Json::array({32, 32, 32}));
}

TEST(ReadCase, UnknownKeysNameTheNearest) {
  EXPECT_THAT(problems_of("[fluid]\nviscocity = 1"),
              ElementsAre(AllOf(HasSubstr("case.toml:2"), HasSubstr("fluid.viscocity"), HasSubstr("fluid.viscosity"))));
  EXPECT_THAT(problems_of("[fluit]\nviscosity = 1"),
              ElementsAre(AllOf(HasSubstr("case.toml:1"), HasSubstr("nearest known key is fluid"))));
  EXPECT_THAT(problems_of("[boundary]\nw = \"wall\""), ElementsAre(HasSubstr("unknown key boundary.w")));
  EXPECT_THAT(problems_of("[[body]]\nname = \"a\"\ncoupling = \"one-way\"\nsurface.shape = \"sphere\"\npotentials.edge = { stifness = 1 }\n"
                          "[box]\nsize = [4, 4, 4]"),
              UnorderedElementsAre(
                  AllOf(HasSubstr("body.a.potentials.edge.stifness"), HasSubstr("body.a.potentials.edge.stiffness")),
                  HasSubstr("body.a.potentials.edge.stiffness is missing")));
}

TEST(ReadCase, ListsAllProblemsWithTheirLines) {
  const auto problems = problems_of(R"([box]
size = [1, -1, 1]
cells = [8, 8]
[fluid]
density = "heavy"
viscosity = nan
[time]
viscous = "implict"
end = -1
[output]
history.every = 2.5
)");
  EXPECT_THAT(problems, UnorderedElementsAre(AllOf(HasSubstr("case.toml:2: box.size component y must be > 0")),
                                             AllOf(HasSubstr("case.toml:3: box.cells"), HasSubstr("has 2")),
                                             AllOf(HasSubstr("case.toml:5: fluid.density must be a number")),
                                             AllOf(HasSubstr("case.toml:6: fluid.viscosity must be a finite number")),
                                             AllOf(HasSubstr("case.toml:8: time.viscous"), HasSubstr("implicit-z")),
                                             HasSubstr("case.toml:9: time.end must be >= 0"),
                                             HasSubstr("case.toml:11: output.history.every must be an integer")));
}

TEST(ReadCase, SyntaxErrorsHaveALine) {
  EXPECT_THAT(problems_of("[box]\nsize = [1, 2\n[fluid]\n"), ElementsAre(HasSubstr("not valid TOML")));
  EXPECT_THAT(problems_of("a = 1\nb = = 2\n"), ElementsAre(HasSubstr("case.toml:2")));
  EXPECT_THAT(problems_of(" \n\n"), ElementsAre(HasSubstr("is empty")));
  EXPECT_THROW(read_case("/nonexistent/case"), InputError);
}

TEST(ReadCase, UnknownBoundaryTypesNameTheKnownOnes) {
  EXPECT_THAT(problems_of("[boundary]\nx = { type = \"inlet\", velocity = [1, 0, 0] }"),
              testing::Each(testing::AnyOf(AllOf(HasSubstr("unknown type \"inlet\"; known: \"periodic\"")),
                                           HasSubstr("has no effect"))));
}

TEST(ReadCase, InflowNeedsAWayOutAndPointsIntoTheBox) {
  const std::string outflow = "\"x+\" = \"outflow\"\n";
  const auto inflow = [](const std::string& rest) {
    return "[boundary]\n\"x-\" = { type = \"inflow\", " + rest + " }\n";
  };
  EXPECT_THAT(problems_of(inflow("velocity = [1, 0, 0], profile = \"parabolic\", ramp = 0.5") + outflow),
              testing::IsEmpty());
  EXPECT_THAT(problems_of(inflow("velocity = [1, 0, 0]") + "\"x+\" = \"wall\"\n"),
              ElementsAre(AllOf(HasSubstr("boundary.x-.type"), HasSubstr("nothing lets the fluid out"))));
  EXPECT_THAT(problems_of(inflow("velocity = [-1, 0, 0]") + outflow),
              ElementsAre(AllOf(HasSubstr("boundary.x-.velocity"), HasSubstr("does not point into the box"))));
  EXPECT_THAT(problems_of(inflow("velocity = [1, 0, 0], ramp = -1") + outflow),
              ElementsAre(AllOf(HasSubstr("boundary.x-.ramp"), HasSubstr(">= 0"))));
  EXPECT_THAT(problems_of(inflow("velocity = [1, 0, 0], profile = \"round\"") + outflow),
              ElementsAre(HasSubstr("boundary.x-.profile")));
}

TEST(ReadCase, UniformFlowMayPassOpenSidesOnly) {
  const std::string open = "[boundary]\n\"x-\" = { type = \"inflow\", velocity = [1, 0, 0] }\n\"x+\" = \"outflow\"\n";
  EXPECT_THAT(problems_of(open + "[initial]\nflow = \"uniform\"\nvelocity = [1, 0, 0]\n"), testing::IsEmpty());
  EXPECT_THAT(problems_of(open + "z = \"wall\"\n[initial]\nflow = \"uniform\"\nvelocity = [1, 0, 1]\n"),
              ElementsAre(HasSubstr("initial.velocity")));
}

TEST(ReadCase, SidesAreGivenOnce) {
  EXPECT_THAT(problems_of("[boundary]\nz = \"wall\"\n\"z+\" = \"wall\""), ElementsAre(HasSubstr("already set at")));
}

TEST(ReadCase, TwoWaysOfSayingTheSameExcludeEachOther) {
  EXPECT_THAT(problems_of("[time]\ncfl = 0.5\nstep = 0.1"),
              ElementsAre(AllOf(HasSubstr("case.toml:2"), HasSubstr("time.step"), HasSubstr("exclude each other"))));
  EXPECT_THAT(problems_of("[output]\nfields = { interval = 1, every = 2 }"),
              ElementsAre(HasSubstr("exclude each other")));
}

TEST(ReadCase, KeysWithoutEffectAreErrors) {
  EXPECT_THAT(problems_of("[initial]\nflow = \"rest\"\namplitude = 2"),
              ElementsAre(AllOf(HasSubstr("initial.amplitude has no effect"), HasSubstr("taylor-green"))));
}

TEST(ReadCase, ABodyNeedsANameAndASurface) {
  EXPECT_THAT(problems_of("[[body]]\ncenter = [0, 0, 0]"),
              UnorderedElementsAre(HasSubstr("name is missing"), HasSubstr("surface is missing")));
}

TEST(Overrides, ReplaceValuesOfTheFile) {
  const auto config =
      read_text(drop_case, {"body.drop.potentials.edge.stiffness=300", "fluid.viscosity=2", "initial.flow=rest",
                            "boundary.z+.velocity=[2,0,0]", "box.cells=[8,8,16]", "title=short one", "time.step=1e-3",
                            "body.drop.surface={file=\"a.gts\", scale=2}", "body.drop.potentials.area={stiffness=7}"});
  EXPECT_EQ(config.bodies[0].potentials.edge->stiffness, 300);
  EXPECT_EQ(config.bodies[0].potentials.edge->rest_length, 1.0);
  EXPECT_EQ(config.bodies[0].potentials.area->stiffness, 7);
  EXPECT_EQ(config.fluid.viscosity, 2);
  EXPECT_EQ(config.initial.flow, InitialFlow::rest);
  EXPECT_EQ(std::get<WallSide>(config.boundary[5]).velocity, (Vec3{2, 0, 0}));
  EXPECT_EQ(config.box.cells[2], 16);
  EXPECT_EQ(config.title, "short one");
  EXPECT_EQ(config.time.step, 1e-3);
  EXPECT_EQ(std::get<FileSurface>(config.bodies[0].surface).file, "a.gts");
  EXPECT_EQ(std::get<FileSurface>(config.bodies[0].surface).scale, 2);
}

TEST(Overrides, ChangeWholeSides) {
  const auto config = read_text(drop_case, {"boundary.z=periodic", "initial.flow=rest", "boundary.y=wall"});
  EXPECT_TRUE(std::holds_alternative<PeriodicSide>(config.boundary[4]));
  EXPECT_TRUE(std::holds_alternative<PeriodicSide>(config.boundary[5]));
  EXPECT_TRUE(std::holds_alternative<WallSide>(config.boundary[2]));
}

TEST(Overrides, ProblemsNameTheOverride) {
  EXPECT_THAT(problems_of(drop_case, {"fluid.viscosty=2"}),
              ElementsAre(AllOf(HasSubstr("--set fluid.viscosty=2"), HasSubstr("fluid.viscosity"))));
  EXPECT_THAT(problems_of(drop_case, {"fluid.viscosity=-2"}), ElementsAre(HasSubstr("--set fluid.viscosity=-2")));
  EXPECT_THAT(problems_of(drop_case, {"body.dorp.center=[0,0,0]"}),
              ElementsAre(AllOf(HasSubstr("--set body.dorp"), HasSubstr("drop"))));
  EXPECT_THAT(problems_of(drop_case, {"output={}"}), ElementsAre(HasSubstr("sets no key")));
  EXPECT_THAT(problems_of(drop_case, {"fluid"}), ElementsAre(HasSubstr("key.path=value")));
  EXPECT_THAT(problems_of(drop_case, {"fluid.viscosity=[1"}), ElementsAre(HasSubstr("not valid TOML")));
}

TEST(Validate, FindsWhatSingleKeysCannotSay) {
  EXPECT_THAT(problems_of("[boundary]\n\"z-\" = \"wall\""),
              ElementsAre(AllOf(HasSubstr("case.toml:2: boundary.z-.type"), HasSubstr("boundary.z+ is periodic"))));
  EXPECT_THAT(problems_of("[boundary]\nz = { type = \"wall\", velocity = [0, 0, 1] }"),
              ElementsAre(HasSubstr("normal to the wall"), HasSubstr("normal to the wall")));
  EXPECT_THAT(problems_of("[initial]\nflow = \"couette\""), ElementsAre(HasSubstr("needs walls")));
  EXPECT_THAT(problems_of("[boundary]\ny = \"free-slip\"\n[initial]\nflow = \"uniform\"\nvelocity = [1, 2, 0]"),
              ElementsAre(HasSubstr("case.toml:5: initial.velocity has the component 2 along y")));
  EXPECT_THAT(problems_of("[boundary]\nx = \"wall\"\n[forcing]\nbulk_velocity = { axis = \"x\", value = 1 }"),
              ElementsAre(HasSubstr("case.toml:4: forcing.bulk_velocity.axis is x, but x is not periodic")));
  EXPECT_THAT(problems_of("[box]\ncells = [8, 8, 3]", {}, 4),
              ElementsAre(AllOf(HasSubstr("case.toml:2"), HasSubstr("3 planes"), HasSubstr("4 ranks"))));
  EXPECT_THAT(problems_of(drop_case, {"body.drop.center=[0, 3, 0]"}),
              ElementsAre(AllOf(HasSubstr("body.drop reaches from 1.5 to 4.5 along y"), HasSubstr("-4 to 4"))));
  EXPECT_THAT(problems_of(drop_case, {"body.drop.center=[100, 0, 0]"}), IsEmpty());
}

TEST(Validate, BodiesLeaveTheFlowItsFilesAndFitIntoFileNames) {
  const std::string body = "[box]\nsize = [4, 4, 4]\n[[body]]\ncoupling = \"one-way\"\nsurface = { shape = \"sphere\" }\nname = ";
  EXPECT_THAT(problems_of(body + "\"fields\""), ElementsAre(HasSubstr("body.fields.name is the name of the flow's")));
  EXPECT_THAT(problems_of(body + "\"" + std::string(101, 'a') + "\""), ElementsAre(HasSubstr("use at most 100")));
  EXPECT_THAT(problems_of(body + "\"" + std::string(100, 'a') + "\""), IsEmpty());
}

TEST(ReadCase, RefusesGridsThatNobodyCanHave) {
  EXPECT_THAT(problems_of("box.cells = [1000000000, 8, 8]"), ElementsAre(HasSubstr("<= 100000")));
  EXPECT_THAT(problems_of("box.stretching.z = { law = \"tanh\", strength = 40 }"), ElementsAre(HasSubstr("<= 10")));
}

TEST(ReadCase, ClusteredCellsHaveTheirOwnKeys) {
  const auto box = read_text("box.stretching.z = { law = \"cluster\", center = 0.4, width = 0.25, growth = 0.03 }").box;
  EXPECT_EQ(box.stretching_z.law, StretchingLaw::cluster);
  EXPECT_EQ(box.stretching_z.center, 0.4);
  EXPECT_EQ(box.stretching_z.width, 0.25);
  EXPECT_EQ(box.stretching_z.growth, 0.03);
  EXPECT_THAT(problems_of("box.stretching.z = { law = \"cluster\", center = 2 }"),
              ElementsAre(HasSubstr("is 2, outside the box, which reaches from 0 to 1 along z")));
  EXPECT_THAT(problems_of("box.stretching.z = { law = \"tanh\", center = 0.5 }"),
              ElementsAre(HasSubstr("box.stretching.z.law is \"cluster\"")));
}

TEST(Validate, BodiesHaveTheirOwnNames) {
  const std::string body = "[[body]]\nname = \"a\"\ncoupling = \"one-way\"\nsurface = { shape = \"sphere\", radius = 0.1 }\n";
  EXPECT_THAT(problems_of(body + body), ElementsAre(HasSubstr("more than one body")));
}

}  // namespace
}  // namespace pliant
