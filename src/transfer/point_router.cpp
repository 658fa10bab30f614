#include "transfer/point_router.hpp"

#include <algorithm>

namespace pliant {
namespace {

// Vectors travel as their three numbers.
static_assert(sizeof(Vec3) == 3 * sizeof(double));
std::span<const double> numbers(std::span<const Vec3> v) {
  return {reinterpret_cast<const double*>(v.data()), 3 * v.size()};
}
std::span<double> numbers(std::span<Vec3> v) { return {reinterpret_cast<double*>(v.data()), 3 * v.size()}; }

}  // namespace

PointRouter::PointRouter(const Grid& grid) : shape_(grid), exchange_(grid.ranks()) {}

std::size_t PointRouter::first_outside(std::span<const Vec3> points) const {
  for (std::size_t n = 0; n < points.size(); ++n) {
    Vec3 x = points[n];
    if (!shape_.bring_into_box(x)) return n;
  }
  return points.size();
}

// A plane to spare on either side, as MlsShape::is_near has it.
void PointRouter::add_holders(double z, double reach, std::vector<int>& holders) const {
  const Grid& grid = shape_.grid();
  const int n = grid.cells()[2], ranks = grid.ranks().size();
  const auto planes = shape_.middle_planes(z);
  int first = std::min(planes[0], planes[1]) - 1, last = std::max(planes[0], planes[1]) + 1;
  if (reach > 0) {
    const double lower = grid.origin().z, upper = lower + grid.size().z;
    const auto plane = [&](double height) {
      if (!grid.is_periodic(2)) return grid.plane_of_height(std::clamp(height, lower, upper));
      if (height < lower) return grid.plane_of_height(height + grid.size().z) - n;
      if (height > upper) return grid.plane_of_height(height - grid.size().z) + n;
      return grid.plane_of_height(height);
    };
    first = std::min(first, plane(z - reach));
    last = std::max(last, plane(z + reach));
  }
  if (!grid.is_periodic(2)) first = std::max(first, 0), last = std::min(last, n - 1);
  last = std::min(last, first + n - 1);
  for (int plane = first; plane <= last; ++plane) {
    const int rank = rank_of_plane(n, ranks, ((plane % n) + n) % n);
    if (std::find(holders.begin(), holders.end(), rank) == holders.end()) holders.push_back(rank);
  }
}

void PointRouter::route(std::span<const Vec3> points, double reach) {
  n_own_ = points.size();
  wrapped_.assign(points.begin(), points.end());
  for (Vec3& x : wrapped_) shape_.bring_into_box(x);
  if (is_alone()) {
    held_.swap(wrapped_);
    return;
  }

  std::vector<std::vector<std::size_t>> to_rank(static_cast<std::size_t>(shape_.grid().ranks().size()));
  std::vector<int> holders;
  for (std::size_t n = 0; n < n_own_; ++n) {
    holders.clear();
    add_holders(wrapped_[n].z, reach, holders);
    for (int r : holders) to_rank[static_cast<std::size_t>(r)].push_back(n);
  }
  sent_index_.clear();
  std::vector<int> counts;
  for (const auto& list : to_rank) {
    counts.push_back(static_cast<int>(list.size()));
    sent_index_.insert(sent_index_.end(), list.begin(), list.end());
  }
  exchange_.plan(counts);
  send(wrapped_, held_);
}

void PointRouter::send(std::span<const double> own, int width, std::vector<double>& held) const {
  if (is_alone()) {
    held.assign(own.begin(), own.end());
    return;
  }
  const auto w = static_cast<std::size_t>(width);
  std::vector<double> sent(sent_index_.size() * w);
  for (std::size_t s = 0; s < sent_index_.size(); ++s)
    for (std::size_t c = 0; c < w; ++c) sent[s * w + c] = own[sent_index_[s] * w + c];
  exchange_.forward(sent, width, held);
}

void PointRouter::send(std::span<const Vec3> own, std::vector<Vec3>& held) const {
  if (is_alone()) {
    held.assign(own.begin(), own.end());
    return;
  }
  std::vector<double> flat;
  send(numbers(own), 3, flat);
  held.resize(flat.size() / 3);
  std::copy(flat.begin(), flat.end(), numbers(std::span(held)).begin());
}

void PointRouter::collect(std::span<const double> held, int width, std::span<double> own) const {
  if (is_alone()) {
    std::copy(held.begin(), held.end(), own.begin());
    return;
  }
  const auto w = static_cast<std::size_t>(width);
  std::vector<double> returned;
  exchange_.backward(held, width, returned);
  std::fill(own.begin(), own.end(), 0.0);
  for (std::size_t s = 0; s < sent_index_.size(); ++s)
    for (std::size_t c = 0; c < w; ++c) own[sent_index_[s] * w + c] += returned[s * w + c];
}

void PointRouter::collect(std::span<const Vec3> held, std::span<Vec3> own) const {
  collect(numbers(held), 3, numbers(own));
}

}  // namespace pliant
