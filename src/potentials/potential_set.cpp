#include "potentials/potential_set.hpp"

namespace pliant {

void PotentialSet::add(Potential potential) {
  auto grown = *potentials_;
  grown.push_back(std::move(potential));
  potentials_ = std::make_shared<const std::vector<Potential>>(std::move(grown));
}

void PotentialSet::add_forces(const ShapeState& shape, std::span<Vec3> forces) const {
  InnerStress& stress = shape.scratch();
  stress.reset(shape.mesh());
  bool is_stressed = false;
  for (const Potential& potential : *potentials_)
    std::visit(
        [&](const auto& p) {
          if constexpr (requires { p.add_stress(shape, stress); }) p.add_stress(shape, stress), is_stressed = true;
          else p.add_forces(shape, forces);
        },
        potential);
  if (is_stressed) stress.add_forces(shape, forces);
}

std::vector<std::pair<std::string, double>> PotentialSet::energies(const TriangleMesh& mesh,
                                                                   std::span<const Vec3> positions) const {
  const ShapeState shape(mesh, positions);
  std::vector<std::pair<std::string, double>> result;
  for (const Potential& potential : *potentials_)
    std::visit([&](const auto& p) { result.emplace_back(p.name, p.energy(shape)); }, potential);
  return result;
}

double PotentialSet::energy(const TriangleMesh& mesh, std::span<const Vec3> positions) const {
  double sum = 0;
  for (const auto& [name, value] : energies(mesh, positions)) sum += value;
  return sum;
}

}  // namespace pliant
