#pragma once
#include "flow/flow_solver.hpp"
#include "parallel/slab_halo.hpp"
#include "transfer/reached_rows.hpp"

namespace pliant {

/// A force on the fluid at the nodes of u, v and w, apart from the velocity, so that the order of bodies does not show.
/// Only the parts of rows that markers reach are ever touched: the cost follows the bodies, not the box.
class ForceFields : public NodalForces {
 public:
  explicit ForceFields(const Grid& grid);

  View<FaceX> x() { return x_.view(); }
  View<FaceY> y() { return y_.view(); }
  View<FaceZ> z() { return z_.view(); }

  /// Makes room for what these markers spread, besides those that are always there. The fields must be empty.
  void reach(const Markers& markers);
  /// Markers that stay; a call of reach() must follow.
  void reach_always(const Markers& markers);
  /// Sets all forces to zero.
  void clear();
  /// Does gather() and move_to() for the planes below `end` already, while they are in cache. Nothing may be spread to
  /// them any more until move_to(), and no marker may read their velocity.
  void settle(int end, double factor, View<FaceX> u, View<FaceY> v, View<FaceZ> w);
  /// Brings what was spread into ghosts to the nodes they are copies of: periodic sides, then other ranks. Collective.
  /// Afterwards only the interior counts.
  void gather();
  /// u += factor times force, at the nodes that are unknowns: not at a bounded side's own face. Leaves the fields
  /// empty: while they are in cache that costs little.
  void move_to(double factor, View<FaceX> u, View<FaceY> v, View<FaceZ> w);
  /// The same row by row, by the flow: after hand_over() instead of gather(), which leaves the interior alone filled.
  /// Collective.
  void hand_over();
  void take_row(double factor, double* u, double* v, double* w, int j, int k) override;

 private:
  struct Unknowns {
    int u, v, w;  // nodes of a row that are unknowns: the first so many
  };
  Unknowns unknowns_of(int j, int k) const;
  void gather_plane(int k);
  void move_plane(int k, double factor, View<FaceX> u, View<FaceY> v, View<FaceZ> w);

  Grid grid_;
  Field<FaceX> x_;
  Field<FaceY> y_;
  Field<FaceZ> z_;
  SlabHalo halo_;
  ReachedRows reached_;
  ReachedRows always_;  // the part of the markers that stay
  int settled_ = 1;     // planes from 1 to before this one; those at the ends wait for other ranks
};

}  // namespace pliant
