#include "simulation/output_folder.hpp"

#include <fmt/format.h>

#include <regex>

#include "core/error.hpp"
#include "parallel/agree.hpp"
#include "io/atomic_file.hpp"

namespace pliant {
namespace {

namespace fs = std::filesystem;

void remove_matching(const fs::path& folder, const std::regex& pattern) {
  if (!fs::is_directory(folder)) return;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && std::regex_match(entry.path().filename().string(), pattern))
      old.push_back(entry.path());
  for (const auto& path : old) fs::remove(path);
}

void remove_previous_run(const fs::path& folder) {
  if (!fs::exists(folder / "run.json")) return;
  const std::regex snapshots(".*_[0-9]{6,}\\.h5(\\.tmp)?"), tables(".*\\.csv"), series(".*\\.xdmf(\\.tmp)?");
  remove_matching(folder / "fields", snapshots);
  remove_matching(folder / "surfaces", snapshots);
  remove_matching(folder / "bodies", tables);
  remove_matching(folder, series);
  fs::remove(folder / "history.csv");
  fs::remove(folder / "run.json");
}

}  // namespace

void prepare_output_folder(const std::filesystem::path& folder, const Communicator& ranks) {
  try {
    do_on_root(ranks, [&] {
      fs::create_directories(folder);
      write_file_atomically(folder / "write-test", "Pliant can write here\n");
      fs::remove(folder / "write-test");
      remove_previous_run(folder);
    });
  } catch (const CollectiveError& error) {
    throw InputError(
        fmt::format("the output folder {} cannot be used: {}; choose another with --out, or free the place",
                    folder.string(), error.what()));
  }
}

}  // namespace pliant
