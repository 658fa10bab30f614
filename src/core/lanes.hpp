#pragma once
#include <cstring>

/// Eight numbers at once, with the arithmetic of one: the compiler makes of them what the processor has.
namespace pliant {

inline constexpr int n_lanes = 8;
using Lanes [[gnu::vector_size(n_lanes * sizeof(double))]] = double;
using LongLanes [[gnu::vector_size(n_lanes * sizeof(long long))]] = long long;
using IntLanes [[gnu::vector_size(n_lanes * sizeof(int))]] = int;

inline Lanes load_lanes(const double* from) {
  Lanes v;
  std::memcpy(&v, from, sizeof(v));
  return v;
}
/// The first `count` of them; zero behind.
inline Lanes load_lanes(const double* from, int count) {
  if (count == n_lanes) return load_lanes(from);
  Lanes v{};
  for (int l = 0; l < count; ++l) v[l] = from[l];
  return v;
}
inline void store(Lanes v, double* to) { std::memcpy(to, &v, sizeof(v)); }
/// The first `count` of them. Reads and writes back what stands behind.
inline void store(Lanes v, double* to, int count) {
  if (count == n_lanes) return store(v, to);
  const Lanes old = load_lanes(to);
  for (int l = count; l < n_lanes; ++l) v[l] = old[l];
  store(v, to);
}
inline void store(IntLanes v, int* to) { std::memcpy(to, &v, sizeof(v)); }

/// Of a row in packs of lanes: the numbers one place further on, `next` being the pack behind, or one place back. Loads
/// from there would straddle two cache lines each, and take longer than the arithmetic of a row kernel.
inline Lanes one_on(Lanes here, Lanes next) { return __builtin_shuffle(here, next, LongLanes{1, 2, 3, 4, 5, 6, 7, 8}); }
inline Lanes one_back(Lanes previous, Lanes here) {
  return __builtin_shuffle(previous, here, LongLanes{7, 8, 9, 10, 11, 12, 13, 14});
}

inline bool any(IntLanes v) {
  int bits = 0;
  for (int l = 0; l < n_lanes; ++l) bits |= v[l];
  return bits != 0;
}
inline double sum(Lanes v) { return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7])); }

/// Lanes from..7 become zero.
inline Lanes without_lanes_from(int from, Lanes v) {
  for (int l = from; l < n_lanes; ++l) v[l] = 0;
  return v;
}

}  // namespace pliant
