#pragma once
#include <optional>
#include <span>

#include "config/case_config.hpp"
#include "diagnostics/centered_flow.hpp"
#include "diagnostics/inside.hpp"

namespace pliant {

/// The flow inside a surface, cells that are partly inside counted by their share.
struct CavityFlow {
  double volume = 0;  ///< of the cells
  double kinetic_energy = 0;
  double enstrophy = 0;  ///< half the integral of the vorticity squared
  double jet_depth = 0;  ///< how far beyond its origin the jet is faster than its threshold; 0 if it is nowhere
};

/// All ranks hand in the same pieces. Ghosts must be filled. Collective.
CavityFlow find_cavity_flow(const Grid& grid, std::span<const InsidePiece> pieces, const FlowState& state,
                            const CenteredFlow& centered, double density, const std::optional<JetConfig>& jet);

}  // namespace pliant
