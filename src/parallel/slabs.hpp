#pragma once

namespace pliant {

/// A contiguous run of planes of the global grid.
struct Slab {
  int begin = 0;  ///< first global plane
  int count = 0;
};

/// The planes of one rank when `planes` are shared out over `ranks` as evenly as possible; the first ranks take the
/// remainder. Throws InputError if there are more ranks than planes.
Slab slab_of_rank(int planes, int ranks, int rank);

/// The rank that holds a global plane.
int rank_of_plane(int planes, int ranks, int plane);

}  // namespace pliant
