#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace pliant {

/// Exit codes of the program; a failed run never exits with success.
enum ExitCode : int { exit_success = 0, exit_input_error = 2, exit_run_error = 3 };

/// The input is wrong. Carries every problem found, each a full sentence naming file, key or line and what to do.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<std::string> problems);
  explicit InputError(std::string problem) : InputError(std::vector<std::string>{std::move(problem)}) {}
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

/// The run failed: a numerical breakdown, a full disk, a library's error code.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A failure that every rank knows of and throws alike, so that one of them may speak for all and collective clean-up
/// is still possible.
class CollectiveError : public RunError {
 public:
  using RunError::RunError;
};

}  // namespace pliant
