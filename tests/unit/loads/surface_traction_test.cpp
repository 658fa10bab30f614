#include "loads/surface_traction.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "mesh/geometry.hpp"
#include "mesh/shapes/icosphere.hpp"

namespace pliant {
namespace {

constexpr double mu = 0.7;

/// u = u0 + G x, p = p0 + g . x
struct LinearFlow : FlowSampler {
  Vec3 u0, pressure_gradient;
  Mat3 gradient;
  double p0 = 0;
  void sample(std::span<const Vec3> points, std::span<FlowSample> samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i)
      samples[i] = {u0 + gradient * points[i], gradient, p0 + dot(pressure_gradient, points[i])};
  }
};

std::vector<VertexLoad> loads_of(const Surface& s, const TractionConfig& config, const FlowSampler& flow,
                                 double probe = 0.1) {
  SurfaceTraction traction(config, mu, probe, s.mesh, s.positions);
  traction.sample(flow, s.mesh, s.positions);
  std::vector<VertexLoad> loads(s.positions.size());
  traction.evaluate(s.mesh, s.positions, loads);
  return loads;
}

Vec3 total_force(const std::vector<VertexLoad>& loads, Vec3 velocity = {}) {
  Vec3 sum;
  for (const auto& load : loads) sum += load.force + load.drag * (load.drag_velocity - velocity);
  return sum;
}

TractionConfig form(TractionForm f) {
  TractionConfig config;
  config.form = f;
  return config;
}

TEST(SurfaceTraction, DragOfASphereIsCoefficientTimesAreaTimesSlip) {
  const Surface s = make_icosphere(6, 1.5);
  LinearFlow flow;
  flow.u0 = {2, 0, 1};
  TractionConfig config = form(TractionForm::drag);
  config.coefficient = 12;
  const double radius = std::cbrt(3 * enclosed_volume(s.mesh, s.positions) / (4 * std::numbers::pi));
  const Vec3 force = total_force(loads_of(s, config, flow), {0.5, 0, 0});
  const double c = 12 * mu / radius * total_area(s.mesh, s.positions);
  EXPECT_NEAR(force.x, c * 1.5, 1e-12 * c);
  EXPECT_NEAR(force.y, 0, 1e-12 * c);
  EXPECT_NEAR(force.z, c, 1e-12 * c);
}

TEST(SurfaceTraction, CurrentAreaFollowsTheShapeAndReferenceAreaDoesNot) {
  const Surface rest = make_icosphere(4, 1.0);
  auto stretched = rest.positions;
  for (Vec3& x : stretched) x *= 2;
  LinearFlow flow;
  flow.u0 = {1, 0, 0};
  for (DragArea area : {DragArea::reference, DragArea::current}) {
    TractionConfig config = form(TractionForm::drag);
    config.area = area;
    SurfaceTraction traction(config, mu, 0.1, rest.mesh, rest.positions);
    std::vector<VertexLoad> before(rest.positions.size()), after(rest.positions.size());
    traction.sample(flow, rest.mesh, rest.positions);
    traction.evaluate(rest.mesh, rest.positions, before);
    traction.evaluate(rest.mesh, stretched, after);
    const double ratio = total_force(after).x / total_force(before).x;
    EXPECT_NEAR(ratio, area == DragArea::current ? 4.0 : 1.0, 1e-12);
  }
}

// The drag velocity between two samples continues a linear flow exactly.
TEST(SurfaceTraction, LinearFlowIsContinuedExactlyBetweenSamples) {
  const Surface s = make_icosphere(3, 1.0);
  LinearFlow flow;
  flow.u0 = {0.1, -0.3, 0.2};
  flow.gradient = {{{0.3, -1, 2}, {0.4, 0.5, -0.6}, {1, 1, -0.8}}};
  SurfaceTraction traction(form(TractionForm::drag), mu, 0.1, s.mesh, s.positions);
  traction.sample(flow, s.mesh, s.positions);
  auto moved = s.positions;
  for (Vec3& x : moved) x += Vec3{0.3, 0.2 * x.x, -0.1};
  std::vector<VertexLoad> loads(moved.size());
  traction.evaluate(s.mesh, moved, loads);
  for (std::size_t v = 0; v < moved.size(); ++v)
    EXPECT_LT(norm(loads[v].drag_velocity - (flow.u0 + flow.gradient * moved[v])), 1e-14);
}

// A uniform pressure pushes nowhere; a linear one gives Archimedes' force on the polyhedron, up to the probe's distance:
// the probes see the pressure of a surface that is thicker by h, whose volume is known for a sphere.
TEST(SurfaceTraction, PressureGivesBuoyancy) {
  const Surface s = make_icosphere(4, 1.0);
  LinearFlow flow;
  flow.p0 = 5;
  for (TractionForm f : {TractionForm::one_sided, TractionForm::gradient}) {
    EXPECT_LT(norm(total_force(loads_of(s, form(f), flow))), 1e-12);
    LinearFlow hydrostatic;
    hydrostatic.pressure_gradient = {0, 0, -3};
    const double h = 1e-6;
    const Vec3 force = total_force(loads_of(s, form(f), hydrostatic, h));
    EXPECT_NEAR(force.z, 3 * enclosed_volume(s.mesh, s.positions), 20 * h);
    EXPECT_LT(std::abs(force.x) + std::abs(force.y), 1e-12);
  }
}

// A uniform stress is in equilibrium on a closed surface and its first moment is the stress times the volume.
TEST(SurfaceTraction, UniformStressIsInEquilibrium) {
  const Surface s = make_icosphere(4, 1.0);
  LinearFlow flow;
  flow.gradient = {{{0, 0, 2}, {0, 0, 0}, {0, 0, 0}}};
  const auto loads = loads_of(s, form(TractionForm::gradient), flow);
  EXPECT_LT(norm(total_force(loads)), 1e-13);
  double xz = 0, zx = 0, xx = 0;
  for (std::size_t v = 0; v < loads.size(); ++v) {
    xz += s.positions[v].z * loads[v].force.x;
    zx += s.positions[v].x * loads[v].force.z;
    xx += s.positions[v].x * loads[v].force.x;
  }
  const double expected = 2 * mu * enclosed_volume(s.mesh, s.positions);
  EXPECT_NEAR(xz, expected, 1e-12);
  EXPECT_NEAR(zx, expected, 1e-12);
  EXPECT_NEAR(xx, 0, 1e-12);
}

// An open sheet in a uniform stress and pressure feels both sides cancel; in a shear flow one-sided tractions add up.
TEST(SurfaceTraction, OpenSurfacesAreLoadedOnBothSides) {
  Surface sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.mesh = TriangleMesh(4, {{0, 1, 2}, {0, 2, 3}});
  LinearFlow flow;
  flow.p0 = 3;
  flow.gradient = {{{0, 0, 2}, {0, 0, 0}, {0, 0, 0}}};
  EXPECT_LT(norm(total_force(loads_of(sheet, form(TractionForm::gradient), flow))), 1e-13);
  EXPECT_LT(norm(total_force(loads_of(sheet, form(TractionForm::one_sided), flow))), 1e-13);
  flow.u0 = {1, 0, 0};
  const Vec3 drag = total_force(loads_of(sheet, form(TractionForm::one_sided), flow));
  EXPECT_NEAR(drag.x, 2 * mu / 0.1, 1e-12);
}

}  // namespace
}  // namespace pliant
