#include <gtest/gtest.h>

#include <numeric>

#include "loads/traction.hpp"
#include "unit/structure/body_of.hpp"

namespace pliant {
namespace {

struct FlowAtRest : FlowSampler {
  void sample(std::span<const Vec3>, std::span<FlowSample> samples) const override {
    for (auto& sample : samples) sample = {};
  }
};

/// Sum of the drags of a sphere whose vertices have moved out to `growth` times the radius of the start.
double total_drag(DragArea area, double growth) {
  BodyConfig config;
  config.name = "sphere";
  config.surface = SphereSurface{4, 1.0};
  config.traction.form = TractionForm::drag;
  config.traction.area = area;
  DeformableBody body = body_of(config);
  const Traction traction(body, FlowAtRest{}, FluidConfig{});
  for (Vec3& x : body.positions) x = growth * x;
  const ShapeState shape(body.mesh, body.positions);
  VertexLoads loads;
  traction.evaluate(body, shape, loads);
  traction.evaluate(body, shape, loads);  // a second call starts anew
  return std::accumulate(loads.drag.begin(), loads.drag.end(), 0.0);
}

TEST(DragArea, PresentAreaGrowsWithTheSquareOfTheRadius) {
  const double start = total_drag(DragArea::reference, 1.0);
  EXPECT_NEAR(total_drag(DragArea::current, 1.0), start, 1e-12 * start);
  EXPECT_NEAR(total_drag(DragArea::current, 2.0), 4 * start, 4e-12 * start);
}

TEST(DragArea, ReferenceAreaStays) {
  const double start = total_drag(DragArea::reference, 1.0);
  EXPECT_EQ(total_drag(DragArea::reference, 2.0), start);
}

}  // namespace
}  // namespace pliant
