#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/lanes.hpp"

/// Vectors of eight vertices, edges or faces at once. Where they are fetched from or sent to in any order, they stand
/// in memory as records of four numbers: a vector and one number more.
namespace pliant {

using Record [[gnu::vector_size(4 * sizeof(double))]] = double;

struct LaneVec {
  Lanes x, y, z;
  friend LaneVec operator+(LaneVec a, LaneVec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend LaneVec operator-(LaneVec a, LaneVec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend LaneVec operator*(Lanes s, LaneVec a) { return {s * a.x, s * a.y, s * a.z}; }
};
inline Lanes dot(LaneVec a, LaneVec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline LaneVec cross(LaneVec a, LaneVec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct LaneRecords {
  LaneVec vector;
  Lanes number;
};

inline Record load_record(const double* from) {
  Record r;
  std::memcpy(&r, from, sizeof(r));
  return r;
}

/// Records index(0) to index(7).
template <class Index>
inline LaneRecords gather_records(const double* records, Index index) {
  const auto pair = [&](int l) {
    const Record a = load_record(records + 4 * static_cast<std::ptrdiff_t>(index(l)));
    const Record b = load_record(records + 4 * static_cast<std::ptrdiff_t>(index(l + 1)));
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
  };
  const Lanes p0 = pair(0), p2 = pair(2), p4 = pair(4), p6 = pair(6);
  const Lanes xy_low = __builtin_shufflevector(p0, p2, 0, 4, 8, 12, 1, 5, 9, 13);
  const Lanes xy_high = __builtin_shufflevector(p4, p6, 0, 4, 8, 12, 1, 5, 9, 13);
  const Lanes zw_low = __builtin_shufflevector(p0, p2, 2, 6, 10, 14, 3, 7, 11, 15);
  const Lanes zw_high = __builtin_shufflevector(p4, p6, 2, 6, 10, 14, 3, 7, 11, 15);
  return {{__builtin_shufflevector(xy_low, xy_high, 0, 1, 2, 3, 8, 9, 10, 11),
           __builtin_shufflevector(xy_low, xy_high, 4, 5, 6, 7, 12, 13, 14, 15),
           __builtin_shufflevector(zw_low, zw_high, 0, 1, 2, 3, 8, 9, 10, 11)},
          __builtin_shufflevector(zw_low, zw_high, 4, 5, 6, 7, 12, 13, 14, 15)};
}

/// Writes eight records, `stride` records from one to the next.
inline void store_records(const LaneRecords& r, double* to, int stride) {
  const Lanes xy_low = __builtin_shufflevector(r.vector.x, r.vector.y, 0, 8, 1, 9, 2, 10, 3, 11);
  const Lanes xy_high = __builtin_shufflevector(r.vector.x, r.vector.y, 4, 12, 5, 13, 6, 14, 7, 15);
  const Lanes zw_low = __builtin_shufflevector(r.vector.z, r.number, 0, 8, 1, 9, 2, 10, 3, 11);
  const Lanes zw_high = __builtin_shufflevector(r.vector.z, r.number, 4, 12, 5, 13, 6, 14, 7, 15);
  const Record rows[n_lanes] = {
      __builtin_shufflevector(xy_low, zw_low, 0, 1, 8, 9),     __builtin_shufflevector(xy_low, zw_low, 2, 3, 10, 11),
      __builtin_shufflevector(xy_low, zw_low, 4, 5, 12, 13),   __builtin_shufflevector(xy_low, zw_low, 6, 7, 14, 15),
      __builtin_shufflevector(xy_high, zw_high, 0, 1, 8, 9),   __builtin_shufflevector(xy_high, zw_high, 2, 3, 10, 11),
      __builtin_shufflevector(xy_high, zw_high, 4, 5, 12, 13), __builtin_shufflevector(xy_high, zw_high, 6, 7, 14, 15)};
  for (int l = 0; l < n_lanes; ++l)
    std::memcpy(to + 4 * static_cast<std::ptrdiff_t>(stride) * l, &rows[l], sizeof(Record));
}

/// Numbers index(0) to index(7).
template <class Index>
inline Lanes gather_numbers(const double* numbers, Index index) {
  return Lanes{numbers[index(0)], numbers[index(1)], numbers[index(2)], numbers[index(3)],
               numbers[index(4)], numbers[index(5)], numbers[index(6)], numbers[index(7)]};
}

inline Lanes square_root(Lanes v) {
  alignas(64) double r[n_lanes];
  store(v, r);
  for (int l = 0; l < n_lanes; ++l) r[l] = std::sqrt(r[l]);
  return load_lanes(r);
}

/// n rounded up to whole batches.
inline std::size_t padded(std::size_t n) { return (n + n_lanes - 1) / n_lanes * n_lanes; }

/// Items begin to begin + 7; behind the last one it is repeated, in `rest`.
template <class Item>
inline const Item* batch_at(std::span<const Item> all, std::size_t begin, std::array<Item, n_lanes>& rest) {
  if (begin + n_lanes <= all.size()) return all.data() + begin;
  for (std::size_t l = 0; l < n_lanes; ++l) rest[l] = all[std::min(begin + l, all.size() - 1)];
  return rest.data();
}

/// visit(begin, items, count) for all batches, ascending; count < 8 in the last one.
template <class Item, class Visit>
inline void for_each_batch(std::span<const Item> all, Visit visit) {
  std::array<Item, n_lanes> rest;
  for (std::size_t begin = 0; begin < all.size(); begin += n_lanes)
    visit(begin, batch_at(all, begin, rest), static_cast<int>(std::min<std::size_t>(n_lanes, all.size() - begin)));
}

}  // namespace pliant
