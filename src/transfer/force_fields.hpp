#pragma once
#include <vector>

#include "boundary/periodic_ghosts.hpp"
#include "parallel/slab_halo.hpp"
#include "transfer/markers.hpp"

namespace pliant {

/// A force on the fluid at the nodes of u, v and w, apart from the velocity, so that the order of bodies does not show.
/// Only the parts of planes that markers reach are ever touched: the cost follows the bodies, not the box.
class ForceFields {
 public:
  explicit ForceFields(const Grid& grid);

  View<FaceX> x() { return x_.view(); }
  View<FaceY> y() { return y_.view(); }
  View<FaceZ> z() { return z_.view(); }

  /// Empties the fields and makes room for what these markers spread, besides those that are always there.
  void reach(const Markers& markers);
  /// Markers that stay; a call of reach() must follow.
  void reach_always(const Markers& markers);
  /// Sets all forces to zero.
  void clear();
  /// Brings what was spread into ghosts to the nodes they are copies of: periodic sides, then other ranks. Collective.
  /// Afterwards only the interior counts.
  void gather();
  /// u += factor times force, at the nodes that are unknowns: not at a bounded side's own face.
  void add_to(double factor, View<FaceX> u, View<FaceY> v, View<FaceZ> w) const;

 private:
  PlaneRegion& region(int k) { return regions_[static_cast<std::size_t>(k + 1)]; }
  const PlaneRegion& region(int k) const { return regions_[static_cast<std::size_t>(k + 1)]; }
  void include(const Markers& markers);
  void include(const int (&first)[n_stencil_lines][mls_batch], int lane);
  void widen();

  Grid grid_;
  Field<FaceX> x_;
  Field<FaceY> y_;
  Field<FaceZ> z_;
  SlabHalo halo_;
  std::vector<PlaneRegion> regions_;  // of planes -1 .. nz
  std::vector<PlaneRegion> always_;   // the part of the markers that stay
};

}  // namespace pliant
