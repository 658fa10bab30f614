#pragma once
#include <bit>
#include <cstdint>
#include <vector>

#include "boundary/periodic_ghosts.hpp"
#include "transfer/markers.hpp"

namespace pliant {

/// Which parts of the rows of a slab, ghosts counted, markers reach. A row is cut into at most 64 segments of whole
/// cache lines, a bit each.
class ReachedRows {
 public:
  explicit ReachedRows(const Grid& grid);

  void clear();
  /// All nodes of all stencils of these markers.
  void include(const Markers& markers);
  /// All nodes of plane k.
  void include_plane(int k);
  /// The nodes that ghosts of periodic x and y sides are copies of.
  void include_origins_of_ghosts();

  bool is_empty(int j, int k) const { return segments(j, k) == 0; }
  /// visit(i_begin, i_end) for the parts of a row, ascending; from -1 to nx + 1 at most.
  template <class Visit>
  void for_each_part(int j, int k, Visit visit) const {
    for (std::uint64_t rest = segments(j, k); rest != 0;) {
      const int first = std::countr_zero(rest), n = std::countr_one(rest >> first);
      visit(begin_of(first), begin_of(first + n));
      rest &= rest + (rest & -rest);  // the carry takes the lowest run of ones with it
    }
  }
  /// A part of plane k that holds all ghosts of x and y sides that are reached; empty if there are none.
  PlaneRegion ghosts(int k) const;
  /// Is node i in one of the parts?
  bool holds(int i, int j, int k) const { return (segments(j, k) >> segment_of(i) & 1) != 0; }

 private:
  std::size_t at(int j, int k) const {
    return static_cast<std::size_t>(k + 1) * static_cast<std::size_t>(grid_.ny() + 2) + static_cast<std::size_t>(j + 1);
  }
  std::uint64_t segments(int j, int k) const { return segments_[at(j, k)]; }
  // The first segment holds the ghost -1 alone, so that the others begin with cache lines.
  int segment_of(int i) const { return (i + width_) / width_; }
  int begin_of(int segment) const { return std::clamp((segment - 1) * width_, -1, grid_.nx() + 1); }
  std::uint64_t mask_of(int i_first, int i_last) const;

  Grid grid_;
  int width_;  // nodes of a segment
  std::vector<std::uint64_t> segments_;
};

}  // namespace pliant
