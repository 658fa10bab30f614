#pragma once
#include "mesh/surface.hpp"

namespace pliant {

enum class LeafletsMade { both, anterior, posterior };

/// Lengths but radius and edge are fractions of the annulus's diameter.
struct NaturalValveSizes {
  double radius = 0.5;            ///< of the annulus
  double opening = 0.2;           ///< between the middles of the two free edges at rest, along x
  double free_edge = 2.4;         ///< length of both free edges together
  double commissure = 0.2;        ///< how far below the annulus the free edges meet
  double posterior_length = 0.5;  ///< of the posterior leaflet in its middle
  double edge = 0.05;
  LeafletsMade leaflet = LeafletsMade::both;
};

/// The two leaflets of a mitral valve, one surface, open at the annulus (the circle of `radius` in the plane z = 0) and
/// at the free edge below it; normals away from the valve's axis. The anterior leaflet hangs from the third of the
/// annulus about the positive x axis, the posterior one from the rest, and they meet along two commissures that go
/// straight down from the annulus at 60 degrees to both sides of the x axis.
///
/// Leaflets are ruled: straight lines lead from the annulus to the free edges, which are circular arcs of equal length
/// between the lower ends of the commissures, tilted downwards, the anterior one more. Turned up about their ends
/// (which bends the leaflets and hardly stretches them) the arcs come to lie on each other and close the valve along a
/// curved line; pushed apart they open to a tube whose circumference is `free_edge`. Annulus vertices are those of any
/// circle of this radius and edge. Selections: "annulus"; "free-edge", "anterior-edge", "posterior-edge"; "commissure".
/// A single leaflet has those that it takes part in. Throws InputError for sizes that make no such valve.
Surface make_natural_valve(const NaturalValveSizes& sizes);

}  // namespace pliant
