#pragma once
#include <filesystem>
#include <memory>

#include "flow/flow_solver.hpp"
#include "io/xdmf_series.hpp"

namespace pliant {

enum class Precision { single, full };

/// The moment a snapshot shows.
struct Moment {
  long step = 0;
  double time = 0;
};

/// Writes the flow as OUT/fields/fields_<step>.h5, with OUT/fields.xdmf listing the snapshots.
///
/// A file holds `velocity` [nz][ny][nx][3] and `pressure` [nz][ny][nx] at the cell centres, the velocity averaged from
/// the two faces of the cell in each direction, the pressure in units of density times velocity squared; the node
/// coordinates x, y, z of the cells; and the attributes `time` and `step`. Single precision by default: 16 bytes a
/// cell.
class FieldWriter {
 public:
  /// Nothing is written yet.
  FieldWriter(const std::filesystem::path& output, const Grid& grid, Precision precision = Precision::single);

  /// Collective. Makes the folder if need be; all ranks write their planes to a temporary file, which the root then
  /// gives its name. Throws RunError on all ranks; then the snapshots written before are still whole.
  void write(const FlowState& state, double density, Moment moment);

  XdmfSeries& series() { return series_; }
  const XdmfSeries& series() const { return series_; }

 private:
  std::filesystem::path output_;
  Grid grid_;
  Precision precision_;
  XdmfSeries series_;
};

}  // namespace pliant
