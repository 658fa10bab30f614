#pragma once
#include <string>

namespace pliant {

/// What was built, from what, with what.
struct BuildInfo {
  std::string version;   ///< "0.1.0"
  std::string commit;    ///< of the sources, "-dirty" if they were changed; "unknown" without git
  std::string compiler;  ///< "GNU 12.2.0"
  std::string flags;     ///< build type and optimisation
};
BuildInfo build_info();

}  // namespace pliant
