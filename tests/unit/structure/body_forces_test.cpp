#include "structure/body_forces.hpp"

#include <gtest/gtest.h>

#include "mesh/shapes/icosphere.hpp"
#include "small_bodies.hpp"
#include "structure/advance_vertices.hpp"
#include "structure/stable_time_step.hpp"
#include "unit/potentials/deformed.hpp"

namespace pliant {
namespace {

template <class Item>
std::shared_ptr<const std::vector<Item>> list(std::vector<Item> items) {
  return std::make_shared<const std::vector<Item>>(std::move(items));
}

std::vector<Vec3> forces_on(const DeformableBody& body) {
  std::vector<Vec3> forces(body.positions.size());
  find_body_forces(body, ShapeState(body.mesh, body.positions), forces);
  return forces;
}

Vec3 sum_of(const std::vector<Vec3>& vectors) {
  Vec3 sum;
  for (const Vec3& v : vectors) sum += v;
  return sum;
}
Vec3 torque_of(const std::vector<Vec3>& forces, const std::vector<Vec3>& positions) {
  Vec3 sum;
  for (std::size_t v = 0; v < forces.size(); ++v) sum += cross(positions[v], forces[v]);
  return sum;
}

/// A body that has been turned and moved, shaken, and is held and pulled in every way.
DeformableBody held_body() {
  auto body = make_plain_body(make_icosphere(2, 1.0), 0.5);
  body.origin = {3, 1, -2};
  body.orientation = from_axis_angle({1, 2, -1}, 0.7);
  body.attachments.tethers = list<Tether>({{3, body.reference[3], 4.0, 0}, {5, {1, 0, 0}, 2.0, 0}});
  body.attachments.cords = list<Cord>(
      {{{1}, {}, {4, 0, 0}, 5.0, 0.5}, {{2, 4, 6}, {7, 8}, {}, 3.0, 0.2}, {{9}, {10}, {}, 3.0, 100.0}});  // slack
  body.attachments.pulls = list<Pull>({{{0, 1, 11}, {1, 2, 3}}});
  body.positions = shaken(body.positions, 0.1, 4);
  for (Vec3& x : body.positions) x = body.origin + rotate(body.orientation, x);
  return body;
}

TEST(BodyForces, OfTethersCordsAndPullsAreMinusTheGradientOfTheirEnergy) {
  auto body = held_body();
  const auto forces = forces_on(body);
  constexpr double step = 1e-5;
  for (std::size_t v = 0; v < forces.size(); ++v)
    for (int d = 0; d < 3; ++d) {
      auto moved = body.positions;
      moved[v][d] += step;
      const double ahead = attachment_energy(body, moved);
      moved[v][d] -= 2 * step;
      EXPECT_NEAR(forces[v][d], -(ahead - attachment_energy(body, moved)) / (2 * step), 1e-8);
    }
}

TEST(BodyForces, OfACordAreThoseOfASpringThatIsTaut) {
  auto body = make_plain_body(make_tetrahedron(), 1.0);
  body.attachments.cords = list<Cord>({{{3}, {}, body.positions[3] + Vec3{0, 0, 2}, 5.0, 1.5}});
  EXPECT_LT(norm(forces_on(body)[3] - Vec3{0, 0, 5 * 0.5}), 1e-14);
  body.positions[3].z += 0.6;  // 1.4 to go: slack
  EXPECT_EQ(norm(forces_on(body)[3]), 0);
}

TEST(BodyForces, OfACordBetweenMeansTurnNothing) {
  auto body = held_body();
  body.attachments.tethers = nullptr;
  body.attachments.pulls = nullptr;
  body.attachments.cords = list<Cord>({{{2, 4, 6}, {7, 8}, {}, 3.0, 0.2}});
  const auto forces = forces_on(body);
  EXPECT_GT(norm(forces[2]), 0.1);
  EXPECT_LT(norm(sum_of(forces)), 1e-14);
  EXPECT_LT(norm(torque_of(forces, body.positions)), 1e-13);
}

TEST(BodyForces, OfPullsAddUpToThatGiven) {
  auto body = held_body();
  body.attachments.tethers = nullptr;
  body.attachments.cords = nullptr;
  const auto forces = forces_on(body);
  EXPECT_LT(norm(sum_of(forces) - rotate(body.orientation, {1, 2, 3})), 1e-14);
  EXPECT_EQ(forces[0], forces[11]);
  EXPECT_EQ(norm(forces[2]), 0);
}

TEST(BodyForces, OfInnerDampingConserveMomentaAndTakeEnergy) {
  auto body = make_plain_body(make_icosphere(3, 1.0), 0.5);
  body.inner_damping = 2.0;
  body.positions = shaken(body.positions, 0.1, 4);
  body.velocities = shaken(body.velocities, 1.0, 5);
  const auto forces = forces_on(body);
  double power = 0;
  for (std::size_t v = 0; v < forces.size(); ++v) power += dot(forces[v], body.velocities[v]);
  double expected = 0;
  for (const auto& [a, b] : body.mesh.vertices_of_edge()) {
    const Vec3 direction = normalized(body.positions[b] - body.positions[a]);
    expected -= 2.0 * std::pow(dot(body.velocities[b] - body.velocities[a], direction), 2);
  }
  EXPECT_LT(expected, -1);
  EXPECT_NEAR(power, expected, 1e-12 * -expected);
  EXPECT_LT(norm(sum_of(forces)), 1e-13);
  EXPECT_LT(norm(torque_of(forces, body.positions)), 1e-13);
  // A rigid motion is not damped.
  for (std::size_t v = 0; v < body.positions.size(); ++v)
    body.velocities[v] = Vec3{1, 2, 3} + cross({0.3, -1, 0.5}, body.positions[v]);
  for (const Vec3& f : forces_on(body)) EXPECT_LT(norm(f), 1e-13);
}

TEST(PinnedVertices, StayAndBearTheLoad) {
  auto body = make_plain_body(make_tetrahedron(), 1.0);
  body.potentials.add(EdgeSprings::uniform(body.mesh, body.positions, 30.0, 1.0));
  body.pinned = {1, 1, 1, 0};
  body.damping = 1.0;
  const auto start = body.positions;
  VertexLoads loads;
  loads.assign(4);
  loads.forces[3] = {0, 0, -2};
  ShapeState shape(body.mesh);
  for (int n = 0; n < 20000; ++n) {
    shape.update(body.positions);
    advance_vertices(body, shape, loads, 0.01);
  }
  for (std::size_t v : {0, 1, 2}) {
    EXPECT_EQ(body.positions[v], start[v]);
    EXPECT_EQ(body.velocities[v], Vec3{});
  }
  EXPECT_LT(body.positions[3].z, start[3].z - 0.01);
  EXPECT_LT(norm(body.velocities[3]), 1e-12);
  EXPECT_LT(norm(body.forces[0] + body.forces[1] + body.forces[2] - Vec3{0, 0, -2}), 1e-10);
}

TEST(StableStep, KnowsPinnedVertices) {
  // A vertex on three springs of unit length and stiffness k, each at the angle of a tetrahedron's edge to its height:
  // along it omega^2 = 3 k cos^2 / m = 2 k / m, across it 3/2 k sin^2 / m = k / (2 m).
  auto body = make_plain_body(make_tetrahedron(), 0.5);
  body.potentials.add(EdgeSprings::uniform(body.mesh, body.positions, 7.0, 1.0));
  body.pinned = {1, 1, 1, 0};
  EXPECT_NEAR(find_largest_frequency(body), std::sqrt(2 * 7.0 / 0.5), 1e-4);
  body.masses = {0, 0, 0, 2.0};
  EXPECT_NEAR(find_largest_frequency(body), std::sqrt(2 * 7.0 / 2.0), 1e-4);
  const std::vector<double> heavy(4, 8.0);
  EXPECT_NEAR(find_largest_frequency(body, heavy), std::sqrt(2 * 7.0 / 8.0), 1e-4);
}

TEST(StableStep, KnowsTethersAndSlackCords) {
  auto body = make_plain_body(make_tetrahedron(), 0.5);
  body.attachments.tethers = list<Tether>({{2, body.positions[2], 9.0, 3.0}});
  EXPECT_NEAR(find_largest_frequency(body), std::sqrt(9.0 / 0.5), 1e-4);
  EXPECT_NEAR(find_largest_damping_rate(body, body.masses), 3.0 / 0.5, 1e-4);
  body.attachments.cords = list<Cord>({{{3}, {}, {0, 0, 3}, 40.0, 5.0}});
  EXPECT_NEAR(find_largest_frequency(body), std::sqrt(40.0 / 0.5), 1e-2);
}

/// Two vertices on one spring would do; here the breathing tetrahedron: omega^2 = 4 k / m, and the damping rate is 4 c
/// / m alike.
TEST(StableStep, KnowsInnerDamping) {
  auto body = make_plain_body(make_tetrahedron(), 2.0);
  body.inner_damping = 3.0;
  const double rate = find_largest_damping_rate(body, body.masses);
  EXPECT_NEAR(rate, 4 * 3.0 / 2.0, 1e-4);
  EXPECT_EQ(find_largest_frequency(body), 0);
  EXPECT_NEAR(stable_time_step(0.0, 0.0, rate), 2 / rate, 1e-12);

  body.potentials.add(EdgeSprings::uniform(body.mesh, body.positions, 20.0, 1.0));
  const double omega = std::sqrt(4 * 20.0 / 2.0), limit = stable_time_step(omega, 0.0, 6.0);
  EXPECT_NEAR(std::pow(omega * limit, 2) + 2 * 6.0 * limit, 4.0, 1e-12);
  const Vec3 centre = mean_position(body.positions);
  for (double fraction : {0.98, 1.02}) {
    auto moved = body;
    for (Vec3& x : moved.positions) x = centre + (1 + 1e-6) * (x - centre);
    VertexLoads loads;
    loads.assign(4);
    ShapeState shape(moved.mesh);
    for (int n = 0; n < 2000; ++n) {
      shape.update(moved.positions);
      advance_vertices(moved, shape, loads, fraction * limit);
    }
    const double departure = norm(moved.positions[0] - moved.reference[0]);
    if (fraction < 1) {
      EXPECT_LT(departure, 1e-4);
    } else {
      EXPECT_FALSE(departure < 1e-2);
    }
  }
}

}  // namespace
}  // namespace pliant
