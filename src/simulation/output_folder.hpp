#pragma once
#include <filesystem>

#include "parallel/communicator.hpp"

namespace pliant {

enum class EarlierOutputs {
  removed,   ///< of a run that was there before, known by its run.json
  continued  ///< by this run
};

/// Makes the folder of a run's outputs and tries to write in it; files that are no run's outputs stay. Collective.
/// Throws InputError, on all ranks, if the folder cannot be used.
void prepare_output_folder(const std::filesystem::path& folder, const Communicator& ranks, EarlierOutputs earlier);

/// Throws InputError, on all ranks, if the folder holds a run, which one that begins from the `checkpoint` of another
/// would remove. Collective.
void require_unused(const std::filesystem::path& folder, const std::filesystem::path& checkpoint,
                    const Communicator& ranks);

/// Removes the snapshots of steps from `step` on that their series do not list, and what was left half-written: the
/// part of a run after the checkpoint that it continues from. On the root alone.
void remove_unlisted_snapshots(const std::filesystem::path& folder, long step);

}  // namespace pliant
