#pragma once
#include "app/bench_markers.hpp"
#include "app/generic_stencil.hpp"
#include "transfer/direct_forcing.hpp"
#include "transfer/mls_sampler.hpp"

namespace pliant {

/// The transfer between a flow and markers, and its parts, as pieces of work to be timed. Each piece does it all once
/// for every marker of this rank, and makes the stencils that it needs.
class TransferTrial {
 public:
  /// Throws InputError if the box is too small for markers.
  TransferTrial(const Grid& grid, const BenchMarkers& markers);

  /// The six one-dimensional stencils.
  void make_stencils();
  /// A velocity at the markers.
  void interpolate_velocity();
  /// A force from the markers.
  void spread_force();
  /// Pressure and nine velocity gradients at the ends of the probes, in the order in which bodies ask for them.
  void probe_flow();
  /// One full step: three interpolations and three spreads of a vector, one probe.
  void step();
  /// The same with a 4 x 4 solve for each stencil, by plain_method and by lean_method. A marker's stencils are made
  /// once and serve all three substeps.
  void step_by_plain_solves() { step_by(plain_method); }
  void step_by_lean_solves() { step_by(lean_method); }
  /// Sorting and weighing of markers that have moved.
  void place_markers();
  /// A step as a run takes it: placing, forcing with its passes over the force fields, and the flow brought to the
  /// bodies that ask for it. Collective.
  void step_of_run();

  /// Largest difference between the last step() and the last step by solves, relative to the largest value found.
  /// Collective.
  double largest_difference() const;

 private:
  struct Found {
    MarkerVectors velocities;    // in working order
    std::vector<double> probed;  // pressure and gradients, ten numbers an end
  };
  void probe_ends(std::vector<double>& probed);
  void step_by(const GenericMethod& method);
  void step_marker(const GenericMethod& method, std::size_t m);
  void probe_end(const GenericMethod& method, std::size_t n);

  Grid grid_;
  MlsShape shape_;
  Field<FaceX> u_;
  Field<FaceY> v_;
  Field<FaceZ> w_;
  Field<Center> p_;
  std::vector<Vec3> positions_, ends_;  // on or near this rank's slab, brought into the box
  std::vector<Vec3> asked_;             // this rank's share of all ends
  std::vector<FlowSample> samples_;
  std::vector<double> areas_;
  std::vector<Vec3> velocities_;
  Markers markers_;
  ForceFields forces_;
  DirectForcing forcing_;
  MlsSampler sampler_;
  Found closed_, generic_;
  double checksum_ = 0;
};

}  // namespace pliant
