#pragma once
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "config/case_config.hpp"
#include "parallel/communicator.hpp"
#include "parallel/slabs.hpp"

namespace pliant {

/// Values at the global planes k = -1 .. n of a direction; plain pointer semantics for kernels.
class PlaneValues {
 public:
  PlaneValues() = default;
  explicit PlaneValues(const double* origin) : origin_(origin) {}
  double operator[](int k) const { return origin_[k]; }

 private:
  const double* origin_ = nullptr;
};

/// The staggered Cartesian grid as one rank sees it: an immutable value, cheap to copy.
///
/// x and y are uniform and whole on every rank; z is uniform or stretched and cut into slabs. Local indices run
/// i = 0..nx-1, j = 0..ny-1, k = 0..nz-1 with one layer of ghosts around. Face i lies between cells i and i + 1, so
/// face -1 and face n - 1 are the sides of a bounded direction.
class Grid {
 public:
  /// Throws InputError if there are more ranks than planes in z.
  Grid(const BoxConfig& box, const BoundaryConfig& boundary, const Communicator& ranks);

  int nx() const { return cells_[0]; }
  int ny() const { return cells_[1]; }
  int nz() const { return slab_.count; }                      ///< planes of this rank
  const std::array<int, 3>& cells() const { return cells_; }  ///< of the whole box
  Slab slab() const { return slab_; }
  bool is_periodic(int direction) const { return periodic_[static_cast<std::size_t>(direction)]; }
  /// True if this rank touches the lower / upper side of a bounded z.
  bool has_bottom() const { return !periodic_[2] && slab_.begin == 0; }
  bool has_top() const { return !periodic_[2] && slab_.begin + slab_.count == cells_[2]; }

  Vec3 origin() const { return origin_; }
  Vec3 size() const { return size_; }
  double volume() const { return size_.x * size_.y * size_.z; }
  double dx() const { return dx_; }
  double dy() const { return dy_; }
  double x_center(int i) const { return origin_.x + (i + 0.5) * dx_; }
  double x_face(int i) const { return origin_.x + (i + 1) * dx_; }
  double y_center(int j) const { return origin_.y + (j + 0.5) * dy_; }
  double y_face(int j) const { return origin_.y + (j + 1) * dy_; }

  /// By local plane k = -1..nz: centre and upper face, thickness of cell k, distance from centre k to centre k + 1.
  PlaneValues z_center() const { return PlaneValues(metrics_->z_c.data() + 1 + slab_.begin); }
  PlaneValues z_face() const { return PlaneValues(metrics_->z_f.data() + 1 + slab_.begin); }
  PlaneValues dz_c() const { return PlaneValues(metrics_->dz_c.data() + 1 + slab_.begin); }
  PlaneValues dz_f() const { return PlaneValues(metrics_->dz_f.data() + 1 + slab_.begin); }
  /// The same for the whole box, by global plane k = -1..cells()[2].
  PlaneValues global_z_center() const { return PlaneValues(metrics_->z_c.data() + 1); }
  PlaneValues global_z_face() const { return PlaneValues(metrics_->z_f.data() + 1); }
  PlaneValues global_dz_c() const { return PlaneValues(metrics_->dz_c.data() + 1); }
  PlaneValues global_dz_f() const { return PlaneValues(metrics_->dz_f.data() + 1); }
  double smallest_dz() const;
  double smallest_spacing() const;
  /// Of the three directions, z with its mean.
  double mean_spacing() const { return (dx_ + dy_ + size_.z / cells_[2]) / 3; }

  /// How many cells a velocity crosses in a unit of time, at most: |u|/dx + |v|/dy + |w|/dz of the thinnest cell.
  double convective_rate(Vec3 velocity) const;

  /// Global index of the cell that holds height z; clamped to the box.
  int plane_of_height(double z) const;

  const Communicator& ranks() const { return ranks_; }

 private:
  struct Metrics {
    std::vector<double> z_c, z_f, dz_c, dz_f;  // index 0 is plane -1
  };

  std::array<int, 3> cells_{};
  std::array<bool, 3> periodic_{};
  Vec3 origin_, size_;
  double dx_ = 0, dy_ = 0;
  Slab slab_;
  Communicator ranks_;
  std::shared_ptr<const Metrics> metrics_;
};

}  // namespace pliant
