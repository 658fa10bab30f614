#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "config/case_config.hpp"
#include "core/byte_stream.hpp"
#include "diagnostics/centered_flow.hpp"
#include "flow/flow_solver.hpp"
#include "io/stored_table.hpp"

namespace pliant {

/// Means of the flow over all cycles, in equal parts (bins) of the cycle. A sample counts as much as the time since the
/// one before it, and for the bin that it is in itself.
class PhaseAverage {
 public:
  PhaseAverage(const PhaseAverageConfig& config, double period, bool with_vorticity, const Grid& grid,
               const BoundaryConfig& boundary, double density);

  /// Nothing before this time counts.
  void begin_at(double time) { last_time_ = time; }
  bool is_due(long step) const { return step % config_.every == 0; }
  void add(double time, const FlowState& state);
  /// Time that bins have seen.
  const std::vector<double>& weights() const { return weights_; }
  /// OUT/phase_average/phase_average_<bin>.h5 and OUT/phase_average.xdmf, of bins that have seen anything. Collective.
  /// Throws CollectiveError.
  void write_files(const std::filesystem::path& output) const;

  /// Remembers this moment, and goes back to it: one bin or two are copied, not all.
  void keep();
  void roll_back();

  /// What a checkpoint needs: numbers, the same on all ranks, and the sums.
  void write(ByteWriter& out) const;
  /// Takes the numbers; false, with nothing changed, if they are of other bins.
  bool read(ByteReader& in);
  std::vector<StoredTable> tables();

 private:
  using Sums = std::vector<double>;
  Vec3 mean(std::size_t bin, std::size_t cell, std::size_t first) const;
  std::size_t cell(int i, int j, int k) const;

  PhaseAverageConfig config_;
  double period_;
  std::size_t n_numbers_;  // of a cell: velocity, pressure, vorticity
  Grid grid_;
  CenteredFlow centered_;
  double density_;
  std::vector<Sums> sums_;  // by bin
  std::vector<double> weights_;
  double last_time_ = 0;
  std::map<std::size_t, Sums> kept_sums_;
  std::vector<double> kept_weights_;
  double kept_time_ = 0;
  bool is_keeping_ = false;
};

/// Bytes a cell that it takes.
double phase_average_bytes_per_cell(const OutputConfig& config);

}  // namespace pliant
