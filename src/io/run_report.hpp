#pragma once
#include <filesystem>
#include <string>

#include "config/case_config.hpp"
#include "config/value_codec.hpp"
#include "core/timer.hpp"
#include "parallel/communicator.hpp"

namespace pliant {

/// Where a run stands, for run.json.
struct RunStatus {
  std::string status;  ///< "running", "finished", "stopped by signal 15", "failed: ..."
  long steps = 0;
  double time = 0;                ///< of the simulation
  double wall_seconds = 0;        ///< of the run so far
  PhaseTimer::Seconds seconds{};  ///< by phase, the largest of the ranks
};

/// OUT/run.json: what ran, with what, how long, and how it ended. Not collective: the root alone has one.
class RunReport {
 public:
  /// Takes down the case with every default filled in, the versions and the number of ranks; the run starts now.
  RunReport(std::filesystem::path path, const CaseConfig& config, const Communicator& ranks);

  /// Notes that the run continues from a checkpoint. What the report that is there says of its start and of earlier
  /// restarts is kept.
  void note_restart(const std::filesystem::path& checkpoint, long step, double time);

  /// What the run has found so far, by kind of finding.
  void set_results(Json results) { content_["results"] = std::move(results); }

  /// Rewrites the file in one piece; any status but "running" ends the run now. Throws RunError.
  void write(const RunStatus& status);

 private:
  std::filesystem::path path_;
  Json content_;
};

}  // namespace pliant
