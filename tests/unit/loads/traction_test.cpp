#include "loads/traction.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "linear_flow.hpp"
#include "mesh/geometry.hpp"

namespace pliant {
namespace {

VertexLoads loads_of(const DeformableBody& body, const FlowSampler& flow, double viscosity) {
  VertexLoads loads;
  Traction(body, flow, {1.0, viscosity}).evaluate(body, ShapeState(body.mesh, body.positions), loads);
  return loads;
}

/// Sum of the forces on vertices that stand still.
Vec3 net_force(const VertexLoads& loads) {
  Vec3 sum;
  for (std::size_t v = 0; v < loads.forces.size(); ++v)
    sum += loads.forces[v] + loads.drag[v] * loads.flow_velocities[v];
  return sum;
}

TEST(Traction, DragIsProportionalToViscosityAndArea) {
  auto config = sphere_config(4, TractionForm::drag);
  config.traction.coefficient = 50;
  const auto body = body_of(config);
  LinearFlow flow;
  flow.velocity = {3, 0, 0};
  const auto loads = loads_of(body, flow, 0.2);
  const double area = total_area(body.mesh, body.positions);
  EXPECT_NEAR(net_force(loads).x, 50 * 0.2 * area / body.radius * 3, 1e-11);
  for (const Vec3& f : loads.forces) EXPECT_EQ(f, Vec3{});
}

TEST(Traction, PressureAloneIsBuoyancy) {
  // grad p = const: the force is -V grad p, exactly for the polyhedron when p is taken at the centroid (probe -> 0).
  for (auto form : {TractionForm::one_sided, TractionForm::gradient}) {
    auto config = sphere_config(3, form);
    config.center = {1, 2, 3};
    config.traction.probe_length = 1e-9;
    const auto body = body_of(config);
    LinearFlow flow;
    flow.pressure = 5;
    flow.pressure_gradient = {0.3, 0, -2};
    const double volume = enclosed_volume(body.mesh, body.positions);
    EXPECT_LT(norm(net_force(loads_of(body, flow, 0.0)) + volume * flow.pressure_gradient), 1e-7);
  }
}

TEST(Traction, GradientOfALinearFlowIsItsStressTimesTheNormal) {
  const auto body = body_of(sphere_config(4, TractionForm::gradient), 0.2);
  const double mu = 0.7, rate = 2.0;
  const auto loads = loads_of(body, make_shear(rate), mu);
  // First moment: sum F x^T = mu (G + G^T) V, exactly, since sum A n c^T = V I over a polyhedron's faces.
  double xz = 0, zx = 0, xx = 0;
  for (std::size_t v = 0; v < body.positions.size(); ++v) {
    xz += loads.forces[v].x * body.positions[v].z;
    zx += loads.forces[v].z * body.positions[v].x;
    xx += loads.forces[v].x * body.positions[v].x;
  }
  const double volume = enclosed_volume(body.mesh, body.positions);
  EXPECT_NEAR(xz, mu * rate * volume, 1e-12);
  EXPECT_NEAR(zx, mu * rate * volume, 1e-12);
  EXPECT_NEAR(xx, 0, 1e-12);
  EXPECT_LT(norm(net_force(loads)), 1e-12);
}

TEST(Traction, OneSidedIsTheSlipOverTheProbe) {
  auto config = sphere_config(4, TractionForm::one_sided);
  config.traction.probe_length = 0.1;
  const auto body = body_of(config);
  LinearFlow flow;
  flow.velocity = {0, 3, 0};
  const auto loads = loads_of(body, flow, 0.7);
  const double area = total_area(body.mesh, body.positions);
  EXPECT_NEAR(net_force(loads).y, 0.7 * 3 / 0.1 * area, 1e-10);
}

TEST(Traction, FollowsMovedVerticesInALinearFlow) {
  for (auto form : {TractionForm::drag, TractionForm::one_sided}) {
    auto body = body_of(sphere_config(3, form), 0.1);
    const auto flow = make_shear(2.0);
    const Traction at_start(body, flow, {});
    for (Vec3& x : body.positions) x += Vec3{0.1 * x.z, 0.2, 0.3 * x.x};
    const ShapeState shape(body.mesh, body.positions);
    VertexLoads continued, sampled;
    at_start.evaluate(body, shape, continued);
    Traction(body, flow, {}).evaluate(body, shape, sampled);
    for (std::size_t v = 0; v < body.positions.size(); ++v) {
      EXPECT_LT(norm(continued.flow_velocities[v] - sampled.flow_velocities[v]), 1e-13);
      EXPECT_NEAR(continued.drag[v], sampled.drag[v], 1e-13);
    }
  }
}

TEST(Traction, NoneIsNothing) {
  const auto body = body_of(sphere_config(2, TractionForm::none));
  EXPECT_EQ(net_force(loads_of(body, make_shear(1.0), 1.0)), Vec3{});
}

}  // namespace
}  // namespace pliant
