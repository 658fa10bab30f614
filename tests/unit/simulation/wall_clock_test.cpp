#include "simulation/wall_clock.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace pliant {
namespace {

TEST(WallClock, ReadsHoursMinutesAndSeconds) {
  EXPECT_EQ(parse_wall_clock("02:50"), 10200);
  EXPECT_EQ(parse_wall_clock("2:50:30"), 10230);
  EXPECT_EQ(parse_wall_clock("100:00"), 360000);
  for (const char* wrong : {"", "10", "1:60", "1:00:60", "1:2", "-1:00", "1:00:00:00", "one:two"})
    EXPECT_THROW(parse_wall_clock(wrong), InputError) << wrong;
}

TEST(WallClock, KeepsWhatIsReservedForTheEnd) {
  const auto now = WallClock::Clock::now();
  EXPECT_FALSE(WallClock(std::nullopt, now).is_time_to_stop(1e9));
  const WallClock hour(3600, now);
  EXPECT_FALSE(hour.is_time_to_stop(3000));
  EXPECT_TRUE(hour.is_time_to_stop(3600 - 72)) << "a margin of 2 % and a second is left";
  EXPECT_TRUE(WallClock(3600, now - std::chrono::seconds(3599)).is_time_to_stop(0));
}

}  // namespace
}  // namespace pliant
