#pragma once
#include "field/field.hpp"
#include "grid/grid.hpp"
#include "parallel/slab_halo.hpp"

namespace pliant {

/// Ghosts of a velocity that are copies of its nodes, at periodic sides and between ranks. Markers' supports hold no
/// other ghosts, so that this is all they need after the nodes have changed.
class VelocityCopies {
 public:
  explicit VelocityCopies(const Grid& grid);
  /// Collective.
  void fill(View<FaceX> u, View<FaceY> v, View<FaceZ> w);

 private:
  Grid grid_;
  SlabHalo halo_;
};

}  // namespace pliant
