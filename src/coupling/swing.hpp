#pragma once
#include <string>

#include "coupling/body.hpp"

namespace pliant {

/// Takes down an acceleration of a loosely coupled body, one a step. True once they have swung to and fro and grown for
/// so long that the coupling must be called unstable: in windows of 4 steps, at least 2 reversals in each, the largest
/// size growing from window to window, twice at least (after an impact on a stop it does so once), to more than
/// tenfold and to `least` in all. No motion that the steps resolve
/// does that, nor does noise. Windows rather than single steps, because the stops of a hinge cut swings short.
bool count_swing(SwingCount& swing, Vec3 acceleration, double least);

/// The same for the linear and the angular acceleration of a body. Of a hinge it is the acceleration that the load of
/// the last step asks for: stops hide what comes of it. `least`: an acceleration of the surface.
bool is_swinging_up(Body& body, const BodyKind& kind, const RigidLoad& load, double least);

/// What to tell of such a body.
std::string explain_swing(const Body& body, const BodyKind& kind);

}  // namespace pliant
