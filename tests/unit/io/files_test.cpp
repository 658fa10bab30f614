#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <limits>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/csv_writer.hpp"
#include "io/run_report.hpp"
#include "io/xdmf_series.hpp"
#include "temporary_folder.hpp"

namespace pliant {
namespace {

// Lets files grow to a limit only: the system's own stand-in for a full disk.
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit tight = before_;
    tight.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &tight);
  }
  ~SizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

std::string message_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const RunError& error) {
    return error.what();
  }
  return "no error";
}

TEST(AtomicFile, ReplacesTheOldText) {
  TemporaryFolder folder;
  write_file_atomically(folder / "a.txt", "old");
  write_file_atomically(folder / "a.txt", "new");
  EXPECT_EQ(text_of(folder / "a.txt"), "new");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt.tmp"));
}

TEST(AtomicFile, KeepsTheOldTextWhenTheDiskIsFull) {
  TemporaryFolder folder;
  write_file_atomically(folder / "a.txt", "old");
  {
    SizeLimit limit(1000);
    const auto message = message_of([&] { write_file_atomically(folder / "a.txt", std::string(5000, 'x')); });
    EXPECT_NE(message.find("a.txt.tmp"), std::string::npos) << message;
    EXPECT_NE(message.find("File too large"), std::string::npos) << message;
  }
  EXPECT_EQ(text_of(folder / "a.txt"), "old");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt.tmp"));
}

TEST(AtomicFile, NamesAFolderThatIsNotThere) {
  TemporaryFolder folder;
  const auto message = message_of([&] { write_file_atomically(folder / "none/a.txt", "text"); });
  EXPECT_NE(message.find("none/a.txt"), std::string::npos) << message;
  EXPECT_NE(message.find("No such file or directory"), std::string::npos) << message;
}

TEST(AtomicFile, NoticesThatNothingFitsOnAFullDevice) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  PosixFile file("/dev/full");
  EXPECT_NE(message_of([&] { file.append("text"); }).find("No space left on device"), std::string::npos);
}

TEST(CsvWriter, WritesNumbersThatReadBackAsTheSameDoubles) {
  TemporaryFolder folder;
  CsvWriter table(folder / "a.csv", {"step", "x", "y"});
  const std::vector<double> row{12, 0.1, -1.0 / 3};
  table.write_row(row);
  table.write_row({13, std::numeric_limits<double>::quiet_NaN(), HUGE_VAL});
  // Read before the writer is gone: every line is there at once.
  std::ifstream in(folder / "a.csv");
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "step,x,y");
  std::getline(in, line);
  std::istringstream cells(line);
  for (const double expected : row) {
    std::string cell;
    std::getline(cells, cell, ',');
    EXPECT_EQ(std::stod(cell), expected);
  }
  std::getline(in, line);
  EXPECT_EQ(line, "13,nan,inf");
}

TEST(CsvWriter, LeavesWholeLinesWhenTheDiskIsFull) {
  TemporaryFolder folder;
  CsvWriter table(folder / "a.csv", {"a", "b"});
  {
    SizeLimit limit(100);
    EXPECT_THROW({ for (int n = 0; n < 100; ++n) table.write_row({1.0 / (n + 1), 2.0 / (n + 3)}); }, RunError);
  }
  const auto text = text_of(folder / "a.csv");
  ASSERT_FALSE(text.empty());
  EXPECT_EQ(text.back(), '\n');
  table.write_row({7, 8});
  EXPECT_EQ(text_of(folder / "a.csv"), text + "7,8\n");
}

TEST(XdmfSeries, ListsEverySnapshotWithItsTime) {
  TemporaryFolder folder;
  XdmfSeries series(folder / "a.xdmf", "drop <1>");
  series.add(0, "<One/>\n");
  series.add(0.1, "<Two/>\n");
  const auto text = text_of(folder / "a.xdmf");
  EXPECT_LT(text.find("<Time Value=\"0\"/>\n<One/>"), text.find("<Time Value=\"0.1\"/>\n<Two/>"));
  EXPECT_NE(text.find("drop &lt;1&gt;"), std::string::npos);
  EXPECT_EQ(text.find("drop <1>"), std::string::npos);
}

TEST(RunReport, SaysHowTheRunStandsAndEnds) {
  TemporaryFolder folder;
  CaseConfig config;
  config.title = "A test";
  RunReport report(folder / "run.json", config, Communicator());
  report.write({"running"});
  auto json = Json::parse(text_of(folder / "run.json"));
  EXPECT_EQ(json["status"], "running");
  EXPECT_TRUE(json["ended"].is_null());
  report.write({"failed: \"disk\" \xff", 12, 0.5, 3.0, {{"fluid", 2.0}}});
  json = Json::parse(text_of(folder / "run.json"));
  EXPECT_EQ(json["steps"], 12);
  EXPECT_EQ(json["seconds_by_phase"]["fluid"], 2.0);
  EXPECT_FALSE(json["ended"].is_null());
  EXPECT_EQ(json["case"]["title"], "A test");
  EXPECT_TRUE(json["case"].contains("box"));
  EXPECT_EQ(json["ranks"], 1);
}

}  // namespace
}  // namespace pliant
