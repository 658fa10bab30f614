#pragma once
#include <memory>
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "config/value_codec.hpp"
#include "core/byte_stream.hpp"
#include "coupling/bodies.hpp"
#include "diagnostics/cavity_flow.hpp"
#include "flow/flow_solver.hpp"
#include "mesh/lids.hpp"
#include "signals/signal.hpp"

namespace pliant {

/// What a cavity did in a cycle, or in the part of it that the run has seen.
struct CavityCycle {
  long number = 0;  ///< from 1
  double begin = 0, end = 0;
  double largest_volume = 0, smallest_volume = 0;
  double largest_difference = 0;  ///< of dV/dt and the flow that comes in, over the peak of the latter

  double stroke_volume() const { return largest_volume - smallest_volume; }
  double ejection_fraction() const { return stroke_volume() / largest_volume; }
};

/// The cavities of a case over time (docs/output-files.md). All ranks know the same.
class Cavities {
 public:
  Cavities(const CaseConfig& config, const Bodies& bodies, const Grid& grid);

  bool any() const { return !cavities_.empty(); }
  std::size_t size() const { return cavities_.size(); }
  const CavityConfig& config(std::size_t n) const { return cavities_[n].config; }

  /// Columns after step and time, of cavity n, and its present values in them.
  std::vector<std::string> columns(std::size_t n) const;
  std::vector<double> row(std::size_t n) const;
  /// Measures all cavities. Collective.
  void measure(double time, const FlowSolver& flow, const Bodies& bodies);

  /// Lines for people about cycles that have ended since the last call.
  std::vector<std::string> take_news();
  /// The same about cycles that the run has left unfinished.
  std::vector<std::string> describe_unfinished() const;
  Json results() const;

  /// What a checkpoint needs.
  void write(ByteWriter& out) const;
  void read(ByteReader& in);

 private:
  struct Cavity {
    CavityConfig config;
    long body = 0;  // its number in the run
    std::shared_ptr<const LiddedSurface> surface;
    double orientation = 1;
    std::optional<Signal> flow;
    double peak = 0;               // of the flow
    std::optional<double> period;  // none: the run is one cycle
    VolumeAndRate now;
    double flow_now = 0, apex_depth = 0;
    CavityFlow inside;
    std::vector<CavityCycle> cycles;  // the last is the present one
    std::size_t told = 0;
  };
  std::vector<InsidePiece> share_pieces(Cavity& cavity, const Bodies& bodies) const;
  static void record(Cavity& cavity, double time);
  static double difference(const Cavity& cavity);
  static std::string describe(const Cavity& cavity, const CavityCycle& cycle);

  Grid grid_;
  double density_;
  CenteredFlow centered_;
  std::vector<Cavity> cavities_;
};

}  // namespace pliant
