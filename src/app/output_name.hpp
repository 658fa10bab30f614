#pragma once
#include <filesystem>

#include "config/case_config.hpp"

namespace pliant {

/// Where a run writes when it is not told: out/ and the name of the case's folder, or of its file if that is not called
/// case.toml.
inline std::filesystem::path default_output(const CaseConfig& config) {
  const auto file = std::filesystem::absolute(config.file).lexically_normal();
  return std::filesystem::path("out") / (file.filename() == "case.toml" ? file.parent_path().filename() : file.stem());
}

}  // namespace pliant
