#pragma once
#include "coupling/bodies.hpp"
#include "structure/repulsion.hpp"

namespace pliant {

/// Sets loads.contact of all bodies with a pose: the repulsion of their vertices from those of other bodies and from
/// the walls. Every vertex is dealt with by the rank that holds the plane it is in. Collective.
class Contact {
 public:
  Contact(const Grid& grid, const CaseConfig& config);
  bool is_wanted() const { return repulsion_.range > 0 && repulsion_.strength > 0; }
  void find(Bodies& bodies) const;

 private:
  Grid grid_;
  RepulsionBox box_;
  Repulsion repulsion_;
};

}  // namespace pliant
