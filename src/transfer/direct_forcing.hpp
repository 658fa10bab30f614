#pragma once
#include <functional>

#include "flow/flow_solver.hpp"
#include "transfer/force_fields.hpp"
#include "transfer/interpolate.hpp"
#include "transfer/velocity_copies.hpp"

namespace pliant {

/// Markers that are placed once a run, and those that are placed anew in every step.
enum class MarkerGroup { fixed, moving };

/// Makes the fluid follow markers: in every substep, between prediction and projection,
///
///   F = (V - U) / (alpha dt) at the markers, spread to the nodes: u += alpha dt f,
///
/// V the wanted and U the interpolated velocity; repeated `iterations` times (multi-direct forcing).
///
/// Sheets have fluid on both sides. Their force is spread over a layer, as their velocity is interpolated from one, so
/// that a flow u = V + a|y| along a thin sheet is seen as V + a d by its markers, d = sum_ij phi_i phi_j |y_i - y_j|:
/// with U = V it would be at rest d outside on either side, as at a plate 2 d thick. As a unit of area takes the force
/// 2 nu a from the flow, U = V - d/(2 nu) h F is what is asked for, of the components along the sheet:
///
///   F <- F + ((V - U)/(alpha dt) - r F)/(1 + r),   r = d h/(2 nu alpha dt), F: all of this substep.
///
/// Of markers that stay where they are, a substep may begin with the forces that it took in the one before (carried):
/// U is then what these leave. One comparison of velocities takes away only a part of what passes between the nodes,
/// and a load that lasts, such as the pressure on a wall, brings it back in every substep: carried forces meet it.
///
/// Results are the same bits at every run; on other numbers of ranks they differ by round-off.
class DirectForcing {
 public:
  /// `density` of the fluid; iterations >= 1. Throws InputError if the box is too small for markers.
  DirectForcing(const Grid& grid, double density, int iterations = 1);

  /// The markers of a group from now on: positions, areas and wanted velocities of all that may touch this rank. Throws
  /// RunError if a marker is outside the box. Sets the group's forces to zero.
  void place(std::span<const Vec3> positions, std::span<const double> areas, std::span<const Vec3> velocities,
             MarkerGroup group = MarkerGroup::moving);
  /// Sums what the ranks know of the group's markers, by the caller's index, and tells it to all that hold them:
  /// PointRouter::collect, then send.
  using Completion = std::function<void(std::vector<Vec3>&)>;
  /// Which of the group's markers, as they were placed, are those of thin sheets: unit normals, zero for all others.
  /// Until the group is placed anew. Collective in that all ranks call it or none.
  void set_sheets(std::span<const Vec3> normals, double viscosity, Completion complete,
                  MarkerGroup group = MarkerGroup::moving);
  /// Lets the next substep begin with these forces (accelerations of the fluid at the markers), by the caller's index,
  /// and every one after it with what the one before it took; until the group is placed anew. Collective in that all
  /// ranks call it or none.
  void carry(std::span<const Vec3> forces, MarkerGroup group);
  /// Adds what is carried to forces[i], by the caller's index; only the components that this rank works on.
  void add_carried(std::span<Vec3> forces, MarkerGroup group) const;
  /// New wanted velocities of the same markers, in the caller's order.
  void set_velocities(std::span<const Vec3> velocities, MarkerGroup group = MarkerGroup::moving);

  /// The forcing of one substep; a PredictedFlowHook. Collective. Ghosts must be filled, and are not afterwards.
  void apply(const Substep& substep, double dt, View<FaceX> u, View<FaceY> v, View<FaceZ> w);

  /// Adds to forces[i] the mean force of the fluid on marker i over the last step, by the caller's index; only the
  /// components that this rank works on: their sum over the ranks is the force.
  void add_forces(std::span<Vec3> forces, MarkerGroup group = MarkerGroup::moving) const;

  /// Root mean square of V - U at all markers, for a velocity whose ghosts are filled. Collective; 0 without markers.
  double rms_slip(ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w);

  /// Adds to velocities[i] the flow's velocity at marker i, by the caller's index, for a velocity whose ghosts are
  /// filled; only the components that this rank works on: their sum over the ranks, all others exact zeros, is the
  /// velocity.
  void add_velocities(ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w, std::span<Vec3> velocities,
                      MarkerGroup group = MarkerGroup::moving);

  /// Largest factor c = A h / sum_k phi_k dV_k by which this rank's markers spread their forces, 0 without markers.
  /// Where it is largest_stable_correction or more, a marker changes the flow by more than twice what it wants to and
  /// the flow blows up: its face is too large for the grid (MarkerLayout, refinement_for).
  double largest_correction() const;
  static constexpr double largest_stable_correction = 2;

  const Markers& markers(MarkerGroup group = MarkerGroup::moving) const { return set_of(group).markers; }

 private:
  struct Set {
    explicit Set(const Grid& grid) : markers(grid) {}
    Markers markers;
    MarkerVectors wanted, found, impulse;  // impulse: mean force on the fluid over the step
    MarkerVectors carried;
    bool carries = false;
    Completion complete;             // of a group with sheets
    std::vector<Vec3> normals;       // in working order
    std::vector<Vec3> along;         // force along the sheet so far in this substep
    std::vector<double> resistance;  // d h/(2 nu), a time; 0: not of a sheet
    std::vector<Vec3> whole;         // by the caller's index
  };
  Set& set_of(MarkerGroup group) { return sets_[static_cast<std::size_t>(group)]; }
  const Set& set_of(MarkerGroup group) const { return sets_[static_cast<std::size_t>(group)]; }
  bool spread_carried(double weight, double dt_alpha, View<FaceX> u, View<FaceY> v, View<FaceZ> w);
  void force_once(double weight, double dt_alpha, View<FaceX> u, View<FaceY> v, View<FaceZ> w);
  void force_set(Set& set, bool is_last, double weight, double dt_alpha, View<FaceX> u, View<FaceY> v, View<FaceZ> w);
  void begin_along(Set& set);
  static void add_shares(const Set& set, const MarkerVectors& vectors, std::span<Vec3> sums);
  void force_sheets(Set& set, double weight, double dt_alpha, View<FaceX> u, View<FaceY> v, View<FaceZ> w);

  Grid grid_;
  std::array<Set, 2> sets_;
  ForceFields fields_;
  VelocityCopies copies_;
  double density_;
  int iterations_;
};

}  // namespace pliant
