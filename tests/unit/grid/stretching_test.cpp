#include "grid/stretching.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pliant {
namespace {

std::vector<double> sizes(const std::vector<double>& faces) {
  std::vector<double> result;
  for (std::size_t k = 1; k < faces.size(); ++k) result.push_back(faces[k] - faces[k - 1]);
  return result;
}

constexpr StretchingConfig about_a_sphere{.law = StretchingLaw::cluster, .center = 0.7, .width = 3.4, .growth = 0.06};

TEST(ClusteredFaces, FillTheBoxExactly) {
  for (const double center : {-5.0, -4.9, 0.7, 12.0}) {
    auto stretching = about_a_sphere;
    stretching.center = center;
    for (const int cells : {1, 2, 7, 86}) {
      const auto faces = stretched_faces(stretching, cells, -5, 17);
      ASSERT_EQ(faces.size(), static_cast<std::size_t>(cells) + 1);
      EXPECT_EQ(faces.front(), -5);
      EXPECT_EQ(faces.back(), 12);
      for (const double size : sizes(faces)) EXPECT_GT(size, 0) << center << " " << cells;
    }
  }
}

TEST(ClusteredFaces, AreEvenInTheRangeAndGrowOutside) {
  const auto faces = stretched_faces(about_a_sphere, 86, -5, 17);
  const auto size = sizes(faces);
  double inside = 0;
  for (std::size_t k = 0; k < size.size(); ++k)
    if (faces[k] > -1.0 && faces[k + 1] < 2.4) {
      if (inside == 0) inside = size[k];
      EXPECT_NEAR(size[k], inside, 1e-13);  // rounding of heights about 1
    }
  EXPECT_NEAR(inside, 0.1, 1e-3);  // the number of cells was chosen for this
  for (std::size_t k = 1; k < size.size(); ++k) {
    // Faces are exponentials of their number: neighbours differ by the factor e^growth.
    if (faces[k - 1] > 2.4) { EXPECT_NEAR(size[k] / size[k - 1], std::exp(0.06), 1e-9); }
    if (faces[k + 1] < -1.0) { EXPECT_NEAR(size[k - 1] / size[k], std::exp(0.06), 1e-9); }
  }
}

TEST(ClusteredFaces, AreUniformIfTheRangeIsTheBox) {
  const StretchingConfig stretching{.law = StretchingLaw::cluster, .center = 1, .width = 10, .growth = 0.1};
  const auto faces = stretched_faces(stretching, 13, 0, 2);
  for (int k = 0; k <= 13; ++k) EXPECT_NEAR(faces[static_cast<std::size_t>(k)], 2.0 * k / 13, 1e-14);
}

TEST(ClusteredFaces, RefineAsAFamilyWhenTheGrowthShrinksAlong) {
  // Twice the cells with half the growth: every other face is one of the coarse grid's.
  auto fine = about_a_sphere;
  fine.growth = 0.03;
  const auto coarse_faces = stretched_faces(about_a_sphere, 86, -5, 17),
             fine_faces = stretched_faces(fine, 172, -5, 17);
  for (std::size_t k = 0; k < coarse_faces.size(); ++k) EXPECT_NEAR(coarse_faces[k], fine_faces[2 * k], 1e-11);
}

}  // namespace
}  // namespace pliant
