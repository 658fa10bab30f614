#pragma once
#include "mesh/surface.hpp"

namespace pliant {

/// A human red blood cell at rest about the origin, its axis along z (E. Evans & Y.-C. Fung, Microvasc. Res. 4, 335,
/// 1972): at r = q R from the axis it is
///   R sqrt(1 - q^2) (0.207 + 2.003 q^2 - 1.123 q^4)  thick,
/// a disc with a dimple on either side. For R = 3.91 micrometres it has 94 cubic and 134 square micrometres.
/// A geodesic sphere of 10 f^2 + 2 vertices whose meridians are laid on it by their length: faces are nearly as even as
/// on the sphere, no angle is below 45 degrees. Throws InputError if frequency < 1 or above 1000, or if the radius is
/// not positive.
Surface make_red_cell(int frequency, double radius);

}  // namespace pliant
