#include "mesh/box_cells.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "mesh/distance.hpp"

namespace pliant {
namespace {

TEST(BoxCells, FindsEachBoxThatMeetsOnceAndNoOther) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1), size(0, 0.3);
  for (const Vec3 extent : {Vec3{1, 1, 1}, Vec3{10, 1, 0}, Vec3{0, 0, 0.01}}) {
    const auto some_box = [&] {
      const Vec3 x{extent.x * place(random), extent.y * place(random), extent.z * place(random)};
      return Box{x, x + Vec3{size(random), size(random), size(random)}};
    };
    std::vector<Box> boxes;
    for (int n = 0; n < 300; ++n) boxes.push_back(some_box());
    boxes.push_back({{-9, -9, -9}, {9, 9, 9}});
    const BoxCells cells(boxes);
    for (int n = 0; n < 200; ++n) {
      const Box asked = some_box();
      std::multiset<int> found, wanted;
      cells.for_each_meeting(asked, [&](int b) { found.insert(b); });
      for (std::size_t b = 0; b < boxes.size(); ++b)
        if (boxes[b].meets(asked)) wanted.insert(static_cast<int>(b));
      EXPECT_EQ(found, wanted);
    }
  }
}

TEST(BoxCells, NoBoxes) {
  BoxCells({}).for_each_meeting({{-1, -1, -1}, {1, 1, 1}}, [](int) { FAIL(); });
}

TEST(NearestAlong, NoOtherPointsAreNearer) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1, 1);
  const auto point = [&] { return Vec3{place(random), place(random), place(random)}; };
  const auto expect_nearest = [](Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1) {
    const auto distance = [&](double s, double t) { return norm(a0 + s * (a1 - a0) - b0 - t * (b1 - b0)); };
    const auto [s, t] = nearest_along(a0, a1, b0, b1);
    ASSERT_TRUE(s >= 0 && s <= 1 && t >= 0 && t <= 1);
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; j <= 40; ++j) EXPECT_GT(distance(i / 40.0, j / 40.0), distance(s, t) - 1e-12);
  };
  for (int n = 0; n < 100; ++n) expect_nearest(point(), point(), point(), point());
  const Vec3 a = point(), b = point(), c = point();
  expect_nearest(a, b, a + c, b + c);  // parallel
  expect_nearest(a, b, b + c, a + c);
  expect_nearest(a, a, b, c);  // points
  expect_nearest(a, b, c, c);
}

}  // namespace
}  // namespace pliant
