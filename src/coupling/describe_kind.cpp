#include "coupling/describe_kind.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "config/word.hpp"
#include "coupling/added_mass.hpp"
#include "mesh/geometry.hpp"

namespace pliant {

std::string describe(const BodyKind& kind, long copies) {
  const auto& mesh = kind.prototype.mesh;
  auto text = fmt::format("body {}: {}{} vertices, {} faces", kind.config.name,
                          copies > 1 ? fmt::format("{} copies of ", copies) : "", mesh.n_vertices(), mesh.n_faces());
  if (kind.acts_on_flow() && !kind.meets_flow_at_vertices && kind.layout.n_markers() != mesh.n_faces())
    text += fmt::format(", {} markers", kind.layout.n_markers());
  text += fmt::format(", {}", word_for(kind.config.motion));
  if (kind.is_free()) text += fmt::format(", mass {:.6g}", kind.mass);
  if (!kind.has_pose() && kind.acts_on_flow()) {
    const auto lengths = edge_lengths(mesh, kind.prototype.positions);
    const auto [least, most] = std::minmax_element(lengths.begin(), lengths.end());
    text += fmt::format(", edges of {:.2g} to {:.2g} grid spacings", *least / kind.spacing, *most / kind.spacing);
    if (kind.wall_mass_ratio > 0)
      text += fmt::format(", its mass {:.2g} of the fluid's around it", kind.wall_mass_ratio);
  }
  if (const auto& schedule = kind.config.schedule)
    text += fmt::format(", acts on the flow from phase {:.4g} to {:.4g} of each period of {:.6g}", schedule->phase[0],
                        schedule->phase[1], schedule->period);
  std::string reason;
  const auto coupling = choose_coupling(kind, reason);
  if (kind.is_free() || !kind.has_pose() || coupling == CouplingKind::one_way)
    text += fmt::format(", coupling {} ({})", word_for(coupling), reason);
  return text;
}

std::vector<std::string> summarize(const Bodies& bodies) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < bodies.kinds().size(); ++k) {
    const auto& kind = bodies.kinds()[k];
    if (kind.has_pose() || !kind.acts_on_flow()) continue;
    double volume = 0, restored = 0, slip = 0;
    for (const Body& body : bodies.own()) {
      if (body.kind != k) continue;
      slip = std::max(slip, body.slip.rms());
      restored = std::max(restored, std::abs(body.volume_restored));
      if (kind.is_closed())
        volume = std::max(
            volume, std::abs(enclosed_volume(body.surface.mesh, body.surface.positions) / kind.displaced.volume - 1));
    }
    const auto& ranks = bodies.grid().ranks();
    volume = ranks.max(volume);
    restored = ranks.max(restored);
    slip = ranks.max(slip);
    auto text = fmt::format("body {}: slip {:.2g} (rms, of the worst body at the end)", kind.config.name, slip);
    if (kind.is_closed())
      text += fmt::format(", volume off by {:.2g} of it, {:.2g} of it given back during the run", volume, restored);
    lines.push_back(std::move(text));
  }
  return lines;
}

std::vector<std::string> foresee(const BodyKind& kind, const Grid& grid, double step) {
  std::vector<std::string> warnings;
  if (kind.has_pose() || !kind.acts_on_flow()) return warnings;
  const auto& name = kind.config.name;
  if (kind.coupling == CouplingKind::force_spreading && step > force_spreading_limit(kind))
    warnings.push_back(fmt::format(
        "body '{}': with coupling = \"force-spreading\" its stiffness bears fluid steps up to {:.3g}, the step is "
        "{:.3g}: "
        "the run is likely to blow up; take a smaller time.step, leave it to Pliant, or, if the body has mass, "
        "coupling = \"local-mass\"",
        name, force_spreading_limit(kind), step));
  // Measured over twenty times R/U (docs/coupling.md).
  if (kind.coupling == CouplingKind::local_mass && step > 0.5 * kind.convective_step)
    warnings.push_back(fmt::format(
        "body '{}': local-mass slips and loses volume where the flow crosses much of a cell in a step ({:.3g}): below "
        "{:.3g} it does little",
        name, step, 0.4 * kind.convective_step));
  if (kind.coupling == CouplingKind::loose && kind.wall_mass_ratio < sure_loose_wall)
    warnings.push_back(
        fmt::format("body '{}': its wall has {:.2g} times the mass of the fluid around it; loose coupling "
                    "is marginal below {}: force-spreading and local-mass hold at any mass",
                    name, kind.wall_mass_ratio, sure_loose_wall));
  Vec3 lower = kind.prototype.positions[0], upper = lower;
  for (const Vec3& x : kind.prototype.positions)
    for (int d = 0; d < 3; ++d) {
      lower[d] = std::min(lower[d], x[d]);
      upper[d] = std::max(upper[d], x[d]);
    }
  for (int d = 0; d < 3; ++d)
    if (const double share = (upper[d] - lower[d]) / grid.size()[d]; share > 0.5)
      warnings.push_back(
          fmt::format("body '{}' spans {:.2g} of the box along {} before it is turned: walls, or its own "
                      "images through periodic sides, change what it does",
                      name, share, "xyz"[d]));
  return warnings;
}

}  // namespace pliant
