#include "potentials/membrane.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "deformed.hpp"
#include "mesh/geometry.hpp"

namespace pliant {
namespace {

/// An irregular flat sheet.
Surface sheet() {
  auto patch = make_lattice_patch(5);
  const auto inner = shaken(patch.positions, 0.15, 3);
  for (std::size_t v = 0; v < inner.size(); ++v) patch.positions[v] += {inner[v].x - patch.positions[v].x, 0, 0};
  return patch;
}

std::vector<Vec3> stretched(std::vector<Vec3> positions, double along_x, double along_y) {
  for (Vec3& x : positions) x = {along_x * x.x, along_y * x.y, x.z};
  return positions;
}

/// Tension along x of the evenly stretched sheet, force per present length: the work of a further stretch.
double tension_along_x(const Membrane& membrane, const Surface& surface, double l1, double l2) {
  constexpr double step = 1e-5;
  const auto energy = [&](double l) {
    return membrane.energy(ShapeState(surface.mesh, stretched(surface.positions, l, l2)));
  };
  return (energy(l1 + step) - energy(l1 - step)) / (2 * step) / (l2 * total_area(surface.mesh, surface.positions));
}

TEST(Membrane, NeoHookeanTensionsAreTheClosedForm) {
  const auto surface = sheet();
  const auto membrane = Membrane::about_shape(surface.mesh, surface.positions, NeoHookean{2.5});
  for (const auto& [l1, l2] : {std::pair{1.0, 1.0}, {1.3, 1.3}, {2.0, 1 / std::sqrt(2.0)}, {0.7, 1.6}}) {
    const double expected = 2.5 / (l1 * l2) * (l1 * l1 - 1 / (l1 * l1 * l2 * l2));
    EXPECT_NEAR(tension_along_x(membrane, surface, l1, l2), expected, 1e-8) << l1 << " " << l2;
  }
}

TEST(Membrane, SkalakTensionsAreTheClosedForm) {
  const auto surface = sheet();
  const auto membrane = Membrane::about_shape(surface.mesh, surface.positions, Skalak{2.5, 10});
  for (const auto& [l1, l2] : {std::pair{1.0, 1.0}, {1.3, 1.3}, {1.5, 0.7}, {0.7, 1.6}}) {
    const double expected = 2.5 * l1 / l2 * (l1 * l1 - 1 + 10 * l2 * l2 * (l1 * l1 * l2 * l2 - 1));
    EXPECT_NEAR(tension_along_x(membrane, surface, l1, l2), expected, 1e-7) << l1 << " " << l2;
  }
}

TEST(Membrane, SmallStrainsFeelTheModuli) {
  const auto surface = sheet();
  const auto stiffness_against = [&](const SheetLaw& law, const std::function<Vec3(Vec3)>& strain) {
    const auto membrane = Membrane::about_shape(surface.mesh, surface.positions, law);
    const auto energy = [&](double e) {
      auto moved = surface.positions;
      for (Vec3& x : moved) x += e * strain(x);
      return membrane.energy(ShapeState(surface.mesh, moved));
    };
    constexpr double e = 1e-4;
    return (energy(e) + energy(-e) - 2 * energy(0)) / (e * e) / total_area(surface.mesh, surface.positions);
  };
  const auto shear = [](Vec3 x) { return Vec3{0.5 * x.y, 0.5 * x.x, 0}; };
  const auto swell = [](Vec3 x) { return Vec3{0.5 * x.x, 0.5 * x.y, 0}; };
  EXPECT_NEAR(stiffness_against(NeoHookean{2.5}, shear), 2.5, 1e-6);
  EXPECT_NEAR(stiffness_against(NeoHookean{2.5}, swell), 3 * 2.5, 1e-6);
  EXPECT_NEAR(stiffness_against(Skalak{2.5, 4.0}, shear), 2.5, 1e-6);
  EXPECT_NEAR(stiffness_against(Skalak{2.5, 4.0}, swell), 9 * 2.5, 1e-5);
}

TEST(Membrane, OfAnEvenlyStretchedSheetIsBalancedInside) {
  const auto surface = sheet();
  for (const SheetLaw& law : {SheetLaw(NeoHookean{1.0}), SheetLaw(Skalak{1.0, 2.0})}) {
    const auto forces = forces_of(Membrane::about_shape(surface.mesh, surface.positions, law), surface.mesh,
                                  stretched(surface.positions, 1.4, 0.9));
    std::vector<char> at_border(forces.size(), 0);
    for (int e = 0; e < surface.mesh.n_edges(); ++e)
      if (surface.mesh.faces_of_edge()[e][1] < 0)
        for (int v : surface.mesh.vertices_of_edge()[e]) at_border[v] = 1;
    for (std::size_t v = 0; v < forces.size(); ++v) {
      if (at_border[v]) continue;
      EXPECT_LT(norm(forces[v]), 1e-13);
    }
  }
}

TEST(Membrane, IsFreeOfStressInItsReference) {
  const auto s = deformed_sphere(3, 2);
  for (const SheetLaw& law : {SheetLaw(NeoHookean{1.0}), SheetLaw(Skalak{1.0, 2.0})}) {
    const auto membrane = Membrane::about_shape(s.mesh, s.reference, law);
    EXPECT_NEAR(membrane.energy(ShapeState(s.mesh, s.reference)), 0, 1e-13);
    for (const Vec3& f : forces_of(membrane, s.mesh, s.reference)) EXPECT_LT(norm(f), 1e-13);
  }
}

}  // namespace
}  // namespace pliant
