#pragma once
#include <cstring>

/// As many neighbouring numbers of a row as the processor's widest registers hold, with the arithmetic of one: for row
/// kernels whose loads count. Where a batch of eight is part of the data, see core/lanes.hpp.
namespace pliant {

#if defined(__AVX512F__)
inline constexpr int pack_size = 8;
#elif defined(__AVX__)
inline constexpr int pack_size = 4;
#else
inline constexpr int pack_size = 2;
#endif
using Pack [[gnu::vector_size(pack_size * sizeof(double))]] = double;
using PackPlaces [[gnu::vector_size(pack_size * sizeof(long long))]] = long long;

inline Pack load_pack(const double* from) {
  Pack v;
  std::memcpy(&v, from, sizeof(v));
  return v;
}
inline void store_pack(Pack v, double* to) { std::memcpy(to, &v, sizeof(v)); }
/// The first `count` of them. Reads and writes back what stands behind.
inline void store_pack(Pack v, double* to, int count) {
  if (count < pack_size) {
    const Pack old = load_pack(to);
    for (int l = count; l < pack_size; ++l) v[l] = old[l];
  }
  store_pack(v, to);
}

/// The numbers one place back: the last of the previous pack, then all but the last.
inline Pack one_back(Pack previous, Pack here) {
#if defined(__AVX512F__)
  return __builtin_shuffle(previous, here, PackPlaces{7, 8, 9, 10, 11, 12, 13, 14});
#elif defined(__AVX__)
  return __builtin_shuffle(previous, here, PackPlaces{3, 4, 5, 6});
#else
  return __builtin_shuffle(previous, here, PackPlaces{1, 2});
#endif
}

/// Of a row whose packs are aligned, the numbers one place on and one place back from `here`. Where a pack fills a
/// cache line, a load from there would straddle two, and take longer than the arithmetic of a row kernel.
inline Pack load_one_on(const double* here) {
#if defined(__AVX512F__)
  return __builtin_shuffle(load_pack(here), load_pack(here + 8), PackPlaces{1, 2, 3, 4, 5, 6, 7, 8});
#else
  return load_pack(here + 1);
#endif
}
inline Pack load_one_back(const double* here) {
#if defined(__AVX512F__)
  return one_back(load_pack(here - 8), load_pack(here));
#else
  return load_pack(here - 1);
#endif
}

}  // namespace pliant
