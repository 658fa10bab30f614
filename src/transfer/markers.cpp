#include "transfer/markers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace pliant {
namespace {

constexpr int block = 4;  // cells along its edges

}  // namespace

Markers::Markers(const Grid& grid, double alpha) : shape_(grid, alpha) {
  std::vector<std::string> problems;
  for (int d = 0; d < 3; ++d) {
    const int n = grid.cells()[static_cast<std::size_t>(d)];
    if (!grid.is_periodic(d) && n < 3)
      problems.push_back(
          fmt::format("box.cells: {} cells along {} between bounded sides are too few for markers: use at "
                      "least 3, or periodic sides",
                      n, "xyz"[d]));
    blocks_[static_cast<std::size_t>(d)] = ((d == 2 ? grid.nz() : n) + block - 1) / block;
  }
  if (!problems.empty()) throw InputError(problems);
}

void Markers::place(std::span<const Vec3> positions, std::span<const double> areas) {
  positions_.clear();
  indices_.clear();
  for (std::size_t n = 0; n < positions.size(); ++n) {
    Vec3 x = positions[n];
    if (!shape_.bring_into_box(x))
      throw RunError(fmt::format("marker {} at ({}, {}, {}) is outside the box", n, positions[n].x, positions[n].y,
                                 positions[n].z));
    if (!shape_.is_near(x.z)) continue;
    positions_.push_back(x);
    indices_.push_back(static_cast<int>(n));
  }
  sort_by_blocks();

  const std::size_t batches = (positions_.size() + mls_batch - 1) / mls_batch;
  stencils_.resize(batches);
  for (auto& part : parts_)
    for (auto* numbers : {&part.share, &part.volume, &part.spreading}) numbers->assign(batches * mls_batch, 0.0);
  for (std::size_t b = 0; b < batches; ++b) finish_batch(b, areas);
}

int Markers::block_of(Vec3 x) const {
  const auto& grid = shape_.grid();
  const auto at = [](double scaled, int n) { return std::clamp(static_cast<int>(scaled) / block, 0, n - 1); };
  const double bottom = grid.z_face()[-1], top = grid.z_face()[grid.nz() - 1];
  const int i = at((x.x - grid.origin().x) / grid.dx(), blocks_[0]);
  const int j = at((x.y - grid.origin().y) / grid.dy(), blocks_[1]);
  const int k = at((x.z - bottom) / (top - bottom) * grid.nz(), blocks_[2]);
  return i + blocks_[0] * (j + blocks_[1] * k);
}

// Counting sort: stable, so that the caller's order decides within a block.
void Markers::sort_by_blocks() {
  const std::size_t n = positions_.size();
  block_of_marker_.resize(n);
  block_begin_.assign(static_cast<std::size_t>(blocks_[0]) * static_cast<std::size_t>(blocks_[1]) *
                              static_cast<std::size_t>(blocks_[2]) +
                          1,
                      0);
  for (std::size_t m = 0; m < n; ++m) {
    block_of_marker_[m] = block_of(positions_[m]);
    ++block_begin_[static_cast<std::size_t>(block_of_marker_[m]) + 1];
  }
  for (std::size_t b = 1; b < block_begin_.size(); ++b) block_begin_[b] += block_begin_[b - 1];
  sorted_positions_.resize(n);
  sorted_indices_.resize(n);
  for (std::size_t m = 0; m < n; ++m) {
    const auto to = static_cast<std::size_t>(block_begin_[static_cast<std::size_t>(block_of_marker_[m])]++);
    sorted_positions_[to] = positions_[m];
    sorted_indices_[to] = indices_[m];
  }
  positions_.swap(sorted_positions_);
  indices_.swap(sorted_indices_);
}

void Markers::finish_batch(std::size_t batch, std::span<const double> areas) {
  const int n = count(static_cast<int>(batch));
  const std::size_t begin = batch * mls_batch;
  SlopeBatch slopes;
  shape_.evaluate(std::span(positions_).subspan(begin, static_cast<std::size_t>(n)), stencils_[batch], slopes);
  for (int l = 0; l < mls_batch; ++l) {
    const double area = l < n ? areas[static_cast<std::size_t>(indices_[begin + static_cast<std::size_t>(l)])] : 0.0;
    for (const StencilLine line : {z_center, z_face}) finish_lane(line, batch, l, l < n ? area : -1);
  }
}

// What this rank does with one part of a marker; area -1: there is no marker.
void Markers::finish_lane(StencilLine line, std::size_t batch, int l, double area) {
  auto& s = stencils_[batch];
  const auto& grid = shape_.grid();
  if (area < 0 || !shape_.is_held(s, line, l)) {
    // Adds and finds nothing, at a place that is surely there.
    for (int c = 0; c < 3; ++c) s.weight[line][c][l] = s.value[line][c][l] = 0;
    s.first[line][l] = std::clamp(s.first[line][l], -1, grid.nz() - 2);
    return;
  }
  const auto dz = line == z_face ? grid.dz_f() : grid.dz_c();
  // The other directions are uniform and their values sum to 1: sum phi dz needs one line only.
  double spacing = 0;
  for (int c = 0; c < 3; ++c) spacing += s.value[line][c][l] * dz[s.first[line][l] + c];
  const std::size_t m = batch * mls_batch + static_cast<std::size_t>(l);
  auto& part = parts_[line == z_face];
  part.share[m] = 1;
  part.volume[m] = area * (grid.dx() + grid.dy() + spacing) / 3;
  part.spreading[m] = part.volume[m] / (grid.dx() * grid.dy() * spacing);
}

}  // namespace pliant
