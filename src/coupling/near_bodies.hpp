#pragma once
#include <vector>

#include "coupling/bodies.hpp"
#include "structure/surface_contact.hpp"

namespace pliant {

/// Where bodies with a pose are when a step of deformable bodies begins.
enum class PosedBodies { at_its_start, at_its_end };

/// Brings to every deformable body the parts of other bodies' surfaces that it may touch within a step, across ranks
/// and periodic sides, and the impulses on them back. Bodies make themselves known, as boxes, to the ranks whose planes
/// they reach; those introduce neighbours to each other, whose ranks then exchange parts of surfaces.
class NearBodies {
 public:
  /// `range`: up to which gap they touch.
  NearBodies(const Grid& grid, double range) : grid_(grid), range_(range) {}

  /// Obstacles of each own body, in its frame, as they are at the beginning of a step; none for bodies with a pose.
  /// Collective.
  std::vector<Obstacles> find(const Bodies& bodies, double step, PosedBodies posed);

  /// impulses[b]: on the vertices of the obstacles of own body b. Returns the sums that belong to the vertices of each
  /// own body, added in the order of the bodies that pushed. Collective.
  std::vector<std::vector<Vec3>> bring_back(const Bodies& bodies, std::span<const std::span<const Vec3>> impulses);

 private:
  struct Wish;
  struct Start;
  struct Source {  // of a part
    long body;
    int image, rank;
    std::vector<int> vertices;
  };
  std::vector<std::vector<Wish>> introduce(const Bodies& bodies, std::span<const Start> starts) const;
  Start start_of(const Body& body, const BodyKind& kind, double step, PosedBodies posed) const;

  Grid grid_;
  double range_;
  std::vector<std::vector<Source>> sources_;  // of each own body's obstacles, part by part
};

}  // namespace pliant
