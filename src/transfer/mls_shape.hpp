#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/lanes.hpp"
#include "grid/grid.hpp"

namespace pliant {

/// Width of the Gaussian weights as a fraction of the support's half-width.
inline constexpr double default_mls_alpha = 0.3;

/// Points are treated in batches of so many.
inline constexpr int mls_batch = n_lanes;

/// The six one-dimensional stencils of a point: every staggered location combines three of them.
enum StencilLine { x_center, x_face, y_center, y_face, z_center, z_face, n_stencil_lines };

/// A number for each of the three nodes of a one-dimensional stencil and each point of a batch.
using StencilNumbers = double[3][mls_batch];

/// Stencils of a batch of points for values: at nodes a, b, c of x, y, z
///
///   phi_abc = v_a w_b w_c + w_a v_b w_c + w_a w_b v_c - 2 w_a w_b w_c
///
/// with the weights w and the values v of the three directions; the sum of either over its nodes is 1.
struct alignas(64) StencilBatch {
  StencilNumbers weight[n_stencil_lines];  ///< normalised Gaussian weights w
  StencilNumbers value[n_stencil_lines];   ///< v: one-dimensional moving least squares, sum of v times offset is 0
  int first[n_stencil_lines][mls_batch];   ///< index of the lowest node; local planes in z
};

/// The same for gradients: d/dx has the weights s_a w_b w_c, and so on.
struct alignas(64) SlopeBatch {
  StencilNumbers slope[n_stencil_lines];  ///< 1 / length
};

/// One-dimensional stencils from the offsets (node minus point, ascending) of any three nodes, for a batch. The
/// half-width of the support is 1.5 local spacings, or the distance to the farthest node if that is more.
void mls_stencils(const StencilNumbers& offsets, double alpha, StencilNumbers& weight, StencilNumbers& value,
                  StencilNumbers& slope);

/// Moving least squares on the staggered grid with a linear basis and a product of one-dimensional Gaussian weights
/// over the 3 x 3 x 3 nodes nearest to a point, in closed form: the moment matrix is a product of one-dimensional
/// moments, so that no system is solved (numerics: section "Transfer"). Linear fields are reproduced to round-off, in
/// value and gradient.
///
/// At bounded sides the three nodes are shifted inwards: no ghost beyond the side is read or written, only faces on the
/// side itself. (A bounded direction of one or two cells has too few nodes for that; there the ghosts serve.)
class MlsShape {
 public:
  /// alpha: width of the weights; the grid's slab is the rank whose planes the stencils count from.
  explicit MlsShape(const Grid& grid, double alpha = default_mls_alpha);

  /// Brings a point back into the box along periodic directions. False if it is not a number or lies beyond a bounded
  /// side.
  bool bring_into_box(Vec3& point) const;

  /// Middle planes of the stencils along z (centres, faces) of a point at height z, by global index, to round-off: a
  /// point at a border between cells may count to either.
  std::array<int, 2> middle_planes(double z) const { return {middle_plane(z_center, z), middle_plane(z_face, z)}; }

  /// False if no stencil of a point at height z can have its middle plane on this rank.
  bool is_near(double z) const;

  /// Stencils of at most mls_batch points, all in the box and near; lanes beyond the last point repeat the first.
  void evaluate(std::span<const Vec3> points, StencilBatch& stencils, SlopeBatch& slopes) const;

  /// Does this rank hold the middle plane of a stencil along z (z_center or z_face)? Then the other two planes are its
  /// own or its ghosts. Every point in the box has exactly one such rank for either line.
  bool is_held(const StencilBatch& stencils, StencilLine line, int lane) const {
    const int middle = stencils.first[line][lane] + 1;
    return middle >= 0 && middle < grid_.nz();
  }

  const Grid& grid() const { return grid_; }

 private:
  struct Direction {
    int cells = 0;
    bool periodic = false;
    double origin = 0, spacing = 0, inverse_spacing = 0;
  };
  struct Middle {
    int node = 0;
    double shift = 0;  // added to the point: a period, or nothing
  };
  // Middle nodes among centres and faces of a uniform direction, and how far they are from the points, in spacings.
  struct UniformOffsets {
    Lanes from[2];
    IntLanes middle[2];
  };
  UniformOffsets uniform_offsets(int direction, Lanes x) const;
  void uniform(int direction, const UniformOffsets& offsets, Lanes center_t, StencilBatch& stencils,
               SlopeBatch& slopes) const;
  void make_shifted(int direction, const UniformOffsets& offsets, const IntLanes (&shift)[2], StencilBatch& stencils,
                    SlopeBatch& slopes) const;
  void stretched(const double* z, StencilBatch& stencils, SlopeBatch& slopes) const;
  Middle stretched_middle(StencilLine line, double z) const;
  int first_node(StencilLine line, int middle) const;
  int lowest_node(StencilLine line) const;
  int highest_node(StencilLine line) const;
  int middle_plane(StencilLine line, double z) const;

  Grid grid_;
  double alpha_;
  double factor_;  // of the offset in the exponent
  double edge_;    // weight of a node one uniform spacing away
  Direction directions_[3];
  bool stretched_z_ = false;
  std::vector<int> cell_of_bucket_;  // where the search for a plane of a stretched z begins
};

}  // namespace pliant
