#pragma once
#include "flow/flow_solver.hpp"

namespace pliant {

/// All that a step of the flow needs of the steps before it, as a whole that is saved and restored. The explicit terms
/// of the last substep, the pressure increment and the predicted velocity are made anew in every step, so they do not
/// count. FlowSolver's functions of the same names say what each does.
struct FlowRecord {
  const Grid& grid;
  FlowState& state;
  OpenSides& open;
  double& time;
  double& forcing;
  double& rate;

  void save(FlowSnapshot& snapshot) const;
  void restore(const FlowSnapshot& snapshot);

  std::vector<RowTable> tables() const;
  void save_table(std::size_t t, std::span<double> values) const;
  void load_table(std::size_t t, std::span<const double> values);
  std::vector<std::byte> numbers() const;
  void finish_loading(std::span<const std::byte> numbers);
};

}  // namespace pliant
