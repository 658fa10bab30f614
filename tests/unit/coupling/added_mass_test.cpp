#include "coupling/added_mass.hpp"

#include <gtest/gtest.h>

namespace pliant {
namespace {

BodyKind sphere_of(double density) {
  BodyKind kind;
  kind.config.motion = MotionKind::rigid;
  kind.rigid.mass = density;
  kind.added_mass_ratio = 0.5 / density;  // the fluid has density 1
  return kind;
}

TEST(ChooseCoupling, PutsBodiesAsHeavyAsTheFluidUnderStrongCoupling) {
  std::string reason;
  EXPECT_EQ(choose_coupling(sphere_of(1.0), reason), CouplingKind::strong);
  EXPECT_NE(reason.find("0.5"), std::string::npos) << reason;
}

TEST(ChooseCoupling, LeavesTheSettlingSpheresOfTenCateToLooseCoupling) {
  std::string reason;
  EXPECT_EQ(choose_coupling(sphere_of(1120.0 / 970), reason), CouplingKind::loose);
}

TEST(ChooseCoupling, TakesWhatIsAskedFor) {
  std::string reason;
  auto light = sphere_of(0.1);
  light.config.coupling = CouplingKind::loose;
  EXPECT_EQ(choose_coupling(light, reason), CouplingKind::loose);
}

}  // namespace
}  // namespace pliant
