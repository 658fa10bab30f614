#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_text.hpp"
#include "config/key_table.hpp"
#include "config/print_case.hpp"
#include "config/quantity.hpp"

namespace pliant {
namespace {
using test::problems_of;
using test::read_text;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// A water rig: 1 is 25 mm, 0.2 m/s (so 0.125 s), 1000 kg/m^3 (so 15.625 g).
const std::string water = "[units]\nlength = \"25 mm\"\nvelocity = \"0.2 m/s\"\ndensity = \"1000 kg/m^3\"\n";
constexpr double length = 0.025, speed = 0.2, density = 1000, duration = length / speed;
constexpr double mass = density * length * length * length, pressure = density * speed * speed;

const std::string ball = "[[body]]\nname = \"a\"\nsurface = { shape = \"sphere\", radius = \"10 mm\" }\n";
const std::string large = "[box]\nsize = \"[10, 10, 10] cm\"\norigin = \"[-5, -5, -5] cm\"\n";

void expect_near(double value, double exact) { EXPECT_NEAR(value, exact, 4e-15 * std::abs(exact)); }

TEST(KeyUnits, AreReadAsProductsAndQuotients) {
  const auto dimension = [](const char* text) { return parse_key_unit(text)->dimension; };
  EXPECT_EQ(dimension("length"), (Dimension{1, 0, 0}));
  EXPECT_EQ(dimension("length^2/time"), (Dimension{2, -1, 0}));
  EXPECT_EQ(dimension("mass / (length time)"), (Dimension{-1, -1, 1}));
  EXPECT_EQ(dimension("mass/(length time^2)"), dimension("pressure"));
  EXPECT_EQ(dimension("energy / area"), dimension("force / length"));
  EXPECT_EQ(dimension("mass length / time^2"), dimension("force"));
  EXPECT_EQ(dimension("torque time"), (Dimension{2, -1, 1}));
  EXPECT_EQ(dimension("1 / time"), (Dimension{0, -1, 0}));
  EXPECT_DOUBLE_EQ(parse_key_unit("degrees / time")->factor, 180 / std::numbers::pi);
  EXPECT_EQ(dimension("degrees / time"), dimension("1 / time"));
  EXPECT_TRUE(parse_key_unit("minutes")->is_clock_time);
  for (const char* text : {"", "steps", "grid spacings"}) EXPECT_FALSE(parse_key_unit(text)) << text;
  for (const char* text : {"lenght", "length /", "length ^", "(length", "length)", "/", "length^x"})
    EXPECT_THROW(parse_key_unit(text), std::logic_error) << text;
}

template <class Config>
void expect_known_units(const std::vector<Key<Config>>& keys) {
  for (const auto& key : keys) EXPECT_NO_THROW(key.quantity()) << key.path;
}

TEST(KeyUnits, OfEveryKeyAreKnown) {
  expect_known_units(case_keys());
  expect_known_units(body_keys());
  expect_known_units(signal_keys());
  expect_known_units(patch_keys());
  expect_known_units(selection_keys());
  expect_known_units(tether_keys());
  expect_known_units(cord_keys());
  expect_known_units(pull_keys());
}

TEST(KeyUnits, AreWrittenAsInBooks) {
  EXPECT_EQ(si_unit({1, 0, 0}), "m");
  EXPECT_EQ(si_unit({-1, -2, 1}), "kg/(m s^2)");
  EXPECT_EQ(si_unit({-3, 0, 1}), "kg/m^3");
  EXPECT_EQ(si_unit({0, -1, 0}), "1/s");
  EXPECT_EQ(si_unit({}), "1");
  EXPECT_EQ(describe(Dimension{-1, -2, 1}), "a pressure");
  EXPECT_EQ(describe(Dimension{2, 0, 0}), "an area");
  EXPECT_EQ(describe(Dimension{-1, -1, 1}), "mass/(length time)");
}

TEST(Quantities, AreNumbersInSi) {
  const auto expect = [](const char* text, double value, Dimension dimension) {
    std::string problem;
    const auto quantity = read_quantity(text, problem);
    ASSERT_TRUE(quantity) << text << ": " << problem;
    EXPECT_NEAR(quantity->value, value, 4e-15 * std::abs(value)) << text;
    EXPECT_EQ(quantity->dimension, dimension) << text;
  };
  expect("25 mm", 0.025, {1, 0, 0});
  expect("25mm", 0.025, {1, 0, 0});
  expect("-1.5e-3 km", -1.5, {1, 0, 0});
  expect("1060 kg/m^3", 1060, {-3, 0, 1});
  expect("1.06 g/cm3", 1060, {-3, 0, 1});
  expect("1.2 MPa", 1.2e6, {-1, -2, 1});
  expect("80 mL/s", 8e-5, {3, -1, 0});
  expect("4.8 L/min", 8e-5, {3, -1, 0});
  expect("3.6 s", 3.6, {0, 1, 0});
  expect("2 min", 120, {0, 1, 0});
  expect("3.5 mPa s", 3.5e-3, {-1, -1, 1});
  expect("3.5 mPa.s", 3.5e-3, {-1, -1, 1});
  expect("3.5 kg/(m s)", 3.5, {-1, -1, 1});
  expect("1 N/m", 1, {0, -2, 1});
  expect("2 uJ", 2e-6, {2, -2, 1});
  expect("1 mm_Hg", 133.322387415, {-1, -2, 1});
  expect("90 degree", std::numbers::pi / 2, {});
  expect("60 rpm", 2 * std::numbers::pi, {0, -1, 0});
  expect("5 1", 5, {});
}

TEST(Quantities, ThatAreNoneSayWhy) {
  const auto problem_of = [](const char* text) {
    std::string problem;
    EXPECT_FALSE(read_quantity(text, problem)) << text;
    return problem;
  };
  EXPECT_THAT(problem_of("25"), HasSubstr("has no unit"));
  EXPECT_THAT(problem_of("mm"), HasSubstr("begins with the number"));
  EXPECT_THAT(problem_of("5 furlogs"), AllOf(HasSubstr("\"furlogs\""), HasSubstr("no unit")));
  EXPECT_THAT(problem_of("20 degC"), HasSubstr("not of length, time and mass alone"));
  EXPECT_THAT(problem_of("3 m @ 5"), HasSubstr("offset"));
  EXPECT_THAT(problem_of("20 K"), HasSubstr("K"));
  EXPECT_THAT(problem_of("3 mol/m^3"), HasSubstr("mol"));
  EXPECT_THAT(problem_of("3 s since 2000-01-01"), HasSubstr("date"));
}

TEST(Units, AreTurnedIntoTheCasesOwnOnce) {
  const auto config = read_text(
      water + large +
      "cells = [8, 8, 8]\n[fluid]\ndensity = \"1.06 g/cm^3\"\nviscosity = \"3.5 mPa s\"\n[time]\nend = "
      "\"3.6 s\"\nstep = \"2 ms\"\n[forcing]\ngravity = [0, 0, \"-9.81 m/s^2\"]\n[repulsion]\nrange = \"1 mm\"\n"
      "strength = \"100 mmHg\"\n[checkpoint]\nminutes = \"2 h\"\n" +
      ball +
      "motion = \"deformable\"\ncenter = [1, \"1 cm\", -1]\nthickness = \"0.5 mm\"\nyoung = \"1.2 MPa\"\ndensity = "
      "\"1070 kg/m^3\"\n[body.potentials]\nsurface_tension = { sigma = \"72 mN/m\" }\n");
  expect_near(config.box.size.x, 0.1 / length);
  expect_near(config.box.origin.z, -0.05 / length);
  expect_near(config.fluid.density, 1.06);
  expect_near(config.fluid.viscosity, 3.5e-3 / (density * speed * length));
  expect_near(config.time.end, 3.6 / duration);
  expect_near(*config.time.step, 2e-3 / duration);
  expect_near(config.forcing.gravity.z, -9.81 * length / (speed * speed));
  EXPECT_EQ(config.forcing.gravity.x, 0);
  expect_near(config.repulsion.strength, 100 * 133.322387415 / pressure);
  EXPECT_EQ(*config.checkpoint.minutes, 120) << "on the wall, not in the case";
  const auto& body = config.bodies[0];
  expect_near(std::get<SphereSurface>(body.surface).radius, 0.4);
  EXPECT_EQ(body.center.x, 1) << "numbers are in the case's own units";
  expect_near(body.center.y, 0.4);
  expect_near(body.material.thickness, 0.02);
  expect_near(*body.material.young, 1.2e6 / pressure);
  expect_near(*body.material.density, 1.07);
  expect_near(body.potentials.surface_tension->sigma, 0.072 / (pressure * length));
}

TEST(Units, MayGiveTheTimeInsteadOfTheVelocity) {
  const auto config = read_text(
      "[units]\nlength = \"1 cm\"\ntime = \"0.5 s\"\ndensity = \"1 g/cm^3\"\n[fluid]\nviscosity = \"1 mPa s\"\n");
  expect_near(config.fluid.viscosity, 1e-3 / (1000 * 1e-2 * 1e-2 / 0.5));
  EXPECT_THAT(
      problems_of("[units]\nlength = \"1 cm\"\ntime = \"0.5 s\"\nvelocity = \"1 m/s\"\ndensity = \"1 g/cm^3\"\n"),
      ElementsAre(HasSubstr("exclude each other")));
}

TEST(Units, OfAnglesNeedNoScales) {
  const auto config = read_text(
      "box.size = [8, 8, 8]\n[[body]]\nname = \"a\"\nmotion = \"fixed\"\nsurface = { shape = "
      "\"sphere\", radius = 0.5 }\nrotation = { axis = [0, 0, 1], angle = \"0.5 rad\" }\n");
  expect_near(config.bodies[0].rotation.angle, 0.5 * 180 / std::numbers::pi);
}

TEST(Units, OfRatesOfAngles) {
  const std::string hinge = "motion = \"hinge\"\nhinge = { rate = \"30 rpm\", angle = \"45 degree\" }\n";
  const auto config = read_text(water + large + ball + hinge);
  expect_near(config.bodies[0].hinge.rate, 180 * duration);
  expect_near(config.bodies[0].hinge.angle, 45);
}

TEST(Units, GiveAConstantWhereAFormulaMayStand) {
  const auto config =
      read_text(water + large + ball + "motion = \"prescribed\"\npath = { x = \"2 mm\", y = \"2 + t\" }\n");
  expect_near(std::stod(config.bodies[0].path.x), 0.08);
  EXPECT_EQ(config.bodies[0].path.y, "2 + t");
}

TEST(Units, OnTheCommandLine) {
  const auto config = read_text(water, {"fluid.viscosity=1 mPa s", "box.size=[\"10 cm\", 4, \"100 mm\"]"});
  expect_near(config.fluid.viscosity, 1e-3 / (density * speed * length));
  expect_near(config.box.size.x, 4);
  expect_near(config.box.size.z, 4);
  EXPECT_THAT(problems_of(water, {"fluid.viscosity=1 mm"}),
              ElementsAre(AllOf(HasSubstr("--set fluid.viscosity=1 mm: fluid.viscosity is \"1 mm\", a length"),
                                HasSubstr("must be mass/(length time)"), HasSubstr("kg/(m s)"))));
}

TEST(Units, WithoutScalesAreRefusedWithWhatToAdd) {
  EXPECT_THAT(problems_of("[fluid]\nviscosity = \"1 mPa s\"\n"),
              ElementsAre(AllOf(HasSubstr("case.toml:2: fluid.viscosity is \"1 mPa s\""), HasSubstr("add [units]"),
                                HasSubstr("velocity"), HasSubstr("density"))));
}

TEST(Units, OfAnotherDimensionAreRefused) {
  EXPECT_THAT(problems_of(water + "[time]\nend = \"3 mm\"\n"),
              ElementsAre(AllOf(HasSubstr("case.toml:6: time.end is \"3 mm\", a length, but must be a time"))));
  EXPECT_THAT(problems_of(water + "[box]\nsize = [\"10 cm\", \"5 s\", \"5 cm\"]\n"),
              ElementsAre(HasSubstr("box.size is \"5 s\", a time, but must be a length")));
  EXPECT_THAT(problems_of(water + "[fluid]\nviscosity = \"1 furlog\"\n"),
              ElementsAre(HasSubstr("\"furlog\" is no unit")));
  EXPECT_THAT(problems_of(water + "[time]\nend = \"3.6\"\n"), ElementsAre(HasSubstr("has no unit")));
  EXPECT_THAT(problems_of(water + "[time]\nend = \"soon\"\n"), ElementsAre(HasSubstr("must be a number")));
  EXPECT_THAT(problems_of(water + "[time]\ncfl = \"0.5 m\"\n"), ElementsAre(HasSubstr("must be a number")));
  EXPECT_THAT(problems_of(water + "[fluid]\ndensity = \"-1 g/cm^3\"\n"), ElementsAre(HasSubstr("must be > 0")));
}

TEST(Units, WhoseScalesAreWrongAreNotBlamedOnOtherKeys) {
  const std::string uses = "[fluid]\nviscosity = \"1 mPa s\"\n";
  EXPECT_THAT(problems_of("[units]\nlength = \"25 s\"\nvelocity = \"1 m/s\"\ndensity = \"1 kg/m^3\"\n" + uses),
              ElementsAre(HasSubstr("case.toml:2: units.length is \"25 s\", a time, but must be a length")));
  EXPECT_THAT(problems_of("[units]\nlength = \"25 mm\"\ndensity = \"1 kg/m^3\"\n" + uses),
              ElementsAre(HasSubstr("units.velocity is missing")));
  EXPECT_THAT(problems_of("[units]\nlength = \"25 mm\"\nvelocity = \"1 m/s\"\n" + uses),
              ElementsAre(HasSubstr("units.density is missing")));
  EXPECT_THAT(problems_of("[units]\nlength = 25\nvelocity = \"-1 m/s\"\ndensity = \"1 kg/m^3\"\n" + uses), SizeIs(2));
}

TEST(Units, ArePrintedSoThatTheCaseIsTheSame) {
  const auto text = water + large +
                    "[fluid]\nviscosity = \"1 mPa s\"\n[signals.beat]\ncsv = \"q.csv\"\nperiod = \"3.6 "
                    "s\"\nunit = { t = \"ms\", v = \"mL/s\" }\n";
  const auto once = read_text(text);
  const auto printed = to_toml(once);
  const auto again = read_text(printed);
  EXPECT_EQ(to_toml(again), printed);
  EXPECT_EQ(again.fluid.viscosity, once.fluid.viscosity);
  EXPECT_EQ(again.signals.at("beat").time_unit, once.signals.at("beat").time_unit);
  EXPECT_EQ(again.signals.at("beat").value_unit, once.signals.at("beat").value_unit);
}

TEST(Units, OfSignals) {
  const auto config = read_text(water +
                                "[signals.a]\ntable = [[0, 0], [1, 2]]\nunit = { t = \"ms\", v = \"mL/s\" }\n"
                                "[signals.b]\nformula = \"sin(t)\"\nscale = \"80 mL/s\"\nperiod = 2\n"
                                "[signals.c]\nformula = \"sin(t)\"\nvolume = \"30 mL\"\nperiod = \"3.6 s\"\n");
  const double flow_rate = speed * length * length;
  const auto& a = config.signals.at("a");
  expect_near(a.time_unit, 1e-3 / duration);
  expect_near(a.value_unit, 1e-6 / flow_rate);
  EXPECT_EQ(a.dimension, (Dimension{3, -1, 0}));
  const auto& b = config.signals.at("b");
  expect_near(b.scale, 80e-6 / flow_rate);
  EXPECT_EQ(b.dimension, (Dimension{3, -1, 0}));
  EXPECT_EQ(*b.period, 2);
  const auto& c = config.signals.at("c");
  expect_near(*c.volume, 30e-6 / (length * length * length));
  expect_near(*c.period, 3.6 / duration);
}

TEST(Units, OfSignalsThatMakeNoSenseAreRefused) {
  const std::string signal = "[signals.a]\nformula = \"sin(t)\"\nperiod = 1\n";
  EXPECT_THAT(problems_of(water + signal + "unit = { t = \"mm\" }\n"),
              ElementsAre(HasSubstr("signals.a.unit.t is \"mm\", a length, but must be a time")));
  EXPECT_THAT(problems_of(water + signal + "unit = { v = \"mL/s\" }\nscale = \"2 mL/s\"\n"),
              ElementsAre(HasSubstr("give one of them")));
  EXPECT_THAT(problems_of(water + signal + "unit = { v = \"mm\" }\nvolume = \"2 mL\"\n"),
              ElementsAre(HasSubstr("signals.a.volume is what a flow rate carries")));
  EXPECT_THAT(problems_of(signal + "unit = { v = \"mL/s\" }\n"), ElementsAre(HasSubstr("add [units]")));
  EXPECT_THAT(problems_of(signal + "scale = \"2 mL/s\"\n"), ElementsAre(HasSubstr("add [units]")));
  EXPECT_THAT(problems_of(signal + "scale = 2\nvolume = 2\n"), ElementsAre(HasSubstr("exclude each other")));
}

}  // namespace
}  // namespace pliant
