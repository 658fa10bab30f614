#include "transfer/mls_shape.hpp"

#include <algorithm>
#include <cmath>

#include "transfer/exponentials.hpp"

namespace pliant {
namespace {

bool is_uniform(PlaneValues dz, int n, double spacing) {
  for (int k = 0; k < n; ++k)
    if (std::abs(dz[k] - spacing) > 1e-10 * spacing) return false;
  return true;
}

constexpr int buckets_per_cell = 4;

}  // namespace

void mls_stencils(const StencilNumbers& offsets, double alpha, StencilNumbers& weight, StencilNumbers& value,
                  StencilNumbers& slope) {
  alignas(64) double low[mls_batch], high[mls_batch];
  for (int l = 0; l < mls_batch; ++l) {
    const double a = offsets[0][l], b = offsets[1][l], c = offsets[2][l];
    const double reach = alpha * std::max(0.75 * (c - a), std::max(std::abs(a), std::abs(c)));
    const double scale = 1 / (reach * reach);
    low[l] = (b - a) * (b + a) * scale;
    high[l] = (b - c) * (b + c) * scale;
  }
  exponentials(low, mls_batch);  // weights relative to the middle node's
  exponentials(high, mls_batch);
  for (int l = 0; l < mls_batch; ++l) {
    const double a = offsets[0][l], b = offsets[1][l], c = offsets[2][l];
    const double inverse = 1 / (1 + low[l] + high[l]);
    const double wa = low[l] * inverse, wb = inverse, wc = high[l] * inverse;
    // Moments about the middle node, so that nothing cancels when the point is far outside the three nodes.
    const double mean = wa * (a - b) + wc * (c - b), moment = b + mean;
    const double da = a - b - mean, dc = c - b - mean;
    const double inverse_spread = 1 / (wa * da * da + wb * mean * mean + wc * dc * dc);
    const double sa = wa * da * inverse_spread, sb = -wb * mean * inverse_spread, sc = wc * dc * inverse_spread;
    weight[0][l] = wa, weight[1][l] = wb, weight[2][l] = wc;
    slope[0][l] = sa, slope[1][l] = sb, slope[2][l] = sc;
    value[0][l] = wa - moment * sa, value[1][l] = wb - moment * sb, value[2][l] = wc - moment * sc;
  }
}

MlsShape::MlsShape(const Grid& grid, double alpha)
    : grid_(grid), alpha_(alpha), factor_(2 / (2.25 * alpha * alpha)), edge_(std::exp(-1 / (2.25 * alpha * alpha))) {
  for (int d = 0; d < 3; ++d) {
    const int n = grid.cells()[static_cast<std::size_t>(d)];
    const double h = grid.size()[d] / n;
    directions_[d] = {n, grid.is_periodic(d), grid.origin()[d], h, 1 / h};
  }
  const auto& z = directions_[2];
  stretched_z_ = !is_uniform(grid.global_dz_c(), z.cells, z.spacing);
  if (!stretched_z_) return;
  cell_of_bucket_.resize(static_cast<std::size_t>(buckets_per_cell * z.cells));
  for (std::size_t b = 0; b < cell_of_bucket_.size(); ++b)
    cell_of_bucket_[b] = grid.plane_of_height(z.origin + static_cast<double>(b) * z.spacing / buckets_per_cell);
}

bool MlsShape::bring_into_box(Vec3& point) const {
  for (int d = 0; d < 3; ++d) {
    const double size = grid_.size()[d];
    double x = point[d] - directions_[d].origin;
    if (directions_[d].periodic) x -= size * std::floor(x / size);
    // Written so that what is not a number fails as well.
    if (!(x >= 0 && x <= size)) return false;
    point[d] = directions_[d].origin + x;
  }
  return true;
}

// The lowest of three nodes around the middle one, kept within a bounded box.
int MlsShape::first_node(StencilLine line, int middle) const {
  if (directions_[line / 2].periodic) return middle - 1;
  return std::clamp(middle - 1, lowest_node(line), highest_node(line));
}

// Bounds of the lowest node between bounded sides.
int MlsShape::lowest_node(StencilLine line) const { return line % 2 == 1 || directions_[line / 2].cells < 3 ? -1 : 0; }
int MlsShape::highest_node(StencilLine line) const {
  return std::max(lowest_node(line), directions_[line / 2].cells - 3);
}

MlsShape::Middle MlsShape::stretched_middle(StencilLine line, double z) const {
  const auto& d = directions_[2];
  const auto centers = grid_.global_z_center(), faces = grid_.global_z_face();
  const int buckets = static_cast<int>(cell_of_bucket_.size());
  const int bucket =
      std::clamp(static_cast<int>((z - d.origin) * d.inverse_spacing * buckets_per_cell), 0, buckets - 1);
  int k = cell_of_bucket_[static_cast<std::size_t>(bucket)];
  while (k > 0 && z < faces[k - 1]) --k;
  while (k < d.cells - 1 && z >= faces[k]) ++k;
  if (line == z_face) {
    if (z < centers[k]) --k;
  } else if (z - centers[k - 1] < centers[k] - z) {
    --k;
  } else if (centers[k + 1] - z < z - centers[k]) {
    ++k;
  }
  if (!d.periodic) return {k, 0};
  if (k < 0) return {k + d.cells, grid_.size().z};
  if (k >= d.cells) return {k - d.cells, -grid_.size().z};
  return {k, 0};
}

int MlsShape::middle_plane(StencilLine line, double z) const {
  const auto& d = directions_[2];
  if (stretched_z_) return first_node(line, stretched_middle(line, z).node) + 1;
  const double x = (z - d.origin) * d.inverse_spacing;
  int middle = line == z_face ? static_cast<int>(x + 0.5) - 1 : std::min(static_cast<int>(x), d.cells - 1);
  if (middle < 0 && d.periodic) middle += d.cells;
  return first_node(line, middle) + 1;
}

// A plane to spare on either side: which rank holds a stencil is told by the stencil itself, bit for bit.
bool MlsShape::is_near(double z) const {
  const Slab slab = grid_.slab();
  const int n = directions_[2].cells;
  const auto near = [&](int plane) { return plane >= slab.begin - 1 && plane <= slab.begin + slab.count; };
  for (const StencilLine line : {z_center, z_face}) {
    const int plane = middle_plane(line, z);
    if (near(plane) || (directions_[2].periodic && (near(plane + n) || near(plane - n)))) return true;
  }
  return false;
}

void MlsShape::evaluate(std::span<const Vec3> points, StencilBatch& stencils, SlopeBatch& slopes) const {
  alignas(64) double x[3][mls_batch];
  for (int l = 0; l < mls_batch; ++l) {
    const Vec3& point = points[static_cast<std::size_t>(l) < points.size() ? static_cast<std::size_t>(l) : 0];
    x[0][l] = point.x, x[1][l] = point.y, x[2][l] = point.z;
  }
  const int n_uniform = stretched_z_ ? 2 : 3;
  UniformOffsets offsets[3];
  alignas(64) double t[3 * mls_batch];
  for (int d = 0; d < n_uniform; ++d) {
    offsets[d] = uniform_offsets(d, load_lanes(x[d]));
    store(factor_ * offsets[d].from[0], t + d * mls_batch);
  }
  exponentials(t, n_uniform * mls_batch);
  for (int d = 0; d < n_uniform; ++d) uniform(d, offsets[d], load_lanes(t + d * mls_batch), stencils, slopes);
  if (stretched_z_) stretched(x[2], stencils, slopes);
  const int begin = grid_.slab().begin;
  for (int l = 0; l < mls_batch; ++l) stencils.first[z_center][l] -= begin, stencils.first[z_face][l] -= begin;
}

MlsShape::UniformOffsets MlsShape::uniform_offsets(int direction, Lanes x) const {
  const auto& dir = directions_[direction];
  const Lanes scaled = (x - dir.origin) * dir.inverse_spacing;
  const IntLanes cell = __builtin_convertvector(scaled, IntLanes);
  UniformOffsets offsets;
  offsets.middle[0] = cell < dir.cells ? cell : dir.cells - 1 + IntLanes{};
  offsets.middle[1] = __builtin_convertvector(scaled + 0.5, IntLanes) - 1;
  offsets.from[0] = __builtin_convertvector(offsets.middle[0], Lanes) + 0.5 - scaled;
  offsets.from[1] = __builtin_convertvector(offsets.middle[1], Lanes) + 1.0 - scaled;
  return offsets;
}

// With the offset d of the nearest node in spacings, the weights relative to that node's are a = edge t and c = edge /
// t, t = exp(2 d / (1.5 alpha)^2); the nearest face is half a spacing from the nearest centre, so that one exponential
// serves both. Their sum and spread, multiplied by t, share one division.
void MlsShape::uniform(int direction, const UniformOffsets& offsets, Lanes center_t, StencilBatch& stencils,
                       SlopeBatch& slopes) const {
  const auto& dir = directions_[direction];
  const double edge = edge_, inverse_edge = 1 / edge_, inverse_spacing = dir.inverse_spacing;
  const Lanes nearer = inverse_edge + Lanes{}, farther = edge + Lanes{};
  const Lanes face_t = center_t * (offsets.from[1] > offsets.from[0] ? nearer : farther);
  IntLanes shift[2];
  for (int kind = 0; kind < 2; ++kind) {
    const auto line = static_cast<StencilLine>(2 * direction + kind);
    const Lanes t = kind == 0 ? center_t : face_t;
    const Lanes a_t = edge * t * t;
    const double c_t = edge;
    const Lanes sum_t = a_t + t + c_t, square_t = 2 * edge * edge * t, spread_t = a_t + c_t + 2 * square_t;
    const Lanes inverse = 1 / (sum_t * spread_t), by_sum = spread_t * inverse, by_spread = sum_t * inverse;
    const Lanes wa = a_t * by_sum, wb = t * by_sum, wc = c_t * by_sum;
    const Lanes sa = -(a_t + square_t) * by_spread, sb = (a_t - c_t) * by_spread, sc = (c_t + square_t) * by_spread;
    const Lanes moment = offsets.from[kind] + (wc - wa);
    auto& weight = stencils.weight[line];
    auto& value = stencils.value[line];
    auto& slope = slopes.slope[line];
    store(wa, weight[0]), store(wb, weight[1]), store(wc, weight[2]);
    store(wa - moment * sa, value[0]), store(wb - moment * sb, value[1]), store(wc - moment * sc, value[2]);
    store(sa * inverse_spacing, slope[0]), store(sb * inverse_spacing, slope[1]), store(sc * inverse_spacing, slope[2]);

    const IntLanes middle = offsets.middle[kind];
    IntLanes first = middle - 1;
    if (dir.periodic) first = middle < 0 ? first + dir.cells : first;
    shift[kind] = -first;
    if (!dir.periodic) {
      const int lowest = lowest_node(line), highest = highest_node(line);
      first = first < lowest ? lowest + IntLanes{} : first > highest ? highest + IntLanes{} : first;
    }
    shift[kind] += first;
    store(first, stencils.first[line]);
  }
  if (any(shift[0] | shift[1])) make_shifted(direction, offsets, shift, stencils, slopes);
}

// Beside bounded sides, where the three nodes are not those around the nearest one.
void MlsShape::make_shifted(int direction, const UniformOffsets& offsets, const IntLanes (&shift)[2],
                            StencilBatch& stencils, SlopeBatch& slopes) const {
  for (int kind = 0; kind < 2; ++kind) {
    const auto line = static_cast<StencilLine>(2 * direction + kind);
    alignas(64) StencilNumbers shifted, weight, value, slope;
    const Lanes lowest = offsets.from[kind] + __builtin_convertvector(shift[kind], Lanes);
    for (int i = 0; i < 3; ++i) store((lowest + (i - 1.0)) * directions_[direction].spacing, shifted[i]);
    mls_stencils(shifted, alpha_, weight, value, slope);
    for (int l = 0; l < mls_batch; ++l) {
      if (shift[kind][l] == 0) continue;
      for (int i = 0; i < 3; ++i) {
        stencils.weight[line][i][l] = weight[i][l];
        stencils.value[line][i][l] = value[i][l];
        slopes.slope[line][i][l] = slope[i][l];
      }
    }
  }
}

void MlsShape::stretched(const double* z, StencilBatch& stencils, SlopeBatch& slopes) const {
  for (const StencilLine line : {z_center, z_face}) {
    const auto nodes = line == z_face ? grid_.global_z_face() : grid_.global_z_center();
    alignas(64) StencilNumbers offsets;
    for (int l = 0; l < mls_batch; ++l) {
      const Middle middle = stretched_middle(line, z[l]);
      const int first = first_node(line, middle.node);
      stencils.first[line][l] = first;
      for (int i = 0; i < 3; ++i) offsets[i][l] = nodes[first + i] - (z[l] + middle.shift);
    }
    mls_stencils(offsets, alpha_, stencils.weight[line], stencils.value[line], slopes.slope[line]);
  }
}

}  // namespace pliant
