#include "app/shear_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"

namespace pliant {
namespace {

CaseConfig shear_case() {
  CaseConfig config;
  config.box.size = {8, 8, 4};
  config.boundary[4] = WallSide{{-2, 0, 0}};
  config.boundary[5] = WallSide{{6, 0, 0}};
  return config;
}

TEST(ShearCalibration, ShearRateComesFromTheWalls) { EXPECT_DOUBLE_EQ(shear_rate(shear_case()), 2.0); }

TEST(ShearCalibration, OtherFlowsAreRefused) {
  auto still = shear_case();
  still.boundary[5] = WallSide{{-2, 0, 0}};
  EXPECT_THROW(shear_rate(still), InputError);
  auto free = shear_case();
  free.boundary[4] = FreeSlipSide{};
  EXPECT_THROW(shear_rate(free), InputError);
  auto skewed = shear_case();
  skewed.boundary[5] = WallSide{{6, 1, 0}};
  EXPECT_THROW(shear_rate(skewed), InputError);
}

TEST(ShearCalibration, FindsTheTensionOfADropThatFollowsTheModel) {
  const double capillary = 0.15, viscosity = 0.7, rate = 2.0, radius = 1.5;
  const auto model = maffettone_minale(capillary);
  std::vector<ShapeSample> samples;
  // A transient, then the steady shape; uneven steps must not weigh.
  for (double time = 0; time < 20; time += time < 12 ? 0.05 : 0.01) {
    const double rest = std::exp(-4 * time);
    samples.push_back({time, model.major + rest * (1 - model.major), model.minor + rest * (1 - model.minor),
                       model.vortical, model.angle});
  }
  const auto result = calibrate_shear(samples, 10.0, viscosity, rate, radius);
  EXPECT_NEAR(result.fit.capillary, capillary, 1e-6);
  EXPECT_NEAR(result.surface_tension, viscosity * rate * radius / capillary, 1e-4);
  EXPECT_LT(result.fit.residual, 1e-6);
  EXPECT_NEAR(result.mean.angle, result.model.angle, 1e-4);
  EXPECT_LT(std::abs(result.drift), 1e-6);
}

TEST(ShearCalibration, AWindowWithoutSamplesIsAnError) {
  EXPECT_THROW(calibrate_shear({{0, 1, 1, 1, 45}, {1, 1, 1, 1, 45}}, 0.5, 1, 1, 1), RunError);
}

}  // namespace
}  // namespace pliant
