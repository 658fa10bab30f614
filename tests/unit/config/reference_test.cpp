#include "config/reference.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "config/edit_distance.hpp"

namespace pliant {
namespace {

TEST(CaseReference, CommittedFileIsUpToDate) {
  std::ifstream stream(PLIANT_SOURCE_DIR "/docs/case-reference.md");
  const std::string committed{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(committed, case_reference()) << "run: pliant reference > docs/case-reference.md";
}

TEST(EditDistance, CountsEdits) {
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("abc", "abc"), 0);
  EXPECT_EQ(edit_distance("viscocity", "viscosity"), 1);
  EXPECT_EQ(edit_distance("cfl", "clf"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(EditDistance, FindsAKeyInAnotherSection) {
  const std::vector<std::string> keys{"box.size", "fluid.viscosity", "time.end"};
  EXPECT_EQ(nearest_name("box.viscosity", keys), "fluid.viscosity");
  EXPECT_EQ(nearest_name("box.sise", keys), "box.size");
}

}  // namespace
}  // namespace pliant
