#include "signals/balance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "signals/make_signal.hpp"

namespace pliant {
namespace {

using std::numbers::pi;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// E wave, diastasis, A wave and systole, of any height there.
constexpr const char* heart =
    "phase < 0.30 ? sin(pi*phase/0.30)^2 : phase < 0.42 ? 0.02 : phase < 0.62 ? 0.15*sin(pi*(phase-0.42)/0.20)^2 : "
    "-7*sin(pi*(phase-0.62)/0.38)^2";
constexpr double period = 28.8;
/// What its positive part carries in a period: half of the lengths of waves, times their heights.
constexpr double filling = (0.15 + 0.12 * 0.02 + 0.15 * 0.10) * period;

SignalConfig beat() {
  SignalConfig config;
  config.formula = heart;
  config.period = period;
  return config;
}

std::vector<std::string> problems_of(const SignalConfig& config) {
  try {
    make_signal(config, ".");
  } catch (const InputError& error) { return error.problems(); }
  return {};
}

TEST(PeriodParts, AreThoseOfClosedForms) {
  const auto parts = parts_of_period(make_signal(beat(), "."));
  EXPECT_NEAR(parts.positive, filling, 1e-11 * filling);
  EXPECT_NEAR(parts.negative, 7 * 0.19 * period, 1e-11 * filling);
}

TEST(PeriodParts, OfStepsAreAsSharp) {
  SignalConfig config;
  config.formula = "t < 1/3 ? 2 : t < 2/3 ? -pi : 0";
  config.period = 1.1;
  const auto parts = parts_of_period(make_signal(config, "."));
  EXPECT_NEAR(parts.positive, 2.0 / 3, 1e-11);
  EXPECT_NEAR(parts.negative, pi / 3, 1e-11);
}

TEST(PeriodParts, OfATableAreThoseOfItsCubics) {
  SignalConfig config;
  config.table = {
      {0, 0}, {1, 3}, {2, 0}, {3, -3}};  // with flat tops: each half wave is two half cubics of mean 1/2 and
  config.period = 4;                     // slopes that Fritsch and Butland leave at its ends
  const auto signal = make_signal(config, ".");
  double sum = 0;
  constexpr int n = 200000;
  for (int i = 0; i < n; ++i) sum += std::max(signal.value(4.0 * (i + 0.5) / n), 0.0) * 4 / n;
  const auto parts = parts_of_period(signal);
  EXPECT_NEAR(parts.positive, sum, 1e-8);
  EXPECT_NEAR(parts.positive, parts.negative, 1e-11);
}

TEST(Balance, ScalesTheNegativePartAlone) {
  auto config = beat();
  config.balance = true;
  const auto raw = make_signal(beat(), "."), balanced = make_signal(config, ".");
  const double systole = filling / (0.19 * period);  // its height, so that the mean is zero
  for (const double phase : {0.0, 0.1, 0.15, 0.35, 0.5, 0.55}) {
    const double t = (3 + phase) * period;
    EXPECT_EQ(balanced.value(t), raw.value(t)) << phase;
  }
  for (const double phase : {0.65, 0.7, 0.81, 0.95})
    EXPECT_NEAR(balanced.value(phase * period), -systole * std::pow(std::sin(pi * (phase - 0.62) / 0.38), 2),
                1e-10 * systole)
        << phase;
  const auto parts = parts_of_period(balanced);
  EXPECT_NEAR(parts.positive, parts.negative, 1e-11 * filling);
  EXPECT_EQ(balanced.period(), period);
}

TEST(Volume, IsWhatThePositivePartCarries) {
  auto config = beat();
  config.volume = 1.7;
  const auto alone = make_signal(config, ".");
  EXPECT_NEAR(parts_of_period(alone).positive, 1.7, 1e-11);
  EXPECT_NEAR(alone.value(0.15 * period), 1.7 / filling, 1e-11);
  EXPECT_NEAR(alone.value(0.81 * period), -7 * 1.7 / filling, 1e-10) << "without balance both parts go along";
  config.balance = true;
  const auto both = make_signal(config, ".");
  const auto parts = parts_of_period(both);
  EXPECT_NEAR(parts.positive, 1.7, 1e-11);
  EXPECT_NEAR(parts.negative, 1.7, 1e-11);
}

TEST(Volume, OfATableWithUnitsIsTheSameInAnyUnits) {
  SignalConfig config;
  config.table = {{0, 0}, {100, 80}, {300, 10}, {400, -90}, {600, -1}};
  config.period = 2.0;
  config.time_unit = 2.0 / 800;
  config.value_unit = 0.37;
  config.volume = 0.4;
  config.balance = true;
  const auto signal = make_signal(config, ".");
  const auto parts = parts_of_period(signal);
  EXPECT_NEAR(parts.positive, 0.4, 1e-12);
  EXPECT_NEAR(parts.negative, 0.4, 1e-12);
  config.value_unit = 5;
  EXPECT_NEAR(make_signal(config, ".").value(0.3), signal.value(0.3), 1e-12);
}

TEST(Signals, InUnitsSeeTheirOwnTime) {
  SignalConfig config;
  config.formula = "3*t";
  config.time_unit = 0.25;
  config.value_unit = 10;
  EXPECT_DOUBLE_EQ(make_signal(config, ".").value(0.5), 60);
  config.period = 0.4;
  EXPECT_NEAR(make_signal(config, ".").value(0.5), 12, 1e-12);
  config.formula = "phase";
  EXPECT_NEAR(make_signal(config, ".").value(0.5), 2.5, 1e-12);
}

TEST(Signals, WithoutWhatIsToBeScaledAreRefused) {
  auto config = beat();
  config.balance = true;
  config.period.reset();
  config.formula = "sin(t)";
  EXPECT_THAT(problems_of(config), ElementsAre(AllOf(HasSubstr("balance"), HasSubstr("period"))));
  config.period = 1;
  config.formula = "2 + sin(t)";
  EXPECT_THAT(problems_of(config), ElementsAre(AllOf(HasSubstr("balance"), HasSubstr("no negative ones"))));
  config.balance = false;
  config.volume = 1;
  config.formula = "-1";
  EXPECT_THAT(problems_of(config), ElementsAre(AllOf(HasSubstr("volume"), HasSubstr("none"))));
  config.period.reset();
  EXPECT_THAT(problems_of(config), ElementsAre(AllOf(HasSubstr("volume"), HasSubstr("period"))));
  config.formula = "phase";
  EXPECT_FALSE(problems_of(config).empty()) << "no phase without a period";
}

TEST(SignalRange, IsThatOfOnePeriod) {
  const auto range = range_of(make_signal(beat(), "."), period);
  EXPECT_NEAR(range.largest, 1, 1e-6);
  EXPECT_NEAR(range.largest_at, 0.15 * period, 1e-9);
  EXPECT_NEAR(range.least, -7, 1e-4);
  EXPECT_NEAR(range.least_at, 0.81 * period, 0.001 * period);
}

}  // namespace
}  // namespace pliant
