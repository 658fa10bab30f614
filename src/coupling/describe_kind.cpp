#include "coupling/describe_kind.hpp"

#include <fmt/format.h>

#include "config/word.hpp"
#include "coupling/added_mass.hpp"

namespace pliant {

std::string describe(const BodyKind& kind, long copies) {
  const auto& mesh = kind.prototype.mesh;
  auto text = fmt::format("body {}: {}{} vertices, {} faces", kind.config.name,
                          copies > 1 ? fmt::format("{} copies of ", copies) : "", mesh.n_vertices(), mesh.n_faces());
  if (kind.acts_on_flow() && !kind.meets_flow_at_vertices && kind.layout.n_markers() != mesh.n_faces())
    text += fmt::format(", {} markers", kind.layout.n_markers());
  text += fmt::format(", {}", word_for(kind.config.motion));
  if (kind.is_free()) text += fmt::format(", mass {:.6g}", kind.mass);
  std::string reason;
  const auto coupling = choose_coupling(kind, reason);
  if (kind.is_free() || !kind.has_pose() || coupling == CouplingKind::one_way)
    text += fmt::format(", coupling {} ({})", word_for(coupling), reason);
  return text;
}

}  // namespace pliant
