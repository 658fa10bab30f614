#include "structure/surface_contact.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "mesh/crossing.hpp"
#include "mesh/distance.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "mesh/shapes/plate.hpp"
#include "small_bodies.hpp"
#include "structure/advance_vertices.hpp"
#include "structure/stable_time_step.hpp"

// Surfaces that are pressed on each other, on walls and on themselves stay on their side.
namespace pliant {
namespace {

constexpr double range = 0.1;

Surface moved(Surface surface, Vec3 by) {
  for (Vec3& x : surface.positions) x += by;
  return surface;
}

RepulsionBox open_box() {
  RepulsionBox box;
  box.origin = {-2, -2, -2};
  box.size = {4, 4, 4};
  return box;
}

Obstacles obstacles_of(const DeformableBody& body, bool yields) {
  Obstacles obstacles;
  obstacles.positions = body.positions;
  obstacles.velocities = body.velocities;
  obstacles.areas = vertex_areas(body.mesh, body.positions);
  obstacles.faces.assign(body.mesh.vertices_of_face().begin(), body.mesh.vertices_of_face().end());
  obstacles.parts.push_back({1, yields, static_cast<int>(body.positions.size()), body.mesh.n_faces()});
  return obstacles;
}

/// Contact forces on a body at rest that nothing else moves, as the law has them.
std::vector<Vec3> forces_at_rest(SurfaceContact& contact, const DeformableBody& body) {
  std::vector<Vec3> forces(body.positions.size());
  const std::vector<double> mobilities(body.positions.size(), 1e-14);
  contact.add_forces({body.positions, body.velocities, mobilities, 0, 1e-3}, forces);
  return forces;
}

Vec3 sum(std::span<const Vec3> vectors) {
  Vec3 total;
  for (const Vec3& v : vectors) total += v;
  return total;
}

VertexLoads no_loads(const DeformableBody& body) {
  VertexLoads loads;
  loads.assign(body.positions.size());
  return loads;
}

TEST(SurfaceContact, ParallelSurfacesBearThePressureOfTheLaw) {
  // Meshes that do not match; the gap is seen by both.
  const auto lower = make_plain_body(make_plate(1.5, 1.4, 0.08), 1);
  for (const double gap : {0.03, 0.05, 0.08}) {
    const auto upper = make_plain_body(moved(make_plate(0.9, 1.0, 0.08), {0.013, 0.027, gap}), 1);
    SurfaceContact contact({range, 10, false}, open_box());
    contact.begin(upper, obstacles_of(lower, false), 0.01);
    const Vec3 force = sum(forces_at_rest(contact, upper));
    const double floor = std::min(range / 5, gap / 2), pressure = 10 * (range - gap) / (gap - floor);
    // Edges add up to a quarter where the gap is below half of their length.
    EXPECT_GT(force.z / 0.9, 0.9 * pressure) << gap;
    EXPECT_LT(force.z / 0.9, (gap < 0.04 ? 1.35 : 1.1) * pressure) << gap;
    EXPECT_LT(std::hypot(force.x, force.y), 0.02 * force.z);
  }
}

TEST(SurfaceContact, ForcesOnTwoBodiesAreOppositeToRoundOff) {
  const auto a = make_plain_body(make_icosphere(4, 0.5), 1);
  auto b = make_plain_body(moved(make_icosphere(5, 0.5), {0.1, 0.2, 1.02}), 1);
  for (const bool yields : {false, true}) {
    SurfaceContact on_a({range, 10, true}, open_box()), on_b({range, 10, true}, open_box());
    on_a.begin(a, obstacles_of(b, yields), 0.01);
    on_b.begin(b, obstacles_of(a, yields), 0.01);
    const auto first = forces_at_rest(on_a, a), second = forces_at_rest(on_b, b);
    EXPECT_LT(sum(first).z, -0.01);
    EXPECT_LT(norm(sum(first) + sum(second)), 1e-12 * norm(sum(first)));
    Vec3 torque;
    for (std::size_t v = 0; v < first.size(); ++v) torque += cross(a.positions[v], first[v]);
    for (std::size_t v = 0; v < second.size(); ++v) torque += cross(b.positions[v], second[v]);
    EXPECT_LT(norm(torque), 1e-12 * norm(sum(first)));
    for (std::size_t v = 0; v < second.size(); ++v)
      EXPECT_LT(norm(1e-3 * second[v] - on_a.impulses_on_obstacles()[v]), 1e-15) << "each knows what the other feels";
  }
}

TEST(SurfaceContact, AShapeAtRestDoesNotPressOnItself) {
  // Everything is within the range, and far along the surface.
  const auto ball = make_plain_body(make_icosphere(6, 0.1), 1);
  SurfaceContact contact({0.3, 10, true}, open_box());
  contact.begin(ball, {}, 0.01);
  for (const Vec3& f : forces_at_rest(contact, ball)) EXPECT_EQ(norm(f), 0.0);
}

TEST(SurfaceContact, WhatMovesAlongTogetherIsNotHeldBack) {
  auto a = make_plain_body(make_icosphere(3, 0.5), 1),
       b = make_plain_body(moved(make_icosphere(3, 0.5), {0, 0, 1.11}), 1);
  for (auto* body : {&a, &b})
    for (Vec3& v : body->velocities) v = {7, 5, 100};
  SurfaceContact contact({range, 10, true}, open_box());
  contact.begin(a, obstacles_of(b, true), 0.1);
  ShapeState shape(a.mesh);
  for (int i = 0; i < 10; ++i) {
    shape.update(a.positions);
    advance_vertices(a, shape, no_loads(a), 0.01, contact, 0.01 * i);
  }
  for (const Vec3& v : a.velocities) EXPECT_EQ(norm(v - Vec3{7, 5, 100}), 0.0);
}

/// Two triangles that meet with their edges alone.
TEST(SurfaceContact, EdgesDoNotPassThroughEdges) {
  const Surface knife{TriangleMesh(3, {{0, 1, 2}}), {{-1, 0, 0}, {1, 0, 0}, {0.1, 0, -1}}};
  const Surface other{TriangleMesh(3, {{0, 1, 2}}), {{0, -1, 0.2}, {0, 1, 0.2}, {0, 0.1, 1.2}}};
  for (const double speed : {0.1, 10.0, 100.0}) {
    auto falling = make_plain_body(other, 1);
    const auto resting = make_plain_body(knife, 1);
    for (Vec3& v : falling.velocities) v = {0, 0, -speed};
    SurfaceContact contact({range, 10, true}, open_box());
    ShapeState shape(falling.mesh);
    const double step = 0.05 / speed;
    for (int i = 0; i < 100; ++i) {
      contact.begin(falling, obstacles_of(resting, false), step);
      shape.update(falling.positions);
      advance_vertices(falling, shape, no_loads(falling), step, contact, 0);
      EXPECT_FALSE(find_crossing({falling.mesh, falling.positions}, {resting.mesh, resting.positions}, 0));
    }
    EXPECT_GT(falling.positions[0].z, 0);
  }
}

/// A ball of springs, filled, that rests in a heavy drag.
DeformableBody make_drop(double radius) {
  auto body = make_plain_body(make_icosphere(6, radius), 1e-3);
  body.potentials.add(EdgeSprings::uniform(body.mesh, body.positions, 5, 1));
  body.potentials.add(VolumePenalty{200, enclosed_volume(body.mesh, body.positions)});
  body.largest_frequency = find_largest_frequency(body);
  return body;
}

TEST(SurfaceContact, ADropPressedOnAWallStaysInside) {
  auto drop = make_drop(0.5);
  for (Vec3& x : drop.positions) x.z -= 1.3;  // the wall is at -2
  drop.damping = 5e-3;
  auto box = open_box();
  box.sides[4] = RepulsionSide::wall;
  SurfaceContact contact({range, 10, true}, box);
  auto loads = no_loads(drop);
  for (const double weight : {0.02, 0.2}) {
    for (Vec3& f : loads.forces) f = {0, 0, -weight};
    const double step = 0.3 * stable_time_step(drop, {});
    ShapeState shape(drop.mesh);
    double lowest = 0;
    const int steps = static_cast<int>(6 / step);
    for (int i = 0; i < steps; ++i) {
      if (i % 10 == 0) contact.begin(drop, {}, 10 * step);
      shape.update(drop.positions);
      advance_vertices(drop, shape, loads, step, contact, i % 10 * step);
      for (const Vec3& x : drop.positions) lowest = std::min(lowest, x.z);
    }
    EXPECT_GT(lowest, -2.0);
    EXPECT_LT(lowest, -2.0 + range) << "it has met the wall";
    EXPECT_FALSE(find_self_crossing({drop.mesh, drop.positions}, 0));
    Vec3 on_wall;
    for (std::size_t v = 0; v < drop.positions.size(); ++v)
      on_wall += drop.forces[v] - loads.forces[v] + drop.damping * Vec3{0, 0, 0};
    EXPECT_NEAR(on_wall.z, weight * static_cast<double>(drop.positions.size()), 0.01 * on_wall.z)
        << "the wall bears its weight";
  }
}

/// One half of a sheet is turned over onto the other half, and on to where it would be behind it.
void expect_fold(double thickness_of_range, int substeps, double skew) {
  auto sheet = make_plain_body(make_plate(1.0, 0.7, 0.07), 1e-3);
  sheet.potentials.add(EdgeSprings::uniform(sheet.mesh, sheet.positions, 20, 1));
  sheet.potentials.add(Bending::about_flat(sheet.mesh, 2e-4));
  sheet.largest_frequency = find_largest_frequency(sheet);
  sheet.damping = 2e-2;
  SurfaceContact contact({thickness_of_range, 2, true}, open_box());
  const double step = 0.3 * stable_time_step(sheet, {}), pull = 0.2;
  const auto rest = sheet.positions;
  auto loads = no_loads(sheet);
  ShapeState shape(sheet.mesh);
  const int steps = 12000;
  double nearest = 1;
  for (int i = 0; i < steps; ++i) {
    const double angle = std::numbers::pi * std::min(1.15, 1.5 * i / steps), turn = skew * i / steps;
    for (std::size_t v = 0; v < rest.size(); ++v) {
      Vec3 goal = rest[v];
      if (goal.x > 0) goal = {rest[v].x * std::cos(angle), rest[v].y + turn * rest[v].x, rest[v].x * std::sin(angle)};
      loads.forces[v] = pull * (goal - sheet.positions[v]);
    }
    if (i % substeps == 0) contact.begin(sheet, {}, substeps * step);
    shape.update(sheet.positions);
    advance_vertices(sheet, shape, loads, step, contact, i % substeps * step);
    nearest = std::min(nearest, contact.least_gap());
    if (i % 20 == 0) { ASSERT_FALSE(find_self_crossing({sheet.mesh, sheet.positions}, 0)) << "step " << i; }
  }
  EXPECT_FALSE(find_self_crossing({sheet.mesh, sheet.positions}, 0));
  EXPECT_LT(nearest, 0.7 * thickness_of_range) << "it has met itself";
  double lowest = 1, mean = 0, n = 0;
  for (std::size_t v = 0; v < rest.size(); ++v)
    if (rest[v].x > 0.2) lowest = std::min(lowest, sheet.positions[v].x), mean += sheet.positions[v].z, ++n;
  EXPECT_LT(lowest, -0.3) << "it has turned over";
  EXPECT_GT(mean / n, -0.1) << "and lies on the other half";
}

TEST(SurfaceContact, AFoldedSheetDoesNotPassThroughItself) { expect_fold(0.07, 20, 0); }
TEST(SurfaceContact, NorASkewOneOfShorterRange) { expect_fold(0.035, 20, 0.5); }

}  // namespace
}  // namespace pliant
