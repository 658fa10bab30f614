#include <gtest/gtest.h>

#include <fstream>

#include "core/error.hpp"
#include "io/csv_writer.hpp"
#include "io/xdmf_series.hpp"
#include "unit/io/temporary_folder.hpp"

// Files that a run continues: cut back to where the checkpoint was, then as if nothing had happened.
namespace pliant {
namespace {

TEST(Resume, ATableLosesTheLinesAfterTheCheckpoint) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.csv";
  std::int64_t size = 0;
  {
    CsvWriter table(path, {"step", "x"});
    table.write_row({1, 0.1});
    size = table.size();
    table.write_row({2, 0.2});
  }
  std::ofstream(path, std::ios::app) << "3,0.";  // a line that was cut
  {
    CsvWriter table(path, {"step", "x"}, size);
    EXPECT_EQ(table.size(), size);
    table.write_row({2, 0.25});
  }
  EXPECT_EQ(text_of(path), "step,x\n1,0.1\n2,0.25\n");
}

TEST(Resume, ATableThatIsNotTheOneIsLeftAlone) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.csv";
  std::ofstream(path) << "step,x\n1,0.1\n";
  EXPECT_THROW(CsvWriter(path, {"step", "y"}, 7), RunError);
  EXPECT_THROW(CsvWriter(path, {"step", "x"}, 100), RunError);
  EXPECT_THROW(CsvWriter(folder.path() / "b.csv", {"step", "x"}, 7), RunError);
  EXPECT_EQ(text_of(path), "step,x\n1,0.1\n");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.csv"));
}

TEST(Resume, ASeriesGoesOnAfterItsFirstSnapshots) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.xdmf", other = folder.path() / "b.xdmf";
  const auto body = [](int n) { return "<Topology at=\"" + std::to_string(n) + "\"/>\n"; };
  XdmfSeries whole(path, "a & b"), part(other, "a & b");
  const double times[] = {0, 0.1, 1.0 / 3, 1e-17, 12345.678901234567};
  for (int n = 0; n < 5; ++n) whole.add(times[n], body(n));
  for (int n = 0; n < 3; ++n) part.add(times[n], body(n));
  part.add(7, body(7));
  XdmfSeries resumed(other, "a & b");
  resumed.resume(3);
  EXPECT_EQ(text_of(other).find("\"7\""), std::string::npos) << "cut back at once";
  for (int n = 3; n < 5; ++n) resumed.add(times[n], body(n));
  EXPECT_EQ(text_of(other), text_of(path));

  EXPECT_THROW(XdmfSeries(other, "a & b").resume(6), RunError);
  XdmfSeries(other, "a & b").resume(0);
  EXPECT_FALSE(std::filesystem::exists(other));
}

}  // namespace
}  // namespace pliant
