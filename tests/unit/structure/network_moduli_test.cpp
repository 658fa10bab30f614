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
