#include "signals/make_signal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "core/error.hpp"
#include "unit/io/temporary_folder.hpp"

namespace pliant {
namespace {

using std::numbers::pi;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

SignalConfig formula(const std::string& text, std::optional<double> period = std::nullopt) {
  SignalConfig config;
  config.formula = text;
  config.period = period;
  return config;
}

SignalConfig table(std::vector<std::array<double, 2>> pairs, std::optional<double> period = std::nullopt) {
  SignalConfig config;
  config.table = std::move(pairs);
  config.period = period;
  return config;
}

std::vector<std::string> problems_in(const std::function<void()>& make) {
  try {
    make();
  } catch (const InputError& error) { return error.problems(); }
  return {};
}

std::vector<std::string> problems_of(const SignalConfig& config) {
  return problems_in([&] { make_signal(config, "."); });
}

TEST(MakeSignal, EvaluatesFormulas) {
  const auto wave = make_signal(formula("0.5*(1-cos(pi*t))"), ".");
  for (double t : {-0.3, 0.0, 0.1, 0.5, 1.0, 12.25}) EXPECT_NEAR(wave.value(t), 0.5 * (1 - std::cos(pi * t)), 1e-15);
  EXPECT_EQ(make_signal(formula("t < 0.5 ? 1 : 2"), ".").value(0.7), 2);
  EXPECT_FALSE(wave.period());
  EXPECT_EQ(wave.phase(0.3), 0);
}

TEST(MakeSignal, RepeatsFormulasAndScalesThem) {
  auto config = formula("t", 0.5);
  config.scale = -3;
  const auto saw = make_signal(config, ".");
  EXPECT_NEAR(saw.value(1.7), -0.6, 1e-14);
  EXPECT_NEAR(saw.value(-0.1), -1.2, 1e-14);
  EXPECT_NEAR(saw.phase(0.6), 0.2, 1e-14);
}

TEST(MakeSignal, CopiesAreIndependentOfEachOther) {
  const auto first = make_signal(formula("t^2"), ".");
  const auto second = first;
  EXPECT_EQ(first.value(3), 9);
  EXPECT_EQ(second.value(2), 4);
  EXPECT_EQ(first.value(3), 9);
}

TEST(MakeSignal, NamesTheCharacterOfABadFormula) {
  EXPECT_THAT(problems_of(formula("1 + sin(2*t")), ElementsAre(AllOf(HasSubstr("formula"), HasSubstr("character 12"))));
  EXPECT_THAT(problems_of(formula("2*x")), ElementsAre(AllOf(HasSubstr("character 3"), HasSubstr("x"))));
  EXPECT_THAT(problems_of(formula("t, 2")), ElementsAre(HasSubstr("2 results")));
  EXPECT_THAT(problems_of(formula("t = 2")), ElementsAre(HasSubstr("changes t")));
  EXPECT_THAT(problems_of(formula("1/(t-0.25)", 1.0)),
              ElementsAre(AllOf(HasSubstr("no finite value"), HasSubstr("0.25"))));
  EXPECT_THAT(problems_of(formula("sqrt(0.5-t)", 0.5)), IsEmpty());
}

TEST(MakeSignal, RefusesTablesThatAreNone) {
  EXPECT_THAT(problems_of(table({{0, 1}, {2, 1}, {1, 1}, {1, 3}})),
              ElementsAre(AllOf(HasSubstr("table"), HasSubstr("time 1 after 2")), HasSubstr("time 1 after 1")));
  EXPECT_THAT(problems_of(table({{0, 1}, {2, 1}}, 1.5)), ElementsAre(AllOf(HasSubstr("period"), HasSubstr("shorter"))));
  EXPECT_THAT(problems_of(table({{0, 1}, {2, 3}}, 2)), ElementsAre(HasSubstr("its last value 3 is not its first")));
  EXPECT_THAT(problems_of(table({{0, 1}, {2, 1}}, 2)), IsEmpty());
}

TEST(MakeSignal, ReadsFilesOfNumbers) {
  const TemporaryFolder folder;
  std::ofstream(folder / "q.csv") << "# a comment\r\n\ntime, flow rate\r\n0, 1e0\n0.5;+2 # here\n 1\t1\n";
  SignalConfig config;
  config.csv = "q.csv";
  config.period = 1;
  const auto signal = make_signal(config, folder.path()), same = make_signal(table({{0, 1}, {0.5, 2}, {1, 1}}, 1), ".");
  for (double t = 0; t < 3; t += 0.07) EXPECT_EQ(signal.value(t), same.value(t));
}

TEST(MakeSignal, NamesTheLineOfABadFile) {
  const TemporaryFolder folder;
  const auto problems = [&](const std::string& text) {
    std::ofstream(folder / "q.csv") << text;
    SignalConfig config;
    config.csv = "q.csv";
    return problems_in([&] { make_signal(config, folder.path()); });
  };
  EXPECT_THAT(problems("t,q\n0,1\n1\n2,x\n3,4,5\n"), ElementsAre(AllOf(HasSubstr("csv"), HasSubstr("q.csv:3:")),
                                                                 HasSubstr("q.csv:4:"), HasSubstr("q.csv:5:")));
  EXPECT_THAT(problems("0,1\n1,2\n1,3\n"), ElementsAre(AllOf(HasSubstr("q.csv:3:"), HasSubstr("not greater"))));
  EXPECT_THAT(problems("0,1\n1,nan\n"), ElementsAre(HasSubstr("q.csv:2:")));
  EXPECT_THAT(problems("t,q\nu,v\n"), ElementsAre(HasSubstr("q.csv:2:")));
  EXPECT_THAT(problems("# nothing\n"), ElementsAre(HasSubstr("no line of numbers")));
  SignalConfig missing;
  missing.csv = "nowhere.csv";
  EXPECT_THAT(problems_in([&] { make_signal(missing, folder.path()); }),
              ElementsAre(AllOf(HasSubstr("nowhere.csv"), HasSubstr("cannot be opened"))));
}

TEST(MakeSignalOrFormula, TakesANameOrAFormula) {
  Signals signals;
  signals.emplace("beat", make_signal(formula("2*t", 1.0), "."));
  EXPECT_NEAR(make_signal_or_formula("beat", signals).value(1.25), 0.5, 1e-15);
  EXPECT_EQ(make_signal_or_formula("2*t", signals).value(1.25), 2.5);
  EXPECT_EQ(make_signal_or_formula("0.7", {}).value(3), 0.7);
  EXPECT_THAT(problems_in([&] { make_signal_or_formula("baet", signals); }),
              ElementsAre(AllOf(HasSubstr("\"baet\" is neither a signal"), HasSubstr("the case has: beat"))));
}

TEST(CheckSignals, FindsAllThatIsWrongAtOnce) {
  CaseConfig config;
  config.file = "case.toml";
  config.time.end = 2;
  config.signals["late"] = formula("sqrt(1-t)");
  config.signals["broken"] = formula("1 +");
  config.signals["t"] = formula("1");
  config.signals["beat"] = formula("t", 1.0);
  PatchConfig patch;
  patch.radius = 0.1;
  WallSide wall;
  for (const char* rate : {"broken", "unknown_name", "beat", "3*t"}) {
    patch.name = "p" + std::to_string(wall.patches.size());
    patch.flow_rate = rate;
    patch.phase = {0.1, 0.4};
    wall.patches.push_back(patch);
  }
  config.boundary[4] = wall;
  InflowSide inflow;
  inflow.signal = "sin(";
  config.boundary[0] = inflow;
  std::vector<std::string> problems;
  check_signals(config, {}, problems);
  EXPECT_THAT(
      problems,
      testing::UnorderedElementsAre(
          AllOf(HasSubstr("signals.broken.formula"), HasSubstr("character")),
          AllOf(HasSubstr("signals.late has no finite value at t = 1.001")), HasSubstr("signals.t cannot be told"),
          AllOf(HasSubstr("boundary.z-.patches.p1.flow_rate"), HasSubstr("neither a signal")),
          AllOf(HasSubstr("boundary.z-.patches.p3.phase"), HasSubstr("has none")), HasSubstr("boundary.x-.signal")));
}

}  // namespace
}  // namespace pliant
