#pragma once
#include <filesystem>

#include "core/body_blob.hpp"
#include "flow/flow_solver.hpp"
#include "io/checkpoint_format.hpp"
#include "io/stored_table.hpp"

namespace pliant {

/// Writes a checkpoint: to a temporary file, which is brought to the disk and then takes the place of what stood under
/// this name. Collective; `bodies` are this rank's, each body from one rank; `more` are tables beside the flow's, the
/// same ones on all ranks. Throws CollectiveError (a full disk, ...);
/// then nothing is left of it, and what stood there still stands.
void write_checkpoint(const std::filesystem::path& path, const CheckpointHead& head, const FlowSolver& flow,
                      const std::vector<BodyBlob>& bodies, const std::vector<StoredTable>& more = {});

}  // namespace pliant
