#include "app/load_case.hpp"

#include <algorithm>

#include "config/read_case.hpp"
#include "config/validate.hpp"
#include "core/error.hpp"
#include "structure/make_body.hpp"

namespace pliant {
namespace {
void check_surface_file(const CaseConfig& config, std::size_t index, std::vector<std::string>& problems) {
  const auto& body = config.bodies[index];
  if (!std::holds_alternative<FileSurface>(body.surface)) return;  // the case's reader knows how far a sphere reaches
  const auto surface = load_surface(body, config.folder);
  Vec3 lower = surface.positions.front(), upper = lower;
  for (const Vec3 x : surface.positions) {
    for (int d = 0; d < 3; ++d) {
      lower[d] = std::min(lower[d], x[d]);
      upper[d] = std::max(upper[d], x[d]);
    }
  }
  check_body_extent(config, index, lower, upper, problems);
}
}  // namespace

CaseConfig load_case(const CaseArguments& arguments, int ranks) {
  const auto config = read_case(arguments.path, arguments.overrides, ranks);
  std::vector<std::string> problems;
  for (std::size_t i = 0; i < config.bodies.size(); ++i) {
    try {
      check_surface_file(config, i, problems);
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return config;
}

}  // namespace pliant
