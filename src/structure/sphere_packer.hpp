#pragma once
#include <optional>
#include <vector>

#include "config/case_config.hpp"
#include "core/random_reals.hpp"
#include "mesh/distance.hpp"
#include "mesh/surface.hpp"
#include "structure/placement.hpp"

namespace pliant {

/// What is packed: balls of one radius, how far they stay from each other's surface, from obstacles and from bounded
/// sides, and about how many there will be.
struct PackedSpheres {
  double radius = 0, gap = 0;
  int count = 1;
};

/// Random sequential addition of equal balls into a region of the box, periodic where the box is: a ball goes to a
/// uniformly random place, and if it meets another ball or an obstacle, it tries the next. Everything is listed in
/// the cells of a lattice that it keeps centres out of, so a try looks into one cell only. Saturates at a volume
/// fraction of about 0.38 (B. Widom, J. Chem. Phys. 44, 3888, 1966).
class SpherePacker {
 public:
  SpherePacker(const CaseConfig& config, const PlacementConfig& placement, const PackedSpheres& spheres);

  /// Directions along which no ball fits between the sides, or beside its own image. Empty: some may fit.
  std::vector<int> tight_directions() const;
  /// Balls that could fill the volume that centres may lie in, as a fraction of the region's volume.
  double volume_fraction(std::size_t n_spheres) const;

  void add_obstacle(const BoundingSphere& sphere);
  /// A surface at its place; balls stay off its faces, and out of it if it is closed. It must outlive the packer.
  void add_obstacle(const Surface& surface);

  /// The centre of one more ball, in the box; none if a million tries fail.
  std::optional<Vec3> add(RandomReals& random);

 private:
  struct Cell {
    std::vector<int> spheres, triangles;
    signed char inside = -1;  ///< of an obstacle, where no triangle is near; -1: not known yet
  };
  struct Solid {
    const Surface* surface;
    Vec3 shift, lower, upper;
  };

  template <class Add>
  void for_cells(Vec3 lower, Vec3 upper, Add add_to);
  Cell& cell_at(Vec3 x);
  bool is_free(Vec3 x);
  bool is_inside_a_solid(Vec3 x) const;

  Vec3 origin_, size_, lower_, upper_, step_;
  std::array<bool, 3> periodic_{};
  std::array<int, 3> n_{};
  PackedSpheres packed_;
  std::vector<Cell> cells_;
  std::vector<BoundingSphere> spheres_;  ///< radius: how far centres stay away
  std::vector<Triangle> triangles_;
  std::vector<Solid> solids_;
};

}  // namespace pliant
