#pragma once
#include <chrono>
#include <filesystem>
#include <memory>

#include "config/case_config.hpp"
#include "config/value_codec.hpp"
#include "core/log.hpp"
#include "io/read_checkpoint.hpp"
#include "io/write_checkpoint.hpp"

namespace pliant {

/// The checkpoints of a run, OUT/checkpoints/step_<step>.checkpoint: when they are due, and how many stay.
class Checkpoints {
 public:
  Checkpoints(const std::filesystem::path& output, const CheckpointConfig& config, const Communicator& ranks);

  bool are_wanted() const { return config_.keep > 0; }
  bool is_due_by_step(long step) const;
  /// By this rank's clock: one rank asks and tells the others.
  bool is_due_by_clock() const;

  /// Writes one, unless that of this step is there already, and then removes the oldest beyond those that stay.
  /// Collective. Throws CollectiveError; then those that were there are still there.
  void write(const CheckpointHead& head, const FlowSolver& flow, const std::vector<BodyBlob>& bodies,
             const std::vector<StoredTable>& more);

  /// The newest of this run, and where it is; -1 if there is none.
  long last_step() const { return last_step_; }
  std::filesystem::path last_path() const;
  /// A run continues from the checkpoint of this step: later ones are removed. Collective.
  void resume_after(long step);

  /// Seconds that the next is expected to take: as long as the slowest so far, or by a slow disk's speed.
  double expected_seconds(const FlowSolver& flow) const;

 private:
  using Clock = std::chrono::steady_clock;
  std::filesystem::path folder_;
  CheckpointConfig config_;
  Communicator ranks_;
  long last_step_ = -1;
  Clock::time_point last_time_ = Clock::now();
  double slowest_ = 0;
};

/// Where a run is to continue from.
struct RestartRequest {
  std::filesystem::path file;  ///< empty: the newest good checkpoint in the output folder
};

/// A checkpoint that has been found good, and its file.
struct OpenCheckpoint {
  std::filesystem::path file;
  std::unique_ptr<CheckpointReader> reader;
};

/// Finds the checkpoint to continue from and verifies all of it. Without a file in the request, damaged ones are passed
/// over with a warning. Collective. Throws InputError, on all ranks, that says why a checkpoint is refused and which
/// older one is good.
OpenCheckpoint open_checkpoint(const RestartRequest& request, const std::filesystem::path& output,
                               const CaseConfig& config, const Communicator& ranks, const Log& log);

}  // namespace pliant
