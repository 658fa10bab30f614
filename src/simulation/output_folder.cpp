#include "simulation/output_folder.hpp"

#include <fmt/format.h>

#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "parallel/agree.hpp"

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
  remove_matching(folder / "checkpoints", std::regex("step_[0-9]{6,}\\.checkpoint(\\.tmp)?"));
  remove_matching(folder / "fields", snapshots);
  remove_matching(folder / "surfaces", snapshots);
  remove_matching(folder / "phase_average", snapshots);
  remove_matching(folder / "bodies", tables);
  remove_matching(folder / "cavities", tables);
  remove_matching(folder, series);
  fs::remove(folder / "history.csv");
  fs::remove(folder / "run.json");
}

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

void prepare_output_folder(const std::filesystem::path& folder, const Communicator& ranks, EarlierOutputs earlier) {
  try {
    do_on_root(ranks, [&] {
      fs::create_directories(folder);
      write_file_atomically(folder / "write-test", "Pliant can write here\n");
      fs::remove(folder / "write-test");
      if (earlier == EarlierOutputs::removed) remove_previous_run(folder);
    });
  } catch (const CollectiveError& error) {
    throw InputError(
        fmt::format("the output folder {} cannot be used: {}; choose another with --out, or free the place",
                    folder.string(), error.what()));
  }
}

void require_unused(const std::filesystem::path& folder, const std::filesystem::path& checkpoint,
                    const Communicator& ranks) {
  try {
    do_on_root(ranks, [&] {
      if (!fs::exists(folder / "run.json")) return;
      throw RunError(
          fmt::format("{0} holds a run, but not the checkpoint {1}: begin in another folder with --out DIR, or put the "
                      "file into {2} to go on with that run",
                      folder.string(), checkpoint.string(), (folder / "checkpoints").string()));
    });
  } catch (const CollectiveError& error) { throw InputError(error.what()); }
}

void remove_unlisted_snapshots(const std::filesystem::path& folder, long step) {
  const std::regex snapshot("(.*)_([0-9]{6,})\\.h5(\\.tmp)?");
  std::map<std::string, std::string> listed;  // the text of a series by its name
  std::vector<fs::path> unlisted;
  for (const char* kind : {"fields", "surfaces"}) {
    if (!fs::is_directory(folder / kind)) continue;
    for (const auto& entry : fs::directory_iterator(folder / kind)) {
      const auto name = entry.path().filename().string();
      std::smatch parts;
      if (!std::regex_match(name, parts, snapshot) || std::stol(parts[2]) < step) continue;
      const auto series = parts[1].str();
      if (!listed.contains(series)) listed[series] = text_of(folder / (series + ".xdmf"));
      if (listed[series].find(std::string(kind) + "/" + name + ":") == std::string::npos)
        unlisted.push_back(entry.path());
    }
  }
  for (const auto& path : unlisted) fs::remove(path);
  remove_matching(folder / "checkpoints", std::regex(".*\\.checkpoint\\.tmp"));
  remove_matching(folder, std::regex("(.*\\.xdmf|run\\.json)\\.tmp"));
}

}  // namespace pliant
