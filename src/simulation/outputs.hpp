#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "flow/flow_solver.hpp"
#include "io/csv_writer.hpp"
#include "io/field_writer.hpp"
#include "io/surface_writer.hpp"
#include "simulation/body_tables.hpp"
#include "simulation/cavities.hpp"
#include "simulation/outputs_state.hpp"
#include "simulation/schedule.hpp"

namespace pliant {

/// One line of OUT/history.csv, in the order of its columns.
struct HistoryRow {
  double dt = 0, cfl = 0, divergence = 0, kinetic_energy = 0;
  Vec3 bulk_velocity;
  double bulk_forcing = 0;
  int coupling_iterations = 0;           ///< of strong coupling in the last step
  std::vector<double> patch_flow_rates;  ///< one column each, in the order of the case
};

enum class Urgency {
  scheduled,  ///< what is due now
  last        ///< every wanted series, as the run ends
};

/// All files that grow during a run: history and bodies as tables, fields and surfaces as series. Docs:
/// docs/output-files.md. All functions are collective and throw CollectiveError when a file cannot be written.
class Outputs {
 public:
  /// Starts the tables, or continues the files that are there where `resumed` says how far they had grown: what came
  /// later is cut off and removed. `folder` exists and can be written.
  Outputs(const std::filesystem::path& folder, const CaseConfig& config, const Grid& grid, const Bodies& bodies,
          const Cavities& cavities, const OutputsState* resumed = nullptr);

  /// How far the files have grown. Not collective: what the root says counts.
  OutputsState state() const;
  /// Waits until the tables and series are on the disk. On the root alone. Throws RunError.
  void bring_to_disk() const;

  /// The next time at which a snapshot has to be taken.
  double next_time(double time) const;
  bool is_history_due(long step) const { return step % history_.every == 0; }

  /// True unless the lines of this step are there already.
  bool write_history(Moment moment, const HistoryRow& row, const Bodies& bodies, const Cavities& cavities);
  /// See BodyTables.
  const std::vector<double>& body_energies() const { return body_tables_->energies(); }
  /// Whether write_snapshots would write surfaces, so that their stresses are wanted.
  bool has_surfaces_due(Moment moment, Urgency urgency) const;
  /// Writes the snapshots that are due, and none twice. True if there were any.
  bool write_snapshots(Moment moment, const FlowSolver& flow, const Bodies& bodies, Urgency urgency);
  /// Writes fields and surfaces whether they are wanted or not: the evidence of a run that failed.
  void write_evidence(Moment moment, const FlowSolver& flow, const Bodies& bodies);

 private:
  bool is_due(const Schedule& schedule, Moment moment, Urgency urgency) const;
  std::unique_ptr<CsvWriter> make_table(const std::string& file, std::vector<std::string> columns,
                                        const OutputsState* resumed) const;
  void resume(const OutputsState& state);
  void write_fields(Moment moment, const FlowSolver& flow);
  void write_surfaces(Moment moment, const Bodies& bodies);

  std::filesystem::path folder_;
  Communicator ranks_;
  HistoryConfig history_;
  Schedule fields_due_, surfaces_due_;
  std::shared_ptr<const CenteredFlow> centered_;
  bool with_vorticity_;
  FieldWriter fields_;
  std::vector<SurfaceWriter> surfaces_;
  std::unique_ptr<CsvWriter> history_table_;  // on the root
  std::optional<BodyTables> body_tables_;
  std::vector<std::unique_ptr<CsvWriter>> cavity_tables_;  // on the root
  long last_history_ = -1, last_fields_ = -1, last_surfaces_ = -1;
};

}  // namespace pliant
