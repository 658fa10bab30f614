#pragma once
#include "boundary/side_rules.hpp"
#include "field/field.hpp"
#include "parallel/slab_halo.hpp"

namespace pliant {

/// Fills the x ghosts of row j of plane k, and the values on the x sides, from its interior.
void fill_row_ghosts(double* row, const FieldRules& rules, int nx, int j, int k);
/// Fills the ghost rows j = -1 and ny of plane k, corners included, and the values on the y sides. Needs complete rows.
template <class Location>
void fill_ghost_rows(Plane<Location> f, const FieldRules& rules, int nx, int ny, int k);

/// Fills the x and y ghosts of plane k, and the values on the side faces, from the interior of that plane.
template <class Location>
void fill_plane_ghosts(Plane<Location> f, const FieldRules& rules, int nx, int ny, int k);
template <class Location>
void fill_plane_ghosts(View<Location> f, const FieldRules& rules, int nx, int ny, int k) {
  fill_plane_ghosts(f.at_plane(k), rules, nx, ny, k);
}

/// ghost = sign interior + factor value of the rule, on a whole plane at an end of z, corners included.
template <class Location>
void fill_end_plane(Plane<Location> ghost, ConstPlane<Location> interior, double sign, double factor,
                    const SideRule& rule, int nx, int ny);

/// Fills the ghost planes k = -1 and nz at the bounded ends of z (whole planes, corners included), and the face plane
/// nz - 1 of a quantity that lives on z faces. Needs complete planes.
template <class Location>
void fill_end_planes(View<Location> f, const FieldRules& rules, const Grid& grid);

/// The planes of a field as the halo exchange sees them.
template <class Location>
PlaneStack plane_stack(View<Location> f) {
  return {f.origin - f.row - 8, f.plane, static_cast<std::size_t>(f.plane)};
}
template <class Location>
PlaneStack plane_stack(Field<Location>& f) {
  return plane_stack(f.view());
}

}  // namespace pliant
