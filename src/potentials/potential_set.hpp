#pragma once
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "potentials/area_penalty.hpp"
#include "potentials/bending.hpp"
#include "potentials/edge_springs.hpp"
#include "potentials/membrane.hpp"
#include "potentials/pressure.hpp"
#include "potentials/surface_tension.hpp"
#include "potentials/volume_penalty.hpp"

namespace pliant {

/// A potential is a parameter struct with `name`, `energy(shape)` and `add_forces(shape, forces)`; to add one, add it
/// here.
using Potential = std::variant<EdgeSprings, Membrane, Bending, VolumePenalty, Pressure, FaceAreaPenalty,
                               TotalAreaPenalty, SurfaceTension>;

/// The potentials of one body; copies share them. Sums run in a fixed order: equal positions give equal bits.
class PotentialSet {
 public:
  void add(Potential potential);
  bool empty() const { return potentials_->empty(); }
  std::span<const Potential> potentials() const { return *potentials_; }

  /// Adds the forces of all potentials at the shape's positions to `forces`, n_vertices of them.
  void add_forces(const ShapeState& shape, std::span<Vec3> forces) const;
  /// Name and energy of each potential, in the order they were added.
  std::vector<std::pair<std::string, double>> energies(const TriangleMesh& mesh, std::span<const Vec3> positions) const;
  double energy(const TriangleMesh& mesh, std::span<const Vec3> positions) const;

 private:
  std::shared_ptr<const std::vector<Potential>> potentials_ = std::make_shared<const std::vector<Potential>>();
};

}  // namespace pliant
