#include "loads/momentum_balance.hpp"

#include <gtest/gtest.h>

#include "loads/slip.hpp"
#include "mesh/shapes/icosphere.hpp"

namespace pliant {
namespace {

// An ellipsoid away from the origin; uneven in all directions.
Surface ellipsoid() {
  auto surface = make_icosphere(8, 1.0);
  for (Vec3& x : surface.positions) x = Vec3{0.4, -0.2, 0.7} + Vec3{0.5 * x.x, 0.8 * x.y + 0.1 * x.x, 1.1 * x.z};
  return surface;
}

TEST(MomentumBalance, OfABodyAtRestIsWhatItsMarkersFeelLessTheWeightOfItsInnerFluid) {
  const auto surface = ellipsoid();
  const InnerFluid fluid{1.7, enclosed_moments(surface.mesh, surface.positions), {0, 0, -9.81}};
  const RigidLoad felt{{1, 2, 3}, {4, 5, 6}};
  const Vec3 center = fluid.moments.centroid;
  const auto load = momentum_balance(felt, fluid, {}, center);
  const double weight = 1.7 * fluid.moments.volume * 9.81;
  EXPECT_LT(norm(load.force - Vec3{1, 2, 3 + weight}), 1e-12 * weight);
  EXPECT_LT(norm(load.torque - felt.torque), 1e-12 * weight);

  // In a fluid at rest in the same field the outer pressure is hydrostatic, its force Archimedes', and its torque that
  // of the buoyancy at the centroid; the markers need not push at all.
  const Vec3 elsewhere{0.1, 0.3, -1};
  const auto buoyancy = momentum_balance({}, fluid, {}, elsewhere);
  RigidLoad hydrostatic;
  const auto areas = face_areas(surface.mesh, surface.positions);
  const auto normals = face_normals(surface.mesh, surface.positions);
  for (std::size_t f = 0; f < areas.size(); ++f) {
    const auto& face = surface.mesh.vertices_of_face()[f];
    // Exact for a linear pressure: middles of the edges.
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 x = 0.5 * (surface.positions[static_cast<std::size_t>(face[k])] +
                            surface.positions[static_cast<std::size_t>(face[(k + 1) % 3])]);
      const Vec3 force = (1.7 * 9.81 * x.z * areas[f] / 3) * normals[f];
      hydrostatic.force += force;
      hydrostatic.torque += cross(x - elsewhere, force);
    }
  }
  EXPECT_LT(norm(buoyancy.force - hydrostatic.force), 1e-12 * weight);
  EXPECT_LT(norm(buoyancy.torque - hydrostatic.torque), 1e-12 * weight);
}

TEST(MomentumBalance, AddsTheRateOfChangeOfTheInnerMomentum) {
  // The enclosed fluid, moved as a rigid body for a short time: its momentum, and angular momentum about the fixed
  // point `center`, come from the moved surface itself, and their rates from difference quotients (step^2: 1e-10).
  const auto surface = ellipsoid();
  const double density = 1.3, step = 1e-5;
  const Vec3 center{0.1, 0.3, 0.2}, velocity{0.3, -0.4, 0.2}, acceleration{1, -2, 0.5};
  const Vec3 omega{0.7, -1.1, 0.4}, alpha{-0.6, 0.3, 2};
  const auto momentum_at = [&](double t) {
    // To second order in t: rotation about the center by omega t + alpha t^2/2, Rodrigues' formula.
    const Vec3 turn = t * omega + (0.5 * t * t) * alpha;
    const double angle = norm(turn);
    const Vec3 axis = angle > 0 ? turn / angle : Vec3{0, 0, 1};
    const auto rotate = [&](Vec3 a) {
      return std::cos(angle) * a + std::sin(angle) * cross(axis, a) + ((1 - std::cos(angle)) * dot(axis, a)) * axis;
    };
    const Vec3 moved = center + t * velocity + (0.5 * t * t) * acceleration;
    auto positions = surface.positions;
    for (Vec3& x : positions) x = moved + rotate(x - center);
    const auto moments = enclosed_moments(surface.mesh, positions);
    const Vec3 v = velocity + t * acceleration, w = omega + t * alpha;
    const Vec3 of_centroid = v + cross(w, moments.centroid - moved);
    RigidLoad momentum;  // linear, and angular about the fixed point
    momentum.force = density * moments.volume * of_centroid;
    momentum.torque =
        density * (moments.volume * cross(moments.centroid - center, of_centroid) + moments.inertia() * w);
    return momentum;
  };
  const auto before = momentum_at(-step), after = momentum_at(step);
  const InnerFluid fluid{density, enclosed_moments(surface.mesh, surface.positions), {}};
  const auto load = momentum_balance({}, fluid, {acceleration, alpha, omega}, center);
  const Vec3 rate = (after.force - before.force) / (2 * step), turning = (after.torque - before.torque) / (2 * step);
  EXPECT_LT(norm(load.force - rate), 1e-8 * norm(rate));
  EXPECT_LT(norm(load.torque - turning), 1e-8 * norm(turning));
}

TEST(TotalLoad, MovesWithItsCenterAsTorquesDo) {
  const std::vector<Vec3> x{{1, 2, 3}, {-1, 0, 2}, {0.5, 0.5, -2}}, f{{1, 0, 2}, {0.3, -1, 0}, {2, 2, -1}};
  const Vec3 a{0.3, 0.2, -1}, b{5, -3, 2};
  const auto of_a = total_load(x, f, a), of_b = total_load(x, f, b);
  EXPECT_LT(norm(of_a.force - of_b.force), 1e-14);
  EXPECT_LT(norm(of_a.torque + cross(a - b, of_a.force) - of_b.torque), 1e-13);
}

TEST(Slip, OfAKnownDifference) {
  // U - V = (1, 0, 0) + n over a closed surface: the flux of the constant part is 0, that of n the area.
  const auto surface = ellipsoid();
  const auto normals = face_normals(surface.mesh, surface.positions);
  const auto areas = face_areas(surface.mesh, surface.positions);
  std::vector<Vec3> flow, body;
  for (Vec3 n : normals) {
    body.push_back({0.3, 2, -1});
    flow.push_back(body.back() + Vec3{1, 0, 0} + n);
  }
  const auto slip = measure_slip(flow, body, normals, areas);
  const double area = total_area(surface.mesh, surface.positions);
  EXPECT_NEAR(slip.area, area, 1e-12);
  EXPECT_NEAR(slip.flux, area, 1e-12);
  // |e + n|^2 = 2 + 2 n.e, and the mean of n.e is 0.
  EXPECT_NEAR(slip.rms(), std::sqrt(2.0), 1e-12);
  EXPECT_LE(slip.largest, 2);
  EXPECT_GT(slip.largest, 1.9);
  const auto half = measure_slip(std::span(flow).first(100), std::span(body).first(100), std::span(normals).first(100),
                                 std::span(areas).first(100));
  const auto rest = measure_slip(std::span(flow).subspan(100), std::span(body).subspan(100),
                                 std::span(normals).subspan(100), std::span(areas).subspan(100));
  EXPECT_NEAR((half + rest).rms(), slip.rms(), 1e-12);
  EXPECT_EQ((half + rest).largest, slip.largest);
  EXPECT_EQ(Slip{}.rms(), 0);
}

}  // namespace
}  // namespace pliant
