#include "simulation/ejection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/error.hpp"
#include "mesh/geometry.hpp"

namespace pliant {
namespace {

CaseConfig pump(const std::string& formula) {
  CaseConfig config;
  config.box.size = {10, 10, 10};
  BodyConfig tube;
  tube.name = "sack";
  tube.surface = CylinderSurface{1, 2, 0.25, CylinderEnds::open};
  tube.center = {5, 5, 5};
  tube.rotation = {{1, 0, 0}, 30};
  config.bodies = {tube};
  SignalConfig beat;
  beat.formula = formula;
  beat.period = 2;
  beat.scale = 17;
  config.signals["beat"] = beat;
  CavityConfig cavity;
  cavity.name = "heart";
  cavity.body = "sack";
  cavity.flow = "beat";
  cavity.ejection_fraction = 0.3;
  config.cavities = {cavity};
  return config;
}

Ejection fit(CaseConfig& config) { return set_ejection_scales(config, place_bodies(config)).at(0); }

TEST(Ejection, ACycleThatBeginsWithFillingBeginsAtTheSmallestVolume) {
  auto config = pump("sin(pi*t)");  // brings in 2/pi, then takes it out
  const auto found = fit(config);
  EXPECT_EQ(found.signal, "beat");
  EXPECT_NEAR(found.start_volume, 2 * std::numbers::pi, 0.2);
  EXPECT_EQ(found.smallest_volume, found.start_volume);
  EXPECT_NEAR(found.largest_volume, found.start_volume / 0.7, 1e-12);
  EXPECT_NEAR(found.scale * 2 / std::numbers::pi, found.largest_volume - found.start_volume, 1e-9);
  EXPECT_EQ(config.signals["beat"].scale, found.scale);
  // What is set already stays.
  EXPECT_EQ(fit(config).scale, found.scale);
}

TEST(Ejection, ACycleThatBeginsWithEmptyingBeginsAtTheLargest) {
  auto config = pump("sin(pi*t)");
  config.cavities[0].flow_factor = -0.5;
  const auto found = fit(config);
  EXPECT_NEAR(found.largest_volume, found.start_volume, 1e-9);
  EXPECT_NEAR(found.smallest_volume, 0.7 * found.start_volume, 1e-9);
  EXPECT_NEAR(found.scale * 0.5 * 2 / std::numbers::pi, 0.3 * found.start_volume, 1e-9);
}

TEST(Ejection, ACycleMayBeginAnywhere) {
  auto config = pump("cos(pi*t)");
  const auto found = fit(config);
  EXPECT_NEAR((found.largest_volume - found.smallest_volume) / found.largest_volume, 0.3, 1e-12);
  EXPECT_NEAR(0.5 * (found.largest_volume + found.smallest_volume), found.start_volume, 1e-9);
}

TEST(Ejection, RefusesFlowsThatMakeNoCycle) {
  const auto refusal = [](CaseConfig config) {
    try {
      fit(config);
    } catch (const InputError& error) { return std::string(error.what()); }
    return std::string("not refused");
  };
  EXPECT_THAT(refusal(pump("0.1 + sin(pi*t)")), testing::HasSubstr("of its stroke larger after each cycle"));
  EXPECT_THAT(refusal(pump("0*t")), testing::HasSubstr("moves nothing"));
  auto endless = pump("sin(pi*t)");
  endless.signals["beat"].period.reset();
  EXPECT_THAT(refusal(endless), testing::HasSubstr("has no period"));
  endless.cavities[0].period = 2;
  fit(endless);
}

}  // namespace
}  // namespace pliant
