#include "app/load_case.hpp"

#include <algorithm>

#include "config/read_case.hpp"
#include "config/validate.hpp"
#include "core/error.hpp"
#include "mesh/read_surface.hpp"

namespace pliant {
namespace {
void check_surface_file(const CaseConfig& config, std::size_t index, std::vector<std::string>& problems) {
  const auto& body = config.bodies[index];
  const auto* file = std::get_if<FileSurface>(&body.surface);
  if (!file) return;  // the reader of the case knows how far a built-in shape reaches
  const auto surface = read_surface(config.folder / file->file, Closure::closed);
  Vec3 lower = surface.positions.front(), upper = lower;
  for (const Vec3 x : surface.positions) {
    for (int d = 0; d < 3; ++d) {
      lower[d] = std::min(lower[d], x[d]);
      upper[d] = std::max(upper[d], x[d]);
    }
  }
  check_body_extent(config, index, body.center + file->scale * lower, body.center + file->scale * upper, problems);
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
