#include "potentials/moduli.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "deformed.hpp"
#include "mesh/geometry.hpp"
#include "potentials/potential_set.hpp"

namespace pliant {
namespace {

/// Second derivative of the energy density of a large lattice under x -> x + e * strain(x), border edges counted half.
double stiffness_against(const std::function<Vec3(Vec3)>& strain, double k) {
  const auto patch = make_lattice_patch(6);
  auto springs = EdgeSprings::uniform(patch.mesh, patch.positions, k, 1.0);
  for (int e = 0; e < patch.mesh.n_edges(); ++e)
    if (patch.mesh.faces_of_edge()[e][1] < 0) springs.stiffness[e] *= 0.5;
  const auto energy = [&](double e) {
    auto moved = patch.positions;
    for (Vec3& x : moved) x += e * strain(x);
    return springs.energy(ShapeState(patch.mesh, moved));
  };
  constexpr double e = 1e-4;
  return (energy(e) + energy(-e) - 2 * energy(0)) / (e * e) / total_area(patch.mesh, patch.positions);
}

TEST(Moduli, LatticeShearsAndStretchesAsItsModuliSay) {
  const double k = 2.5;
  const auto moduli = equilateral_moduli(k);
  EXPECT_NEAR(stiffness_against([](Vec3 x) { return Vec3{x.y, 0, 0}; }, k), moduli.shear, 1e-6 * k);
  // Equal stretch in x and y: the area strain is 2 e, so W'' = 4 K.
  EXPECT_NEAR(stiffness_against([](Vec3 x) { return Vec3{x.x, x.y, 0}; }, k), 4 * moduli.area, 1e-6 * k);
  // Pure stretch with the contraction of Poisson ratio 1/3 costs Young's modulus.
  EXPECT_NEAR(stiffness_against([](Vec3 x) { return Vec3{x.x, -x.y / 3, 0}; }, k), moduli.young, 1e-6 * k);
}

TEST(Moduli, VanGelderGivesBackYoungsModulus) {
  const auto patch = make_lattice_patch(4);
  const double young = 7.0, thickness = 0.3;
  const auto stiffness = van_gelder_stiffness(patch.mesh, patch.positions, young, thickness);
  for (int e = 0; e < patch.mesh.n_edges(); ++e) {
    const double inside = std::sqrt(3.0) / 2 * young * thickness;
    const bool border = patch.mesh.faces_of_edge()[e][1] < 0;
    EXPECT_NEAR(stiffness[e], border ? inside / 2 : inside, 1e-12);
  }
  EXPECT_NEAR(equilateral_moduli(std::sqrt(3.0) / 2 * young * thickness).young, young * thickness, 1e-12);
}

/// Young's moduli of a lattice along and across a fibre, times the thickness.
std::array<double, 2> fibre_moduli(Vec3 fibre, double along, double across, double thickness) {
  const auto patch = make_lattice_patch(6);
  const Vec3 other{-fibre.y, fibre.x, 0};
  const EdgeSprings springs{
      fibre_network_stiffness(patch.mesh, patch.positions, fibre_stiffness(fibre, along, across), thickness),
      edge_lengths(patch.mesh, patch.positions)};
  const auto second = [&](double e11, double e22) {
    const auto energy = [&](double e) {
      auto moved = patch.positions;
      for (Vec3& x : moved) x += e * (e11 * dot(x, fibre) * fibre + e22 * dot(x, other) * other);
      return springs.energy(ShapeState(patch.mesh, moved)) / total_area(patch.mesh, patch.positions);
    };
    constexpr double e = 1e-5;
    return (energy(e) + energy(-e)) / (e * e);
  };
  const double c11 = second(1, 0), c22 = second(0, 1), c12 = 0.5 * (second(1, 1) - c11 - c22);
  return {c11 - c12 * c12 / c22, c22 - c12 * c12 / c11};
}

TEST(Moduli, FibresAlongOrAcrossTheEdgesOfALatticeStretchAsTheirModuliSay) {
  for (double across : {3.0, 4.0, 12.0, 36.0})
    for (int sixths = 0; sixths < 6; ++sixths) {
      const double angle = sixths * std::numbers::pi / 6;
      const auto [found_along, found_across] = fibre_moduli({std::cos(angle), std::sin(angle), 0}, 12.0, across, 0.5);
      EXPECT_NEAR(found_along, 12.0 * 0.5, 1e-3) << across << ", " << sixths;
      EXPECT_NEAR(found_across, across * 0.5, 1e-3 * across / 12) << across << ", " << sixths;
    }
}

TEST(Moduli, EqualFibresAreNone) {
  const auto s = deformed_sphere(2, 3);
  const auto plain = van_gelder_stiffness(s.mesh, s.positions, 7.0, 0.3);
  const auto fibres = fibre_network_stiffness(s.mesh, s.positions, fibre_stiffness({1, 2, 0}, 7.0, 7.0), 0.3);
  for (std::size_t e = 0; e < plain.size(); ++e) EXPECT_NEAR(fibres[e], plain[e], 1e-12);
}

TEST(Moduli, HingesOfALatticeBendAsTheSheetDoes) {
  const double b = bending_modulus(12.0, 0.5, 0.5);
  EXPECT_NEAR(b, 12.0 * 0.125 / 12 / 0.75, 1e-15);
  const auto patch = make_lattice_patch(40);
  const auto stiffness = hinge_stiffness(patch.mesh, patch.positions, b);
  for (int e = 0; e < patch.mesh.n_edges(); ++e)
    EXPECT_NEAR(stiffness[e], patch.mesh.faces_of_edge()[e][1] < 0 ? 0.0 : 2 * b / std::sqrt(3.0), 1e-12);

  // Rolled on a wide cylinder about y, each face has the energy of B / (2 R^2) per area, whichever way the lattice
  // lies.
  const double radius = 200.0;
  for (double turn : {0.0, 0.2, std::numbers::pi / 6}) {
    auto rolled = patch.positions;
    for (Vec3& x : rolled) {
      const Vec3 y{std::cos(turn) * x.x - std::sin(turn) * x.y, std::sin(turn) * x.x + std::cos(turn) * x.y, 0};
      x = {radius * std::sin(y.x / radius), y.y, radius * std::cos(y.x / radius)};
    }
    Bending bending = Bending::about_flat(patch.mesh, 0.0);
    bending.stiffness = stiffness;
    const double density = bending.energy(ShapeState(patch.mesh, rolled)) / total_area(patch.mesh, patch.positions);
    EXPECT_NEAR(density / (b / (2 * radius * radius)), 1.0, 0.04);  // the border lacks half its hinges
  }
}

}  // namespace
}  // namespace pliant
