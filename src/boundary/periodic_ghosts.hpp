#pragma once
#include "field/field.hpp"

namespace pliant {

/// Part of a plane, ghosts counted: columns i and rows j from begin to end - 1.
struct PlaneRegion {
  int i_begin = 0, i_end = 0, j_begin = 0, j_end = 0;
  bool is_empty() const { return i_begin >= i_end || j_begin >= j_end; }
};

/// Copies the x and y ghosts of plane k along periodic directions; ghosts of bounded sides stay as they are.
template <class Location>
void fill_periodic_ghosts(View<Location> f, const Grid& grid, int k);

/// The reverse: adds the x and y ghosts of a region of plane k to the nodes that they are copies of along periodic
/// directions, and empties them. A region that holds ghosts must hold the nodes on the other side as well.
template <class Location>
void accumulate_periodic_ghosts(View<Location> f, const Grid& grid, int k, const PlaneRegion& region);

}  // namespace pliant
