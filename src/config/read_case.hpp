#pragma once
#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "config/case_config.hpp"

namespace pliant {

/// The case file that `path` means: itself, or the case.toml in it when it is a folder.
std::filesystem::path find_case_file(const std::filesystem::path& path);

/// A check that the reader makes with its own, in the manner of validate: appends to `problems`, and skips what rests
/// on a key in `suspect`.
using CaseCheck =
    std::function<void(const CaseConfig&, const std::set<std::string>& suspect, std::vector<std::string>& problems)>;

/// Reads a case: the file, the "key.path=value" overrides over it, the defaults under it; then validates it for a run
/// on `ranks` ranks. Throws InputError with every problem found in the file and in the values. What only a reader of
/// meshes can see (files of bodies) is not looked at.
CaseConfig read_case(const std::filesystem::path& path, std::span<const std::string> overrides = {}, int ranks = 1,
                     const CaseCheck& further = nullptr);

}  // namespace pliant
