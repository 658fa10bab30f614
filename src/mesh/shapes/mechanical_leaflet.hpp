#pragma once
#include <array>

#include "mesh/surface.hpp"

namespace pliant {

/// Lengths but the first and last are fractions of the channel's diameter.
struct MechanicalLeafletSizes {
  double radius = 0.5;        ///< of the channel
  double hinge_offset = 0.1;  ///< of the hinge axis from the channel's axis
  double clearance = 0.02;    ///< from the channel's wall at all angles, and between two leaflets that are closed
  double closed_angle = 25;   ///< degrees from the plane of the annulus at which it closes its half of the channel
  double edge = 0.05;
};

/// One leaflet of a bileaflet valve, flat and open, in the x-y plane with normals along +z. **The hinge axis is the y
/// axis**; the long part, towards the wall, is at x > 0, the short one, up to the straight edge where the leaflets
/// meet, at x < 0. The channel's axis is at x = -hinge_offset, so with the body's center at the hinge a hinge with the
/// axis (0, 1, 0) has the angle 0 in the plane of the annulus, closed_angle closed and up to 90 degrees open, with the
/// long part swung to z < 0. A `rotation` by 180 degrees about z and the axis (0, -1, 0) make the other leaflet.
///
/// Its outline is what the channel, less the clearance, leaves to it: an ellipse that looks round at the closed angle,
/// and beside the short part two straight sides, so that its corners pass the wall. Selections: "hinge-axis", the two
/// ends of the axis; "straight-edge"; "arc", the curved side. Throws InputError for sizes that make no such leaflet.
Surface make_mechanical_leaflet(const MechanicalLeafletSizes& sizes);

/// Both leaflets about the channel's axis, at an angle from the plane of the annulus z = 0. Selections: as those of
/// one, with "left-" at x < 0 and "right-" at x > 0.
Surface make_bileaflet_valve(const MechanicalLeafletSizes& sizes, double angle);

}  // namespace pliant
