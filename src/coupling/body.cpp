#include "coupling/body.hpp"

namespace pliant {

void follow_pose(Body& body, const BodyKind& kind) {
  place_vertices(body.pose, kind.reference, body.surface.positions, body.surface.velocities);
}

}  // namespace pliant
