#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "diagnostics/centered_flow.hpp"
#include "flow/flow_solver.hpp"
#include "io/xdmf_series.hpp"

namespace pliant {

enum class Precision { single, full };

/// The moment a snapshot shows.
struct Moment {
  long step = 0;
  double time = 0;
};

/// A number (width 1) or vector (width 3) in every cell: `at(i, j, k, out)` puts out what a cell of this rank has.
struct CellQuantity {
  std::string name;
  int width = 1;
  std::function<void(int i, int j, int k, double* out)> at;
};

/// What a snapshot of the flow holds: `velocity`, the mean of a cell's two faces in each direction; `pressure`, in
/// units of density times velocity squared; with vorticity `vorticity`. The flow must outlive it.
std::vector<CellQuantity> flow_quantities(const FlowState& state, double density,
                                          std::shared_ptr<const CenteredFlow> centered, bool with_vorticity);

/// Writes quantities in cells as OUT/<folder>/<name>_<number>.h5, with OUT/<name>.xdmf listing the snapshots.
///
/// A file holds each quantity as [nz][ny][nx] or [nz][ny][nx][3] at the cell centres; the node coordinates x, y, z of
/// the cells; and the attributes `time` and `step`. Single precision by default.
class FieldWriter {
 public:
  /// Nothing is written yet.
  FieldWriter(const std::filesystem::path& output, std::string folder, std::string name, const Grid& grid,
              Precision precision = Precision::single);

  /// Collective. Makes the folder if need be; all ranks write their planes to a temporary file, which the root then
  /// gives its name, numbered by the step. All ranks give the same quantities in the same order. Throws RunError on all
  /// ranks; then the snapshots written before are still whole.
  void write(const std::vector<CellQuantity>& quantities, Moment moment);

  XdmfSeries& series() { return series_; }
  const XdmfSeries& series() const { return series_; }

 private:
  std::filesystem::path output_;
  std::string folder_, name_;
  Grid grid_;
  Precision precision_;
  XdmfSeries series_;
};

}  // namespace pliant
