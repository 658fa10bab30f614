#pragma once
#include <cstring>

/// Eight numbers at once, with the arithmetic of one: the compiler makes of them what the processor has.
namespace pliant {

inline constexpr int n_lanes = 8;
using Lanes [[gnu::vector_size(n_lanes * sizeof(double))]] = double;
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
inline void store(IntLanes v, int* to) { std::memcpy(to, &v, sizeof(v)); }

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
