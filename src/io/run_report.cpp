#include "io/run_report.hpp"

#include <fmt/chrono.h>
#include <hdf5.h>

#include <ctime>
#include <fstream>

#include "config/print_case.hpp"
#include "config/quantity.hpp"
#include "core/version.hpp"
#include "io/atomic_file.hpp"

namespace pliant {
namespace {

std::string now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

std::string mpi_version() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = {};
  int length = 0;
  if (MPI_Get_library_version(text, &length) != MPI_SUCCESS) return "unknown";
  const std::string full(text, static_cast<std::size_t>(length));
  return full.substr(0, full.find(','));
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  if (H5get_libversion(&major, &minor, &release) < 0) return "unknown";
  return fmt::format("{}.{}.{}", major, minor, release);
}

}  // namespace

RunReport::RunReport(std::filesystem::path path, const CaseConfig& config, const Communicator& ranks)
    : path_(std::move(path)) {
  const auto build = build_info();
  content_["title"] = config.title;
  content_["status"] = "running";
  content_["started"] = now();
  content_["ended"] = nullptr;
  content_["steps"] = 0;
  content_["time"] = 0.0;
  content_["wall_seconds"] = 0.0;
  content_["ranks"] = ranks.size();
  content_["restarts"] = Json::array();
  content_["program"] = {{"version", build.version}, {"commit", build.commit}, {"compiler", build.compiler},
                         {"flags", build.flags},     {"mpi", mpi_version()},   {"hdf5", hdf5_version()}};
  content_["case_file"] = config.file.string();
  content_["seconds_by_phase"] = Json::object();
  if (const auto scales = config.units ? scales_of(*config.units) : std::nullopt) {
    auto& own = content_["own_units_in_si"];
    for (const char* name : {"length", "time", "mass", "velocity", "force", "pressure", "energy", "area", "volume"})
      own[name] = scales->of(parse_key_unit(name)->dimension);
    own["density"] = scales->of({-3, 0, 1});
    own["flow_rate"] = scales->of({3, -1, 0});
    own["viscosity"] = scales->of({-1, -1, 1});
  }
  content_["case"] = resolved_case(config);
}

void RunReport::note_restart(const std::filesystem::path& checkpoint, long step, double time) {
  std::ifstream file(path_);
  const auto before = Json::parse(file, nullptr, false);
  if (before.is_object()) {
    content_["started"] = before.value("started", content_["started"]);
    if (before.contains("restarts")) content_["restarts"] = before["restarts"];
  }
  content_["restarts"].push_back({{"at", now()},
                                  {"checkpoint", checkpoint.string()},
                                  {"step", step},
                                  {"time", time},
                                  {"ranks", content_["ranks"]}});
}

void RunReport::write(const RunStatus& status) {
  content_["status"] = status.status;
  content_["steps"] = status.steps;
  content_["time"] = status.time;
  content_["wall_seconds"] = status.wall_seconds;
  if (status.status != "running") content_["ended"] = now();
  content_["seconds_by_phase"] = status.seconds;
  // Texts that are not UTF-8 (a file name, say) must not keep the report from being written.
  write_file_atomically(path_, content_.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace pliant
