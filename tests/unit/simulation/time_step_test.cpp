#include "simulation/time_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulation/progress.hpp"
#include "simulation/schedule.hpp"

namespace pliant {
namespace {

CaseConfig channel() {
  CaseConfig config;
  config.box.size = {2, 2, 1};
  config.box.cells = {20, 20, 10};
  config.boundary[4] = WallSide{};
  config.boundary[5] = WallSide{{3, 4, 0}};
  config.time.cfl = 0.5;
  config.fluid.density = 2;
  config.fluid.viscosity = 1;
  return config;
}

StepLimits limits_of(const CaseConfig& config, double rate, double viscous = no_limit) {
  return step_limits(config, Grid(config.box, config.boundary, Communicator(MPI_COMM_SELF)), rate, viscous);
}

TEST(StepLimits, CountTheWallsBeforeTheFlowMoves) {
  // h = 0.1 in all directions; the wall's rate is (3 + 4)/0.1 = 70.
  EXPECT_NEAR(limits_of(channel(), 0).smallest(), 0.5 / 70, 1e-15);
  EXPECT_NEAR(limits_of(channel(), 100).smallest(), 0.5 / 100, 1e-15);
}

TEST(StepLimits, FollowTheForceFromRest) {
  auto config = channel();
  config.boundary[5] = WallSide{};
  config.forcing.acceleration = {8, 0, 0};
  // a dt^2 / h = cfl
  EXPECT_NEAR(limits_of(config, 0).acceleration, std::sqrt(0.5 * 0.1 / 8), 1e-15);
  // Once the flow moves the force does not count any more.
  EXPECT_EQ(limits_of(config, 1).acceleration, no_limit);
  EXPECT_NEAR(limits_of(config, 1).convective, 0.5, 1e-15);
}

TEST(StepLimits, FollowTheDecayAsAFlowDiesDown) {
  auto config = channel();
  config.boundary[5] = WallSide{};
  const double wave_number = std::numbers::pi;  // of the longest wave, 2 pi / 2
  EXPECT_NEAR(limits_of(config, 1e-9).smallest(), 0.1 / (0.5 * wave_number * wave_number), 1e-15);
}

TEST(StepLimits, NameTheOneThatRules) {
  auto config = channel();
  EXPECT_NE(limits_of(config, 0).ruling().find("cfl"), std::string::npos);
  EXPECT_NE(limits_of(config, 0, 1e-6).ruling().find("viscous"), std::string::npos);
  EXPECT_NEAR(limits_of(config, 0, 1e-6).smallest(), viscous_margin * 1e-6, 1e-20);
  config.time.max_step = 1e-5;
  EXPECT_NE(limits_of(config, 0).ruling().find("max_step"), std::string::npos);
  config.time.step = 0.125;
  EXPECT_EQ(limits_of(config, 0).smallest(), 0.125);
  EXPECT_NE(limits_of(config, 0).ruling().find("time.step"), std::string::npos);
}

TEST(StepLimits, StayFiniteWhereNothingMoves) {
  auto config = channel();
  config.boundary[5] = WallSide{};
  EXPECT_NEAR(limits_of(config, 0).smallest(), 0.1 * 0.1 / 0.5, 1e-15);
}

TEST(StepTowards, HitsTheEventWithEqualSteps) {
  double time = 0;
  int steps = 0;
  const double limit = 0.3, event = 1.0;
  double shortest = limit, longest = 0;
  while (time < event) {
    const double step = step_towards(limit, event - time);
    shortest = std::min(shortest, step);
    longest = std::max(longest, step);
    time = step == event - time ? event : time + step;
    ++steps;
  }
  EXPECT_EQ(time, event);
  EXPECT_EQ(steps, 4);
  EXPECT_NEAR(shortest, longest, 1e-14);
}

TEST(StepTowards, KeepsAGivenStepToTheBit) {
  double time = 0;
  for (int n = 0; n < 999; ++n) {
    ASSERT_EQ(step_towards(1e-3, 1.0 - time), 1e-3) << "step " << n;
    time += 1e-3;
  }
  EXPECT_NEAR(step_towards(1e-3, 1.0 - time), 1e-3, 1e-12);
}

TEST(Schedule, ComesBackAtMultiplesOfTheInterval) {
  Schedule schedule(SeriesConfig{0.1, {}, {}});
  double time = 0;
  for (int n = 1; n <= 1000; ++n) {
    const double next = schedule.next_time(time);
    ASSERT_NEAR(next, 0.1 * n, 1e-12);
    ASSERT_TRUE(schedule.is_due(n, next));
    ASSERT_FALSE(schedule.is_due(n, next - 0.03));
    time = next;
  }
}

TEST(Schedule, ComesBackAfterANumberOfSteps) {
  Schedule schedule(SeriesConfig{{}, 5, {}});
  EXPECT_EQ(schedule.next_time(1), no_limit);
  EXPECT_TRUE(schedule.is_due(0, 0));
  EXPECT_FALSE(schedule.is_due(4, 0.4));
  EXPECT_TRUE(schedule.is_due(10, 0.9));
  EXPECT_FALSE(Schedule(SeriesConfig{}).is_due(0, 0)) << "nothing was asked for";
}

TEST(Progress, CountsTimeAsPeopleDo) {
  EXPECT_EQ(format_duration(65.4), "1:05");
  EXPECT_EQ(format_duration(3723), "1:02:03");
  EXPECT_EQ(format_duration(HUGE_VAL), "--:--");
}

TEST(Schedule, GoesByPhases) {
  const double period = 28.8;
  Schedule schedule(SeriesConfig{{}, {}, {0.3, 0}}, period);
  EXPECT_TRUE(schedule.is_due(0, 0));
  EXPECT_FALSE(Schedule(SeriesConfig{{}, {}, {0.3}}, period).is_due(0, 0)) << "the start is no wanted phase";
  double time = 0;
  for (int n = 1; n <= 2000; ++n) {
    time = schedule.next_time(time);
    EXPECT_DOUBLE_EQ(time, period * (n / 2 + (n % 2 == 1 ? 0.3 : 0)));
    EXPECT_TRUE(schedule.is_due(n, time));
    EXPECT_FALSE(schedule.is_due(n, time + 1e-6));
  }
  Schedule both(SeriesConfig{10.0, {}, {0.3}}, period);
  EXPECT_DOUBLE_EQ(both.next_time(0), 0.3 * period);
  EXPECT_DOUBLE_EQ(both.next_time(0.3 * period), 10);
  EXPECT_TRUE(both.is_due(0, 0));
}

}  // namespace
}  // namespace pliant
