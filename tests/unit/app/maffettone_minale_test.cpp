#include "app/maffettone_minale.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace pliant {
namespace {

// L, B, W and the angle integrated from the tensor equation of the model to its steady state.
TEST(MaffettoneMinale, MatchesTheSteadyStateOfTheTensorEquation) {
  struct Row {
    double ca, major, minor, vortical, angle;
  };
  for (const auto& row : {Row{0.05, 1.0571, 0.9478, 0.9980, 41.88}, Row{0.10, 1.1190, 0.9007, 0.9922, 38.83},
                          Row{0.20, 1.2547, 0.8206, 0.9712, 33.19}, Row{0.40, 1.5565, 0.7063, 0.9096, 24.41}}) {
    const auto shape = maffettone_minale(row.ca);
    EXPECT_NEAR(shape.major, row.major, 6e-5);
    EXPECT_NEAR(shape.minor, row.minor, 6e-5);
    EXPECT_NEAR(shape.vortical, row.vortical, 6e-5);
    EXPECT_NEAR(shape.angle, row.angle, 6e-3);
  }
}

TEST(MaffettoneMinale, KeepsTheVolume) {
  for (double ratio : {0.5, 1.0, 3.0}) {
    const auto shape = maffettone_minale(0.25, ratio);
    EXPECT_NEAR(shape.major * shape.minor * shape.vortical, 1, 1e-14);
  }
}

TEST(MaffettoneMinale, FitFindsTheCapillaryNumberOfItsOwnShapes) {
  for (double ca : {0.02, 0.1, 0.3, 0.7}) {
    const auto shape = maffettone_minale(ca);
    const auto fit = fit_capillary(shape.major, shape.minor);
    EXPECT_NEAR(fit.capillary, ca, 1e-7);
    EXPECT_LT(fit.residual, 1e-7);
  }
}

TEST(MaffettoneMinale, FitRefusesShapesBeyondTheModel) { EXPECT_THROW(fit_capillary(9, 0.2), RunError); }

}  // namespace
}  // namespace pliant
