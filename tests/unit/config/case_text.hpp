#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "config/read_case.hpp"
#include "core/error.hpp"

namespace pliant::test {

/// A case file in a folder of its own that lives as long as this.
class TemporaryCase {
 public:
  explicit TemporaryCase(const std::string& text) {
    std::string pattern = (std::filesystem::temp_directory_path() / "pliant-case-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    std::ofstream(folder_ / "case.toml") << text;
  }
  ~TemporaryCase() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  TemporaryCase(const TemporaryCase&) = delete;
  TemporaryCase& operator=(const TemporaryCase&) = delete;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

inline CaseConfig read_text(const std::string& text, const std::vector<std::string>& overrides = {}, int ranks = 1) {
  const TemporaryCase file(text);
  return read_case(file.folder(), overrides, ranks);
}

/// The problems that reading reports; empty when there are none.
inline std::vector<std::string> problems_of(const std::string& text, const std::vector<std::string>& overrides = {},
                                            int ranks = 1) {
  try {
    read_text(text, overrides, ranks);
  } catch (const InputError& error) { return error.problems(); }
  return {};
}

}  // namespace pliant::test
