#pragma once
#include <map>

#include "coupling/bodies.hpp"
#include "coupling/near_bodies.hpp"
#include "structure/repulsion.hpp"
#include "structure/surface_contact.hpp"

namespace pliant {

/// Deformable bodies that act on the flow move before those that do not: two passes in a step where a case has both.
enum class ContactPass { only, first, second };

/// Keeps bodies apart from each other, from walls, and deformable ones from themselves.
///
/// Between bodies with a pose it is a repulsion of their vertices, found once a step. Deformable bodies have contact
/// forces on their vertices, found in every substep of theirs:
///   begin(bodies, step, ...);  of(body)->add_forces(...) in each substep, without any communication;  end(bodies,
///   step).
class Contact {
 public:
  Contact(const Grid& grid, const CaseConfig& config);
  bool is_wanted() const { return repulsion_.range > 0 && repulsion_.strength > 0; }

  /// Sets loads.contact of all bodies with a pose: their repulsion from each other and from the walls, and what
  /// deformable bodies pressed on them in the last step. Every vertex is dealt with by the rank that holds the plane it
  /// is in. Collective.
  void find(Bodies& bodies) const;

  /// A step of deformable bodies begins. Bodies with a pose have moved through it already or not; what they have not
  /// moved through they will take at their velocity. Collective.
  void begin(const Bodies& bodies, double step, PosedBodies posed);
  /// The contact of an own deformable body within that step; null if none is wanted.
  SurfaceContact* of(const Body& body);
  /// The step is over: evens out the velocities of deformable bodies that were advanced apart from each other, so that
  /// contact adds no momentum, and sets what they pressed on bodies with a pose, in a second pass adds to it. Only the
  /// last pass of a step leaves bodies with a pose behind where they are. Collective.
  void end(Bodies& bodies, double step, ContactPass pass = ContactPass::only);

 private:
  Grid grid_;
  RepulsionBox box_;
  Repulsion repulsion_;
  ContactLaw law_;
  bool has_deformable_ = false;
  NearBodies near_;
  std::map<long, SurfaceContact> contacts_;  // of own bodies, by number
};

}  // namespace pliant
