#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "transfer/mls_shape.hpp"

namespace pliant {

/// A vector at every marker of a rank, one array a component, in the markers' working order and padded to whole
/// batches.
struct MarkerVectors {
  std::array<std::vector<double>, 3> components;
  std::vector<double>& operator[](int c) { return components[static_cast<std::size_t>(c)]; }
  const std::vector<double>& operator[](int c) const { return components[static_cast<std::size_t>(c)]; }
  /// Makes it as long as that, and zero.
  void assign(std::size_t padded_size) {
    for (auto& c : components) c.assign(padded_size, 0.0);
  }
};

/// The stencils of some markers that follow each other, to be used while they are in cache: making them anew is cheaper
/// than reading them back from memory.
struct StencilBlock {
  static constexpr int most = 4;  ///< batches
  int first_batch = 0, n_batches = 0;
  std::array<StencilBatch, most> stencils;
};

/// Throws InputError if a bounded direction has fewer than three cells.
void require_room_for_markers(const Grid& grid);

/// The markers at or near this rank's slab with their stencils: points at which bodies and flow feel each other.
///
/// Markers stand in working order: by blocks of 4 x 4 x 4 cells, within a block in the caller's order, so that
/// neighbours are near each other in memory; the order depends on positions and slab alone. A rank works on the u and v
/// parts of a marker whose middle plane of cell centres it holds, and on the w part if it holds the middle plane of
/// faces: every part has exactly one rank, and its nodes are that rank's or its ghosts. On all other ranks a part
/// weighs nothing.
class Markers {
 public:
  /// Requires room for markers (require_room_for_markers).
  explicit Markers(const Grid& grid, double alpha = default_mls_alpha);

  /// Takes new markers: positions and areas of all that may touch this rank (others are left out). Points are brought
  /// back into the box along periodic directions. Throws RunError that names the first marker outside the box.
  void place(std::span<const Vec3> positions, std::span<const double> areas);

  int size() const { return static_cast<int>(indices_.size()); }
  int n_batches() const { return (size() + mls_batch - 1) / mls_batch; }
  std::size_t padded_size() const { return static_cast<std::size_t>(n_batches()) * mls_batch; }
  /// Markers of a batch.
  int count(int batch) const { return std::min(mls_batch, size() - batch * mls_batch); }
  /// The caller's index of every marker, in working order.
  std::span<const int> indices() const { return indices_; }

  /// By component, in working order: 1 where this rank works on that part of the marker, 0 elsewhere.
  std::span<const double> share(int component) const { return parts_[component == 2].share; }
  /// A h: the fluid's volume that a marker speaks for, h the mean spacing around it; 0 where the share is.
  std::span<const double> volume(int component) const { return parts_[component == 2].volume; }
  /// c = A h / sum_k phi_k dV_k, which makes the spread force whole; 0 where the share is.
  std::span<const double> spreading(int component) const { return parts_[component == 2].spreading; }

  /// d h of markers with unit normals n, by the caller's index, in working order; 0 where n is the zero vector. h: mean
  /// spacing; d: how thick the layer is through which a sheet acts, sum_ij phi_i phi_j |n.(x_i - x_j)|, as the mean of
  /// the components along the sheet. Does not depend on the rank.
  std::vector<double> layers(std::span<const Vec3> normals) const;
  /// The lowest and highest nodes of all stencils of a marker, in working order.
  struct Reach {
    std::array<int, 3> lowest, highest;
  };
  std::span<const Reach> reaches() const { return reaches_; }
  /// The lowest plane of all stencils from this batch on; beyond the slab if there are none.
  int lowest_plane_from(int batch) const { return lowest_planes_[static_cast<std::size_t>(batch)]; }

  /// visit(block) for blocks of stencils that cover all markers, in working order.
  template <class Visit>
  void for_each_block(Visit visit) const {
    for_each_block(visit, [](const StencilBlock&) {});
  }
  /// The same with expect(block) one block ahead of visit(block): what it begins to load is there when it is needed.
  template <class Visit, class Expect>
  void for_each_block(Visit visit, Expect expect) const {
    StencilBlock blocks[2];
    int now = 0;
    const auto prepare = [&](int first_batch, StencilBlock& block) {
      if (first_batch >= n_batches()) return;
      evaluate(first_batch, block);
      expect(std::as_const(block));
    };
    prepare(0, blocks[now]);
    for (int begin = 0; begin < n_batches(); begin += StencilBlock::most) {
      prepare(begin + StencilBlock::most, blocks[1 - now]);
      visit(std::as_const(blocks[now]));
      now = 1 - now;
    }
  }

  const Grid& grid() const { return shape_.grid(); }

 private:
  struct Part {
    std::vector<double> share, volume, spreading;
  };
  int block_of(Vec3 position) const;
  void sort_by_blocks();
  void evaluate(int first_batch, StencilBlock& block) const;
  void make_stencils(int batch, StencilBatch& stencils) const;
  void leave_to_others(StencilLine line, std::size_t lane, StencilBatch& stencils) const;
  static Reach reach_of(const StencilBatch& stencils, std::size_t lane);
  void weigh(StencilLine line, const StencilBatch& stencils, std::size_t marker, double area);

  MlsShape shape_;
  std::array<int, 3> blocks_{};
  std::vector<Vec3> positions_, sorted_positions_;
  std::vector<int> indices_, sorted_indices_, block_of_marker_, block_begin_;
  Part parts_[2];  // u and v, w
  std::vector<Reach> reaches_;
  std::vector<int> lowest_planes_;
};

}  // namespace pliant
