#include "coupling/one_way.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/error.hpp"
#include "diagnostics/shape.hpp"
#include "linear_flow.hpp"

namespace pliant {
namespace {

/// Springs of rest length 0 and a volume: the motion of the moments is then the Maffettone-Minale equation.
BodyConfig prestressed_drop(double stiffness) {
  auto config = sphere_config(4, TractionForm::drag);
  config.mass_per_vertex = 0.05;
  config.potentials.edge = EdgeConfig{stiffness, 0.0};
  config.potentials.volume = VolumeConfig{2e5};
  return config;
}

TEST(OneWay, FixedBodiesStay) {
  auto config = sphere_config(2, TractionForm::drag);
  config.motion = MotionKind::fixed;
  auto body = body_of(config);
  EXPECT_EQ(advance_one_way(body, make_shear(1.0), {}, 0.1), 0);
  EXPECT_EQ(body.positions, body.reference);
}

TEST(OneWay, AFreeSheetIsCarriedByTheFlow) {
  auto config = sphere_config(2, TractionForm::drag);
  config.mass_per_vertex = 1e-9;
  auto body = body_of(config);
  LinearFlow flow;
  flow.velocity = {1, 2, 3};
  for (int i = 0; i < 10; ++i) advance_one_way(body, flow, {}, 0.1);
  for (std::size_t v = 0; v < body.positions.size(); ++v)
    EXPECT_LT(norm(body.positions[v] - body.reference[v] - flow.velocity), 1e-7);
}

TEST(OneWay, PrestressedDropFollowsMaffettoneAndMinale) {
  const double capillary = 0.1, f1 = 16.0 / 35.0;
  // sigma = 4 sqrt(3) k / (f1 c_d) = 10 mu R gamma.
  auto body = body_of(prestressed_drop(10.0 * f1 * 100 / (4 * std::sqrt(3.0))));
  const double rest = fit_ellipsoid(body.mesh, body.positions).length;
  for (int i = 0; i < 60; ++i) advance_one_way(body, make_shear(1.0), {}, 0.1);
  const auto fit = fit_ellipsoid(body.mesh, body.positions);
  const double q = f1 * f1 + capillary * capillary, w = std::pow(f1 * f1 / q, 1.0 / 6.0);
  const double l2 = (q + capillary * std::sqrt(q)) / (std::cbrt(q) * std::pow(f1 * f1, 2.0 / 3.0));
  const double b2 = (q - capillary * std::sqrt(q)) / (std::cbrt(q) * std::pow(f1 * f1, 2.0 / 3.0));
  EXPECT_NEAR(fit.length / rest / std::sqrt(l2), 1.0, 2e-3);
  EXPECT_NEAR(fit.breadth / rest / std::sqrt(b2), 1.0, 2e-3);
  EXPECT_NEAR(fit.width / rest / w, 1.0, 2e-3);
  EXPECT_NEAR(fit.angle, 0.5 * std::atan(f1 / capillary) * 180 / std::numbers::pi, 0.1);
}

TEST(OneWay, SubstepsFollowTheStabilityLimitUnlessGiven) {
  auto body = body_of(prestressed_drop(66));
  const int count = advance_one_way(body, make_shear(1.0), {}, 0.1);
  EXPECT_GT(count, 10);
  auto again = body_of(prestressed_drop(66));
  EXPECT_NEAR(advance_one_way(again, make_shear(1.0), {}, 0.05), count / 2.0, 1.0);
  again.substeps = 777;
  EXPECT_EQ(advance_one_way(again, make_shear(1.0), {}, 0.05), 777);
}

TEST(OneWay, AnUnstableMotionIsAnError) {
  auto body = body_of(prestressed_drop(66));
  body.substeps = 1;
  EXPECT_THROW(for (int i = 0; i < 1000; ++i) advance_one_way(body, make_shear(1.0), {}, 0.5), RunError);
}

}  // namespace
}  // namespace pliant
