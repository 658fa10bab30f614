#include "loads/probe_loads.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "mesh/geometry.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "structure/rigid_load.hpp"
#include "unit/loads/linear_flow.hpp"
#include "unit/loads/sampled_loads.hpp"

namespace pliant {
namespace {

constexpr ProbeForm forms[] = {ProbeForm::gradient, ProbeForm::one_sided, ProbeForm::quadratic};

// Velocity and pressure by formula; the gradient from differences of the formula.
struct Flow : FlowSampler {
  std::function<Vec3(Vec3)> velocity;
  std::function<double(Vec3)> pressure;

  void sample(std::span<const Vec3> points, std::span<FlowSample> samples) const override {
    constexpr double step = 1e-4;  // error step^2, round-off 1e-12: far below what is asserted
    for (std::size_t i = 0; i < points.size(); ++i) {
      samples[i].velocity = velocity(points[i]);
      samples[i].pressure = pressure(points[i]);
      for (int d = 0; d < 3; ++d) {
        Vec3 by;
        by[d] = step;
        const Vec3 slope = (velocity(points[i] + by) - velocity(points[i] - by)) / (2 * step);
        for (int c = 0; c < 3; ++c) samples[i].gradient[c][d] = slope[c];
      }
    }
  }
};

// The unit sphere, with sites on the sphere itself, so that no error of the faces blurs that of the probes.
SurfaceSites sphere_sites() {
  const auto surface = make_icosphere(12, 1.0);
  SurfaceSites sites;
  const std::vector<Vec3> zero(surface.positions.size());
  set_sites(surface.mesh, surface.positions, zero, zero, sites);
  double area = 0;
  for (double a : sites.areas) area += a;
  for (std::size_t f = 0; f < sites.size(); ++f) {
    sites.positions[f] = sites.normals[f] = normalized(sites.positions[f]);
    sites.areas[f] *= 4 * M_PI / area;
  }
  return sites;
}

RigidLoad total(const SurfaceSites& sites, const ProbeLoads& loads) {
  return total_load(sites.positions, loads.forces, {});
}

// The ratio of errors at h and h/2 as an order of convergence.
double order(double error, double error_of_half) { return std::log2(std::abs(error / error_of_half)); }

constexpr double mu = 0.7;

// Stokes flow of speed 1 along x past the unit sphere at rest.
Flow stokes_flow() {
  Flow flow;
  flow.velocity = [](Vec3 x) {
    const double r = norm(x);
    const Vec3 n = x / r, e{1, 0, 0};
    return (1 - 0.75 / r - 0.25 / (r * r * r)) * e + ((-0.75 / r + 0.75 / (r * r * r)) * n.x) * n;
  };
  flow.pressure = [](Vec3 x) { return -1.5 * mu * x.x / std::pow(norm(x), 3); };
  return flow;
}

TEST(ProbeLoads, ConvergeToStokesDragAtTheirOrders) {
  const auto sites = sphere_sites();
  const double exact = 6 * M_PI * mu;
  const auto drag_error = [&](ProbeForm form, double h) {
    const ProbeSettings settings{form, Wetting::outside, h, 0, 1.0, mu, {}};
    return total(sites, loads_of(sites, settings, stokes_flow())).force.x - exact;
  };
  // The limits are those of the sampled sphere: 2880 sites, 1e-4.
  EXPECT_NEAR(order(drag_error(ProbeForm::gradient, 0.05), drag_error(ProbeForm::gradient, 0.025)), 1, 0.15);
  EXPECT_NEAR(order(drag_error(ProbeForm::one_sided, 0.05), drag_error(ProbeForm::one_sided, 0.025)), 1, 0.15);
  EXPECT_NEAR(order(drag_error(ProbeForm::quadratic, 0.05), drag_error(ProbeForm::quadratic, 0.025)), 2, 0.2);
  for (double h : {0.2, 0.1, 0.05})
    EXPECT_LT(std::abs(drag_error(ProbeForm::quadratic, h)), 0.6 * std::abs(drag_error(ProbeForm::one_sided, h))) << h;
}

TEST(ProbeLoads, OfASpinningSphereInStokesFlow) {
  // u = omega x r / r^3; torque -8 pi mu omega.
  auto sites = sphere_sites();
  const Vec3 omega{0.3, -0.5, 0.9};
  for (std::size_t f = 0; f < sites.size(); ++f)
    sites.velocities[f] = sites.normal_rates[f] = cross(omega, sites.normals[f]);
  Flow flow;
  flow.velocity = [&](Vec3 x) { return cross(omega, x) / std::pow(norm(x), 3); };
  flow.pressure = [](Vec3) { return 0.0; };
  const Vec3 exact = (-8 * M_PI * mu) * omega;
  for (const ProbeForm form : forms) {
    const auto error = [&](double h) {
      const ProbeSettings settings{form, Wetting::outside, h, 0, 1.0, mu, {}};
      return norm(total(sites, loads_of(sites, settings, flow)).torque - exact);
    };
    EXPECT_NEAR(order(error(0.05), error(0.025)), form == ProbeForm::quadratic ? 2 : 1, 0.25);
    EXPECT_LT(error(0.025), 0.12 * norm(exact));
  }
}

TEST(ProbeLoads, VanishInAFluidThatTurnsWithTheBody) {
  // No strain, and the centripetal pressure rho omega^2 r^2/2 gives a force that holds the displaced fluid on its
  // circle.
  const auto surface = make_icosphere(6, 1.0);
  const Vec3 omega{0, 0, 1.3}, away{2, 0.5, 0};
  std::vector<Vec3> positions, velocities, accelerations;
  for (Vec3 x : surface.positions) {
    positions.push_back(x + away);
    velocities.push_back(cross(omega, positions.back()));
    accelerations.push_back(cross(omega, velocities.back()));
  }
  SurfaceSites sites;
  set_sites(surface.mesh, positions, velocities, accelerations, sites);
  const double rho = 1.9, h = 0.1, volume = enclosed_volume(surface.mesh, positions);
  Flow flow;
  flow.velocity = [&](Vec3 x) { return cross(omega, x); };
  flow.pressure = [&](Vec3 x) { return 0.5 * rho * omega.z * omega.z * (x.x * x.x + x.y * x.y); };
  const Vec3 exact = (rho * volume) * cross(omega, cross(omega, away));
  for (const ProbeForm form : forms) {
    const auto loads = loads_of(sites, {form, Wetting::outside, h, 0, rho, mu, {}}, flow);
    for (Vec3 shear : loads.outer.shear) EXPECT_LT(norm(shear), 1e-8);
    // Pressure: error h^2 p''/2 (h^2 p'' if extrapolated), whose sum over the sphere is small of higher order.
    EXPECT_LT(norm(total(sites, loads).force - exact), 0.02 * norm(exact));
  }
}

TEST(ProbeLoads, GiveTheAddedMassOfAnAcceleratingSphere) {
  // From rest: p = rho a.x / (2 r^3), force -rho V a/2.
  auto sites = sphere_sites();
  const double rho = 1.9;
  const Vec3 a{0.4, -1, 0.2};
  for (Vec3& acceleration : sites.accelerations) acceleration = a;
  Flow flow;
  flow.velocity = [](Vec3) { return Vec3{}; };
  flow.pressure = [&](Vec3 x) { return rho * dot(a, x) / (2 * std::pow(norm(x), 3)); };
  const Vec3 exact = (-rho * 2 * M_PI / 3) * a;
  for (const ProbeForm form : forms) {
    const auto error = [&](double h) {
      return norm(total(sites, loads_of(sites, {form, Wetting::outside, h, 0, rho, mu, {}}, flow)).force - exact);
    };
    EXPECT_NEAR(order(error(0.05), error(0.025)), 2, 0.25) << "dp/dn = -rho a.n makes it second order";
  }
}

TEST(ProbeLoads, GiveArchimedesForceOfAUniformBodyForce) {
  const auto surface = make_icosphere(5, 0.8);
  const std::vector<Vec3> zero(surface.positions.size());
  SurfaceSites sites;
  set_sites(surface.mesh, surface.positions, zero, zero, sites);
  const double rho = 1.9;
  const Vec3 g{1, 2, -9};
  LinearFlow flow;
  flow.pressure = 3;
  flow.pressure_gradient = rho * g;
  for (const ProbeForm form : forms) {
    const auto loads = loads_of(sites, {form, Wetting::outside, 0.1, 0, rho, mu, g}, flow);
    const Vec3 exact = (-rho * enclosed_volume(surface.mesh, surface.positions)) * g;
    EXPECT_LT(norm(total(sites, loads).force - exact), 1e-12 * norm(exact));
    EXPECT_LT(norm(total(sites, loads).torque), 1e-12 * norm(exact));
    for (std::size_t f = 0; f < sites.size(); ++f)
      EXPECT_NEAR(loads.outer.pressure[f], 3 + rho * dot(g, sites.positions[f]), 1e-12);
  }
}

TEST(ProbeLoads, OfASurfaceThatFollowsALinearFlow) {
  // Turning, stretching and shearing at once; the stress of the fluid is known everywhere.
  const Mat3 gradient{{{0.3, -1, 2}, {0.7, 0.1, -0.4}, {5, 0.2, -0.4}}};
  const auto surface = make_icosphere(3, 0.8);
  const std::vector<Vec3> zero(surface.positions.size());
  std::vector<Vec3> velocities;
  for (Vec3 x : surface.positions) velocities.push_back(gradient * x);
  SurfaceSites sites;
  set_sites(surface.mesh, surface.positions, velocities, zero, sites);
  LinearFlow flow;
  flow.gradient = gradient;
  for (const ProbeForm form : forms) {
    const auto loads = loads_of(sites, {form, Wetting::outside, 0.1, 0, 1.0, mu, {}}, flow);
    for (std::size_t f = 0; f < sites.size(); ++f) {
      const Vec3 n = sites.normals[f];
      const Vec3 stress = mu * (gradient * n + Vec3{dot({gradient[0].x, gradient[1].x, gradient[2].x}, n),
                                                    dot({gradient[0].y, gradient[1].y, gradient[2].y}, n),
                                                    dot({gradient[0].z, gradient[1].z, gradient[2].z}, n)});
      const Vec3 shear = stress - dot(stress, n) * n;
      EXPECT_LT(norm(loads.outer.shear[f] - shear), 1e-12);
      if (form == ProbeForm::one_sided) continue;  // counts the normal viscous stress of stretching by half
      EXPECT_LT(norm(loads.forces[f] - sites.areas[f] * stress), 1e-12);
    }
  }
}

TEST(ProbeLoads, HeedWhereTheFlowTakesTheSurfacesVelocity) {
  // A parabola over the plane z = 0 that vanishes at z = s_0: its slope there.
  const TriangleMesh mesh(3, {{0, 1, 2}});
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, zero(3);
  SurfaceSites sites;
  set_sites(mesh, positions, zero, zero, sites);
  const double offset = 0.03, h = 0.2;
  Flow flow;
  flow.velocity = [&](Vec3 x) { return Vec3{2 * (x.z - offset) - 3 * (x.z - offset) * (x.z - offset), 0, 0}; };
  flow.pressure = [](Vec3) { return 0.0; };
  const auto loads = loads_of(sites, {ProbeForm::quadratic, Wetting::outside, h, offset, 1.0, mu, {}}, flow);
  EXPECT_NEAR(loads.outer.shear[0].x, 2 * mu, 1e-8);
  const auto linear = loads_of(sites, {ProbeForm::one_sided, Wetting::outside, h, offset, 1.0, mu, {}}, flow);
  EXPECT_NEAR(linear.outer.shear[0].x, (2 - 3 * (h - offset)) * mu, 1e-8);
}

TEST(ProbeLoads, OfAMembraneAreTheDifferenceOfItsSides) {
  // A square in z = 0 at rest: shear flows of different rates and pressures of different height above and below.
  const TriangleMesh mesh(4, {{0, 1, 2}, {0, 2, 3}});
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, zero(4);
  SurfaceSites sites;
  set_sites(mesh, positions, zero, zero, sites);
  Flow flow;
  flow.velocity = [](Vec3 x) { return x.z > 0 ? Vec3{2 * x.z, 0, 0} : Vec3{0, -3 * x.z, 0}; };
  flow.pressure = [](Vec3 x) { return x.z > 0 ? 5.0 : 9.0; };
  for (const ProbeForm form : forms) {
    const auto loads = loads_of(sites, {form, Wetting::both_sides, 0.1, 0, 1.0, mu, {}}, flow);
    ASSERT_EQ(loads.inner.pressure.size(), 2U);
    for (std::size_t f = 0; f < 2; ++f) {
      EXPECT_NEAR(loads.outer.pressure[f], 5, 1e-12);
      EXPECT_NEAR(loads.inner.pressure[f], 9, 1e-12);
      EXPECT_LT(norm(loads.outer.shear[f] - mu * Vec3{2, 0, 0}), 1e-10);
      EXPECT_LT(norm(loads.inner.shear[f] - mu * Vec3{0, 3, 0}), 1e-10);
      EXPECT_LT(norm(loads.forces[f] - 0.5 * Vec3{2 * mu, 3 * mu, 4}), 1e-10);
    }
    const auto closed = loads_of(sites, {form, Wetting::outside, 0.1, 0, 1.0, mu, {}}, flow);
    EXPECT_TRUE(closed.inner.pressure.empty());
  }
}

}  // namespace
}  // namespace pliant
