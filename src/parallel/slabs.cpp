#include "parallel/slabs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace pliant {

Slab slab_of_rank(int planes, int ranks, int rank) {
  if (ranks > planes)
    throw InputError(
        fmt::format("{} ranks cannot share {} planes of cells in z: use at most {} ranks, or more cells "
                    "in z (box.cells)",
                    ranks, planes, planes));
  const int base = planes / ranks, remainder = planes % ranks;
  return {rank * base + std::min(rank, remainder), base + (rank < remainder ? 1 : 0)};
}

int rank_of_plane(int planes, int ranks, int plane) {
  const int base = planes / ranks, remainder = planes % ranks;
  const int in_large = remainder * (base + 1);
  return plane < in_large ? plane / (base + 1) : remainder + (plane - in_large) / base;
}

}  // namespace pliant
