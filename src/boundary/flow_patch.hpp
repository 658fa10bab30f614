#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "grid/grid.hpp"
#include "signals/signal.hpp"

namespace pliant {

/// A patch of a z side on the faces of a grid.
struct FlowPatch {
  std::string name;
  std::optional<Signal> signal;  ///< none: the patch balances the flow
  std::optional<std::array<double, 2>> phase;
  std::vector<std::array<int, 2>> faces;  ///< (i, j) whose centres lie in the patch
  std::vector<double> weights;  ///< velocity into the box over flow rate; sums to 1 over the faces, times their area
  double area = 0;              ///< of the faces

  bool balances() const { return !signal; }
  /// Flow rate into the box that the signal asks for; 0 out of phase.
  double flow_rate(double time) const;
};

/// The patches of one side. Throws InputError: a flow rate that is neither signal nor formula, a patch that holds the
/// centre of no face.
std::vector<FlowPatch> make_flow_patches(const std::vector<PatchConfig>& patches, const Grid& grid,
                                         const Signals& signals);

}  // namespace pliant
