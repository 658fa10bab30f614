#include "structure/network_moduli.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "mesh/shapes/disc.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "unit/potentials/deformed.hpp"

namespace pliant {
namespace {

BodyConfig wall(double young, double thickness, double poisson = 1.0 / 3.0) {
  BodyConfig body;
  body.name = "sheet";
  body.material.young = young;
  body.material.thickness = thickness;
  body.material.poisson = poisson;
  return body;
}

TEST(NetworkModuli, OfALatticeAreThoseAskedFor) {
  const auto m = find_moduli(wall(8.0, 0.25, 0.5), make_lattice_patch(7));
  EXPECT_EQ(m.n_patches, 1);
  EXPECT_NEAR(*m.asked.young, 2.0, 1e-12);
  EXPECT_NEAR(*m.asked.area, 1.5, 1e-12);
  EXPECT_NEAR(*m.asked.bending, 8.0 / (64 * 12 * 0.75), 1e-12);
  EXPECT_NEAR(m.plane.young(), 2.0, 1e-6);
  EXPECT_NEAR(m.plane.poisson(), 1.0 / 3, 1e-6);
  EXPECT_NEAR(m.plane.young_along(), 2.0, 1e-6);
  EXPECT_NEAR(m.plane.young_across(), 2.0, 1e-6);
  EXPECT_NEAR(m.plane.c66, 0.75, 1e-6);
  EXPECT_NEAR(m.bending.rolling() / *m.asked.bending, 1, 1e-5);
  EXPECT_FALSE(m.inflation);
}

TEST(NetworkModuli, OfAMembraneDoNotMindTheMesh) {
  BodyConfig body;
  body.potentials.membrane = MembraneConfig{MembraneLaw::skalak, 2.0, 3.0};
  body.potentials.area = AreaConfig{5.0};
  const auto m = find_moduli(body, make_disc(1.0, 0.2));
  EXPECT_NEAR(*m.asked.area, 19.0, 1e-12);
  EXPECT_NEAR(m.plane.area(), 19.0, 1e-5);
  EXPECT_NEAR(m.plane.shear(), 2.0, 1e-5);
  EXPECT_NEAR(m.plane.young_along(), *m.asked.young, 1e-5);
}

TEST(NetworkModuli, OfASheetDoNotMindItsPlace) {
  auto tilted = make_lattice_patch(5);
  for (Vec3& x : tilted.positions) x = {x.z + 3, x.x, x.y};
  auto body = wall(8.0, 0.25);
  body.material.fibre = Vec3{0, 0, 1};  // along the lattice's y
  body.material.young_across = 4.0;
  auto flat = body;
  flat.material.fibre = Vec3{0, 1, 0};
  const auto m = find_moduli(body, tilted), n = find_moduli(flat, make_lattice_patch(5));
  EXPECT_NEAR(m.plane.young_along(), n.plane.young_along(), 1e-7);
  EXPECT_NEAR(m.plane.young_across(), n.plane.young_across(), 1e-7);
  EXPECT_GT(m.plane.young_along(), 1.5 * m.plane.young_across());
}

TEST(SheetStiffness, IsThatOfItsComplianceTurned) {
  // A sheet of compliances 1/8 and 1/2 along and across, -1/16 between and 3 in shear, turned by 30 degrees: the
  // compliance along an axis turns as a tensor of rank 4.
  const double s11 = 0.125, s22 = 0.5, s12 = -0.0625, s66 = 3, det = s11 * s22 - s12 * s12;
  const double c11 = s22 / det, c22 = s11 / det, c12 = -s12 / det, c66 = 1 / s66;
  const double c = std::sqrt(0.75), s = 0.5;
  const double r11 = c11 * c * c * c * c + c22 * s * s * s * s + (2 * c12 + 4 * c66) * c * c * s * s;
  const double r22 = c11 * s * s * s * s + c22 * c * c * c * c + (2 * c12 + 4 * c66) * c * c * s * s;
  const double r12 = (c11 + c22 - 4 * c66) * c * c * s * s + c12 * (c * c * c * c + s * s * s * s);
  const double r66 = (c11 + c22 - 2 * c12 - 2 * c66) * c * c * s * s + c66 * (c * c * c * c + s * s * s * s);
  const double r16 = (c11 - c12 - 2 * c66) * c * c * c * s + (c12 - c22 + 2 * c66) * c * s * s * s;
  const double r26 = (c11 - c12 - 2 * c66) * c * s * s * s + (c12 - c22 + 2 * c66) * c * c * c * s;
  const SheetStiffness turned{r11, r22, r12, r66, r16, r26};
  EXPECT_NEAR(1 / turned.young_along(), s11 * 9 / 16 + s22 / 16 + (2 * s12 + s66) * 3 / 16, 1e-12);
  EXPECT_NEAR(1 / turned.young_across(), s11 / 16 + s22 * 9 / 16 + (2 * s12 + s66) * 3 / 16, 1e-12);
  const SheetStiffness straight{c11, c22, c12, c66, 0, 0};
  EXPECT_NEAR(straight.young_along(), 8, 1e-12);
  EXPECT_NEAR(straight.area(), turned.area(), 1e-12);
  EXPECT_NEAR(straight.shear(), turned.shear(), 1e-12);
  EXPECT_NEAR(straight.rolling(), turned.rolling(), 1e-12);
}

TEST(NetworkModuli, OfASphereAreFoundOnItAndByInflation) {
  BodyConfig body;
  body.potentials.membrane = MembraneConfig{MembraneLaw::neo_hookean, 2.0, 0};
  const auto m = find_moduli(body, make_icosphere(8, 1.5));
  EXPECT_EQ(m.n_patches, 6);
  EXPECT_NEAR(m.plane.area(), 6.0, 1e-5);
  EXPECT_NEAR(m.plane.shear(), 2.0, 1e-5);
  ASSERT_TRUE(m.inflation);
  EXPECT_NEAR(*m.inflation, 6.0, 0.01 * 6.0);
}

TEST(NetworkModuli, RefuseWhatHasNone) {
  const auto lattice = make_lattice_patch(3);
  BodyConfig body;
  body.name = "drop";
  body.potentials.surface_tension = SurfaceTensionConfig{1.0, 0.0};
  EXPECT_THROW(find_moduli(body, lattice), InputError);
  body.potentials.edge = EdgeConfig{1.0, 0.5};
  EXPECT_THROW(find_moduli(body, lattice), InputError);
  body.potentials.edge->rest_length = 1.0;
  EXPECT_NO_THROW(find_moduli(body, lattice));
  EXPECT_THROW(find_moduli(body, make_icosphere(2, 1.0)), InputError) << "too coarse";
}

}  // namespace
}  // namespace pliant
