#include "structure/advance_vertices.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "small_bodies.hpp"
#include "structure/stable_time_step.hpp"

namespace pliant {
namespace {

VertexLoads no_loads(const DeformableBody& body) {
  VertexLoads loads;
  loads.assign(body.positions.size());
  return loads;
}

void advance(DeformableBody& body, const VertexLoads& loads, double step, int steps) {
  ShapeState shape(body.mesh);
  for (int i = 0; i < steps; ++i) {
    shape.update(body.positions);
    advance_vertices(body, shape, loads, step);
  }
}

/// A tetrahedron of springs, pulled out evenly: its breathing mode has omega^2 = 4 k / m.
DeformableBody breathing_tetrahedron(double stiffness, double mass, double stretch) {
  auto body = make_plain_body(make_tetrahedron(), mass);
  body.potentials.add(EdgeSprings::uniform(body.mesh, body.positions, stiffness, 1.0));
  const Vec3 centre = mean_position(body.positions);
  for (Vec3& x : body.positions) x = centre + (1 + stretch) * (x - centre);
  return body;
}

TEST(AdvanceVertices, OscillatesWithTheRightPeriod) {
  auto body = breathing_tetrahedron(9.0, 4.0, 0.1);  // the mode stays linear: all edges have one length
  const auto start = body.positions;
  const int steps = 4000;
  advance(body, no_loads(body), 2 * std::numbers::pi / 3.0 / steps, steps);
  for (std::size_t v = 0; v < start.size(); ++v) EXPECT_LT(norm(body.positions[v] - start[v]), 1e-3 * 0.1);
}

TEST(AdvanceVertices, EnergyDoesNotDriftInAThousandPeriods) {
  auto body = breathing_tetrahedron(9.0, 4.0, 0.1);
  const double step = 0.05 * stable_time_step(3.0, 0.0);
  const auto energy = [&] { return kinetic_energy(body) + body.potentials.energy(body.mesh, body.positions); };
  const double start = energy();
  double least = start, most = start;
  for (int i = 0; i < 1000; ++i) {
    advance(body, no_loads(body), step, 63);
    least = std::min(least, energy());
    most = std::max(most, energy());
  }
  EXPECT_GT(least, 0.94 * start);  // semi-implicit Euler: the energy swings by omega h / 2 = 0.05 either way, for ever
  EXPECT_LT(most, 1.06 * start);
}

TEST(AdvanceVertices, KeepsMomentumAndAngularMomentum) {
  auto body = make_plain_body(make_icosphere(2, 1.0), 0.5);
  body.potentials.add(EdgeSprings::uniform(body.mesh, body.positions, 3.0, 0.8));
  body.potentials.add(Bending::about_flat(body.mesh, 0.2));
  body.potentials.add(VolumePenalty{5.0, 4.0});
  for (std::size_t v = 0; v < body.positions.size(); ++v)
    body.velocities[v] = 0.1 * Vec3{std::sin(1.0 + v), std::cos(3.0 * v), std::sin(7.0 * v)};
  const auto momenta = [&] {
    std::pair<Vec3, Vec3> sums;
    for (std::size_t v = 0; v < body.positions.size(); ++v) {
      sums.first += body.masses[v] * body.velocities[v];
      sums.second += body.masses[v] * cross(body.positions[v], body.velocities[v]);
    }
    return sums;
  };
  const auto [linear, angular] = momenta();
  advance(body, no_loads(body), 0.01, 500);
  EXPECT_LT(norm(momenta().first - linear), 1e-12);
  EXPECT_LT(norm(momenta().second - angular), 1e-12);
}

TEST(AdvanceVertices, ReachesTheTerminalVelocityWhateverTheStep) {
  for (double step : {1e-3, 1.0, 1e3}) {  // c / m = 50: explicit drag would fail above 0.04
    auto body = make_plain_body(make_tetrahedron(), 0.1);
    auto loads = no_loads(body);
    for (std::size_t v = 0; v < 4; ++v) {
      loads.drag[v] = 5.0;
      loads.flow_velocities[v] = {2, 0, 0};
      loads.forces[v] = {0, 10, 0};
    }
    advance(body, loads, step, 1000);
    for (const Vec3& velocity : body.velocities) EXPECT_LT(norm(velocity - Vec3{2, 2, 0}), 1e-12);
  }
}

TEST(AdvanceVertices, DecaysAtTheRateOfTheDamping) {
  auto body = make_plain_body(make_tetrahedron(), 2.0);
  body.damping = 3.0;
  for (Vec3& v : body.velocities) v = {1, 0, 0};
  advance(body, no_loads(body), 1e-4, 10000);
  for (const Vec3& v : body.velocities) EXPECT_NEAR(v.x, std::exp(-1.5), 1e-4);
}

TEST(AdvanceVertices, IsStableJustBelowTheLimitAndNotAbove) {
  for (double damping : {0.0, 40.0}) {
    for (double fraction : {0.98, 1.02}) {
      auto body = breathing_tetrahedron(9.0, 4.0, 1e-6);
      body.damping = damping;
      advance(body, no_loads(body), fraction * stable_time_step(3.0, damping / 4.0), 2000);
      const double departure = norm(body.positions[0] - body.reference[0]);
      if (fraction < 1) {
        EXPECT_LT(departure, 1e-4);
      } else {
        EXPECT_FALSE(departure < 1e-2);  // may be past all numbers
      }
    }
  }
}

TEST(AdvanceVertices, BrokenMotionIsNamed) {
  auto body = make_plain_body(make_tetrahedron(), 2.0);
  require_finite(body);
  body.positions[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(require_finite(body), RunError);
}

}  // namespace
}  // namespace pliant
