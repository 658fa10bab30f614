#pragma once
#include <functional>
#include <span>
#include <vector>

#include "parallel/sparse_exchange.hpp"
#include "transfer/mls_shape.hpp"

namespace pliant {

/// Brings the points of this rank's bodies to the ranks whose slabs they lie in or near, and numbers that belong to
/// them there and back. Only ranks that share a point exchange anything.
class PointRouter {
 public:
  explicit PointRouter(const Grid& grid);

  /// Takes this rank's points, all in the box; along periodic directions they are brought back into it. `reach`: how
  /// far beyond the nodes of their stencils they are to be known along z. Collective. Throws nothing: use
  /// `first_outside` before.
  void route(std::span<const Vec3> points, double reach = 0);

  /// The index of the first point that is outside a bounded side or no number; points.size() if there is none.
  std::size_t first_outside(std::span<const Vec3> points) const;

  std::size_t n_own() const { return n_own_; }
  /// The points that have come to this rank, its own among them: by the rank they belong to, then in that one's order.
  std::span<const Vec3> held() const { return held_; }

  /// `width` numbers of each own point to all that hold it. Collective.
  void send(std::span<const double> own, int width, std::vector<double>& held) const;
  void send(std::span<const Vec3> own, std::vector<Vec3>& held) const;
  void send(std::span<const double> own, std::vector<double>& held) const { send(own, 1, held); }
  /// The way back: for each own point the sum of what its holders say, added in the order of the ranks. Collective.
  void collect(std::span<const double> held, int width, std::span<double> own) const;
  void collect(std::span<const Vec3> held, std::span<Vec3> own) const;

 private:
  // Then nothing has to travel, and all points are held in their own order.
  bool is_alone() const { return shape_.grid().ranks().size() == 1; }
  void add_holders(double z, double reach, std::vector<int>& holders) const;

  MlsShape shape_;
  SparseExchange exchange_;
  std::size_t n_own_ = 0;
  std::vector<std::size_t> sent_index_;  // own index of every sent item, by destination
  std::vector<Vec3> wrapped_, held_;
};

}  // namespace pliant
