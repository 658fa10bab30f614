#include "app/load_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "config/read_case.hpp"
#include "config/validate.hpp"
#include "core/error.hpp"
#include "parallel/agree.hpp"
#include "mesh/geometry.hpp"
#include "signals/make_signal.hpp"
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

/// The flow is taken at the ends of the probes, which have to be in the box as the body has.
void check_probes(const CaseConfig& config, std::size_t index, std::vector<std::string>& problems) {
  const auto& body = config.bodies[index];
  const auto form = body.traction.form;
  if (body.motion == MotionKind::fixed || (form != TractionForm::one_sided && form != TractionForm::gradient)) return;
  const auto& box = config.box;
  const Vec3 spacing{box.size.x / box.cells[0], box.size.y / box.cells[1], box.size.z / box.cells[2]};
  const double given = body.traction.probe_length;
  const double length = given > 0 ? given : (spacing.x + spacing.y + spacing.z) / 3;
  const auto surface = load_surface(body, config.folder);
  const auto centroids = face_centroids(surface.mesh, surface.positions);
  const auto normals = face_normals(surface.mesh, surface.positions);
  for (int d = 0; d < 3; ++d) {
    if (is_periodic(config.boundary, d)) continue;
    const auto is_outside = [&](std::size_t f) {
      const double end = centroids[f][d] + length * normals[f][d];
      return end < box.origin[d] || end > box.origin[d] + box.size[d];
    };
    std::size_t f = 0;
    while (f < centroids.size() && !is_outside(f)) ++f;
    if (f == centroids.size()) continue;
    problems.push_back(fmt::format(
        "{} is too close to a side of {}: the probes of its traction, of length {:.4g}, end outside the box; shorten "
        "traction.probe_length, move the body, or choose traction.form = \"drag\"",
        place_of(config, "body." + body.name), "xyz"[d], length));
  }
}
}  // namespace

CaseConfig load_case(const CaseArguments& arguments, int ranks) {
  const auto config = read_case(arguments.path, arguments.overrides, ranks, check_signals);
  std::vector<std::string> problems;
  for (std::size_t i = 0; i < config.bodies.size(); ++i) {
    try {
      const auto before = problems.size();
      check_surface_file(config, i, problems);
      if (problems.size() == before) check_probes(config, i, problems);
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return config;
}

CaseConfig load_case(const CaseArguments& arguments, const Communicator& ranks) {
  std::optional<CaseConfig> config;
  std::optional<InputError> error;
  try {
    config = load_case(arguments, ranks.size());
  } catch (const InputError& found) { error = found; }
  const int failed = ranks.max(error ? 1 : 0);
  const bool alike = failed == 0 || -ranks.max(error ? -1 : 0) == 1;
  if (alike && error) throw *error;
  if (alike) return *config;
  try {
    agree(ranks, error ? fmt::format("rank {}: {}", ranks.rank(), error->what()) : "");
  } catch (const CollectiveError& first) { throw InputError(first.what()); }
  return *config;
}

}  // namespace pliant
