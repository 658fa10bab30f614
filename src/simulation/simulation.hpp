#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "config/case_config.hpp"
#include "coupling/bodies.hpp"
#include "flow/flow_solver.hpp"
#include "simulation/checkpoints.hpp"
#include "simulation/progress.hpp"

namespace pliant {

struct SimulationOptions {
  std::filesystem::path output = "out";  ///< folder for all files of the run
  ProgressStyle progress = ProgressStyle::automatic;
  std::optional<RestartRequest> restart = std::nullopt;  ///< none: from the initial flow
  std::optional<double> wall_clock = std::nullopt;       ///< seconds in which the run has to end; none: no limit
};

enum class RunEnd { end_time, max_steps, signal, wall_clock };

/// How a run came to its end; a run that fails throws instead.
struct RunResult {
  RunEnd end = RunEnd::end_time;
  int signal = 0;  ///< the one that stopped it
  long steps = 0;
  double time = 0;

  /// For the shell: 0, or 128 + the signal that stopped the run, as a program has that the signal ended.
  int exit_code() const { return signal == 0 ? 0 : 128 + signal; }
};

/// A case that runs: the fluid, the bodies in it, and the files that they leave behind.
class Simulation {
 public:
  /// Called after every step, and once before the first. Must do the same on all ranks.
  using Observer = std::function<void(const Simulation&)>;

  /// Collective. Sets everything up and prepares the output folder, but computes nothing yet.
  /// Throws InputError: more ranks than planes, a bad mesh, a folder that cannot be written, a checkpoint that is
  /// refused.
  Simulation(const CaseConfig& config, const Communicator& ranks, SimulationOptions options);
  ~Simulation();

  /// Collective. Runs to the end of the case. A failure of the numbers or of the disk is a RunError (CollectiveError
  /// where all ranks know of it); run.json then says so, and the files written before are whole.
  RunResult run(const Observer& observer = nullptr);

  const CaseConfig& config() const;
  const FlowSolver& flow() const;
  const Bodies& bodies() const;
  long step() const;
  double time() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pliant
