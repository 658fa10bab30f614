#pragma once
#include <filesystem>

#include "parallel/communicator.hpp"

namespace pliant {

/// Makes the folder of a run's outputs and tries to write in it; outputs of a run that was there before (known by its
/// run.json) are removed, other files stay. Collective. Throws InputError, on all ranks, if the folder cannot be used.
void prepare_output_folder(const std::filesystem::path& folder, const Communicator& ranks);

}  // namespace pliant
