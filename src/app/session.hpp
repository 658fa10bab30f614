#pragma once
#include <string>

namespace pliant {

/// MPI from start to end of the program.
class Session {
 public:
  Session(int& argc, char**& argv);

  /// Ends the program on all ranks with the largest of their exit codes. Ranks that fail while others compute wait a
  /// while for them; if they do not come, because they hang in a call that will never be answered, the run is aborted.
  /// After a failed run the process ends here.
  [[nodiscard]] int end_together(int code);
};

/// "Open MPI v4.1.4".
std::string mpi_library();

}  // namespace pliant
