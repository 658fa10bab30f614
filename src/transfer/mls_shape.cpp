#include "transfer/mls_shape.hpp"

#include <algorithm>
#include <cmath>

#include "transfer/exponentials.hpp"

namespace pliant {
namespace {

using Lanes = double[mls_batch];

bool is_uniform(PlaneValues dz, int n, double spacing) {
  for (int k = 0; k < n; ++k)
    if (std::abs(dz[k] - spacing) > 1e-10 * spacing) return false;
  return true;
}

constexpr int buckets_per_cell = 4;

}  // namespace

void mls_stencils(const StencilNumbers& offsets, double alpha, StencilNumbers& weight, StencilNumbers& value,
                  StencilNumbers& slope) {
  alignas(64) Lanes low, high;
  for (int l = 0; l < mls_batch; ++l) {
    const double a = offsets[0][l], b = offsets[1][l], c = offsets[2][l];
    const double reach = alpha * std::max(0.75 * (c - a), std::max(std::abs(a), std::abs(c)));
    const double scale = 1 / (reach * reach);
    low[l] = (b - a) * (b + a) * scale;
    high[l] = (b - c) * (b + c) * scale;
  }
  exponentials(low);  // weights relative to the middle node's
  exponentials(high);
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
    : grid_(grid), alpha_(alpha), edge_(std::exp(-1 / (2.25 * alpha * alpha))) {
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
  const auto& d = directions_[line / 2];
  if (d.periodic) return middle - 1;
  const int lowest = line % 2 == 1 || d.cells < 3 ? -1 : 0;
  return std::clamp(middle - 1, lowest, std::max(lowest, d.cells - 3));
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
  alignas(64) Lanes x[3];
  for (int l = 0; l < mls_batch; ++l) {
    const Vec3& point = points[static_cast<std::size_t>(l) < points.size() ? static_cast<std::size_t>(l) : 0];
    x[0][l] = point.x, x[1][l] = point.y, x[2][l] = point.z;
  }
  uniform(0, x[0], stencils, slopes);
  uniform(1, x[1], stencils, slopes);
  if (stretched_z_) stretched(x[2], stencils, slopes);
  else uniform(2, x[2], stencils, slopes);
  const int begin = grid_.slab().begin;
  for (int l = 0; l < mls_batch; ++l) stencils.first[z_center][l] -= begin, stencils.first[z_face][l] -= begin;
}

// With the offset d of the nearest node in spacings, the weights relative to that node's are edge * t and edge / t,
// t = exp(2 d / (1.5 alpha)^2); the nearest face is half a spacing from the nearest centre, so that one exponential
// serves both.
void MlsShape::uniform(int direction, const double* x, StencilBatch& stencils, SlopeBatch& slopes) const {
  const auto& dir = directions_[direction];
  const auto center = static_cast<StencilLine>(2 * direction), face = static_cast<StencilLine>(2 * direction + 1);
  const double factor = 2 / (2.25 * alpha_ * alpha_), edge = edge_, inverse_edge = 1 / edge_;
  const double origin = dir.origin, inverse_spacing = dir.inverse_spacing;
  const int n = dir.cells;
  alignas(64) Lanes offsets[2], t[2];
  alignas(64) int middle[2][mls_batch];
  for (int l = 0; l < mls_batch; ++l) {
    const double scaled = (x[l] - origin) * inverse_spacing;
    middle[0][l] = std::min(static_cast<int>(scaled), n - 1);
    middle[1][l] = static_cast<int>(scaled + 0.5) - 1;
    offsets[0][l] = middle[0][l] + 0.5 - scaled;
    offsets[1][l] = middle[1][l] + 1 - scaled;
    t[0][l] = factor * offsets[0][l];
  }
  exponentials(t[0]);
  for (int l = 0; l < mls_batch; ++l) t[1][l] = t[0][l] * (offsets[1][l] > offsets[0][l] ? inverse_edge : edge);

  bool any_shifted = false;
  alignas(64) StencilNumbers shifted[2];
  bool is_shifted[2][mls_batch];
  for (int kind = 0; kind < 2; ++kind) {
    const StencilLine line = kind == 0 ? center : face;
    auto& weight = stencils.weight[line];
    auto& value = stencils.value[line];
    auto& slope = slopes.slope[line];
    for (int l = 0; l < mls_batch; ++l) {
      const double offset = offsets[kind][l], a = edge * t[kind][l], c = edge / t[kind][l];
      const double inverse = 1 / (1 + a + c), inverse_spread = 1 / (a + c + 4 * edge * edge);
      const double moment = offset + (c - a) * inverse;
      const double sa = -a * (1 + 2 * c) * inverse_spread, sb = (a - c) * inverse_spread;
      const double sc = c * (1 + 2 * a) * inverse_spread;
      const double wa = a * inverse, wc = c * inverse;
      weight[0][l] = wa, weight[1][l] = inverse, weight[2][l] = wc;
      value[0][l] = wa - moment * sa, value[1][l] = inverse - moment * sb, value[2][l] = wc - moment * sc;
      slope[0][l] = sa * inverse_spacing, slope[1][l] = sb * inverse_spacing, slope[2][l] = sc * inverse_spacing;
    }
    for (int l = 0; l < mls_batch; ++l) {
      const int node = middle[kind][l] < 0 && dir.periodic ? middle[kind][l] + n : middle[kind][l];
      const int first = first_node(line, node);
      const int shift = first + 1 - node;
      stencils.first[line][l] = first;
      is_shifted[kind][l] = shift != 0;
      any_shifted = any_shifted || shift != 0;
      for (int i = 0; i < 3; ++i) shifted[kind][i][l] = (offsets[kind][l] + shift + i - 1) * dir.spacing;
    }
  }
  if (!any_shifted) return;
  for (int kind = 0; kind < 2; ++kind) {
    const StencilLine line = kind == 0 ? center : face;
    alignas(64) StencilNumbers weight, value, slope;
    mls_stencils(shifted[kind], alpha_, weight, value, slope);
    for (int l = 0; l < mls_batch; ++l) {
      if (!is_shifted[kind][l]) continue;
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
