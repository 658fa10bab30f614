#pragma once
#include <filesystem>

#include "flow/flow_solver.hpp"
#include "core/body_blob.hpp"
#include "io/checkpoint_format.hpp"

namespace pliant {

/// Writes a checkpoint: to a temporary file, which is brought to the disk and then takes the place of what stood under
/// this name. Collective; `bodies` are this rank's, each body from one rank. Throws CollectiveError (a full disk, ...);
/// then nothing is left of it, and what stood there still stands.
void write_checkpoint(const std::filesystem::path& path, const CheckpointHead& head, const FlowSolver& flow,
                      const std::vector<BodyBlob>& bodies);

}  // namespace pliant
