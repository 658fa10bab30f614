#include "transfer/markers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace pliant {
namespace {

constexpr int block = 4;  // cells along its edges

/// How likely two nodes drawn with the values of a stencil as probabilities are to be neighbours in one order; that
/// they are two spacings apart is below 1e-3 and left out. Stencils shifted away from a side have no probabilities.
double chance_of_neighbours(const StencilNumbers& value, int lane) {
  return std::clamp(value[0][lane] * value[1][lane] + value[1][lane] * value[2][lane], 0.0, 0.25);
}

/// Mean |sum_c steps_c| where each step is taken forwards or backwards, or not at all.
double mean_distance(const std::array<double, 3>& steps, const std::array<double, 3>& chances) {
  double sum = 0;
  for (int a = -1; a <= 1; ++a)
    for (int b = -1; b <= 1; ++b)
      for (int c = -1; c <= 1; ++c) {
        const auto chance = [&](int taken, std::size_t d) { return taken == 0 ? 1 - 2 * chances[d] : chances[d]; };
        sum += chance(a, 0) * chance(b, 1) * chance(c, 2) * std::abs(a * steps[0] + b * steps[1] + c * steps[2]);
      }
  return sum;
}

}  // namespace

void require_room_for_markers(const Grid& grid) {
  std::vector<std::string> problems;
  for (int d = 0; d < 3; ++d) {
    const int n = grid.cells()[static_cast<std::size_t>(d)];
    if (!grid.is_periodic(d) && n < 3)
      problems.push_back(
          fmt::format("box.cells: {} cells along {} between bounded sides are too few for markers: use at "
                      "least 3, or periodic sides",
                      n, "xyz"[d]));
  }
  if (!problems.empty()) throw InputError(problems);
}

Markers::Markers(const Grid& grid, double alpha) : shape_(grid, alpha) {
  require_room_for_markers(grid);
  const int cells[3] = {grid.nx(), grid.ny(), grid.nz()};
  for (std::size_t d = 0; d < 3; ++d) blocks_[d] = (cells[d] + block - 1) / block;
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

  for (auto& part : parts_)
    for (auto* numbers : {&part.share, &part.volume, &part.spreading}) numbers->assign(padded_size(), 0.0);
  reaches_.resize(static_cast<std::size_t>(size()));
  StencilBatch stencils;
  lowest_planes_.assign(static_cast<std::size_t>(n_batches()) + 1, grid().nz() + 1);
  for (int b = 0; b < n_batches(); ++b) {
    make_stencils(b, stencils);
    int& lowest = lowest_planes_[static_cast<std::size_t>(b)];
    for (int l = 0; l < count(b); ++l) {
      lowest = std::min({lowest, stencils.first[z_center][l], stencils.first[z_face][l]});
      const std::size_t m = static_cast<std::size_t>(b) * mls_batch + static_cast<std::size_t>(l);
      for (const StencilLine line : {z_center, z_face})
        if (shape_.is_held(stencils, line, l)) weigh(line, stencils, m, areas[static_cast<std::size_t>(indices_[m])]);
        else leave_to_others(line, static_cast<std::size_t>(l), stencils);
      reaches_[m] = reach_of(stencils, static_cast<std::size_t>(l));
    }
  }
  for (std::size_t b = lowest_planes_.size() - 1; b > 0; --b)
    lowest_planes_[b - 1] = std::min(lowest_planes_[b - 1], lowest_planes_[b]);
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

std::vector<double> Markers::layers(std::span<const Vec3> normals) const {
  constexpr std::array<std::array<StencilLine, 3>, 3> lines{
      {{x_face, y_center, z_center}, {x_center, y_face, z_center}, {x_center, y_center, z_face}}};
  std::vector<double> layers(static_cast<std::size_t>(size()), 0.0);
  StencilBatch stencils;
  for (int b = 0; b < n_batches(); ++b) {
    make_stencils(b, stencils);
    for (int l = 0; l < count(b); ++l) {
      const std::size_t m = static_cast<std::size_t>(b) * mls_batch + static_cast<std::size_t>(l);
      const Vec3 normal = normals[static_cast<std::size_t>(indices_[m])];
      if (dot(normal, normal) == 0) continue;
      const double dz = grid().global_dz_c()[grid().plane_of_height(positions_[m].z)];
      const std::array<double, 3> steps{normal.x * grid().dx(), normal.y * grid().dy(), normal.z * dz};
      for (int c = 0; c < 3; ++c) {
        std::array<double, 3> chances{};
        for (std::size_t d = 0; d < 3; ++d)
          chances[d] = chance_of_neighbours(stencils.value[lines[static_cast<std::size_t>(c)][d]], l);
        layers[m] += 0.5 * (1 - normal[c] * normal[c]) * mean_distance(steps, chances);
      }
      layers[m] *= (grid().dx() + grid().dy() + dz) / 3;
    }
  }
  return layers;
}

void Markers::make_stencils(int batch, StencilBatch& stencils) const {
  SlopeBatch slopes;
  shape_.evaluate(std::span(positions_)
                      .subspan(static_cast<std::size_t>(batch) * mls_batch, static_cast<std::size_t>(count(batch))),
                  stencils, slopes);
}

void Markers::evaluate(int first_batch, StencilBlock& block) const {
  block.first_batch = first_batch;
  block.n_batches = std::min(StencilBlock::most, n_batches() - first_batch);
  for (int b = 0; b < block.n_batches; ++b) {
    auto& stencils = block.stencils[static_cast<std::size_t>(b)];
    make_stencils(first_batch + b, stencils);
    const std::size_t begin = static_cast<std::size_t>(first_batch + b) * mls_batch;
    for (std::size_t l = 0; l < mls_batch; ++l) {
      if (parts_[0].share[begin + l] == 0) leave_to_others(z_center, l, stencils);
      if (parts_[1].share[begin + l] == 0) leave_to_others(z_face, l, stencils);
    }
  }
}

// Adds and finds nothing, at a place that is surely there.
void Markers::leave_to_others(StencilLine line, std::size_t lane, StencilBatch& s) const {
  for (int c = 0; c < 3; ++c) s.weight[line][c][lane] = s.value[line][c][lane] = 0;
  s.first[line][lane] = std::clamp(s.first[line][lane], -1, grid().nz() - 2);
}

Markers::Reach Markers::reach_of(const StencilBatch& s, std::size_t lane) {
  Reach reach{};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto [first, last] = std::minmax(s.first[2 * d][lane], s.first[2 * d + 1][lane]);
    reach.lowest[d] = first;
    reach.highest[d] = last + 2;
  }
  return reach;
}

// The directions x and y are uniform and their values sum to 1, so that sum phi dz needs the line along z only.
void Markers::weigh(StencilLine line, const StencilBatch& s, std::size_t marker, double area) {
  const std::size_t lane = marker % mls_batch;
  const auto dz = line == z_face ? grid().dz_f() : grid().dz_c();
  double spacing = 0;
  for (int c = 0; c < 3; ++c) spacing += s.value[line][c][lane] * dz[s.first[line][lane] + c];
  auto& part = parts_[line == z_face];
  part.share[marker] = 1;
  part.volume[marker] = area * (grid().dx() + grid().dy() + spacing) / 3;
  part.spreading[marker] = part.volume[marker] / (grid().dx() * grid().dy() * spacing);
}

}  // namespace pliant
