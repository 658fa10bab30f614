#include "simulation/bodies.hpp"

#include "core/error.hpp"
#include "coupling/one_way.hpp"
#include "diagnostics/shape.hpp"
#include "structure/make_body.hpp"

namespace pliant {

Bodies::Bodies(const CaseConfig& config, const Grid& grid) : fluid_(config.fluid), ranks_(grid.ranks()) {
  const double mean_dz = grid.size().z / grid.cells()[2];
  const BodySetting setting{config.folder, (grid.dx() + grid.dy() + mean_dz) / 3};
  std::vector<std::string> problems;
  for (const auto& body : config.bodies) {
    try {
      bodies_.push_back(make_body(body, setting));
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

void Bodies::advance(const FlowSampler& flow, double step) {
  for (auto& body : bodies_) advance_one_way(body, flow, fluid_, step);
}

std::vector<std::string> Bodies::columns(std::size_t body) const {
  std::vector<std::string> names{"step", "time", "x", "y", "z",     "volume",
                                 "area", "L",    "B", "W", "angle", "kinetic_energy"};
  for (const auto& [potential, energy] : measure_shape(bodies_[body]).energies) names.push_back("energy_" + potential);
  return names;
}

std::vector<double> Bodies::row(std::size_t body, Moment moment) const {
  const auto shape = measure_shape(bodies_[body]);
  const auto& fit = shape.ellipsoid;
  std::vector<double> row{static_cast<double>(moment.step),
                          moment.time,
                          fit.centroid.x,
                          fit.centroid.y,
                          fit.centroid.z,
                          fit.volume,
                          shape.area,
                          fit.length,
                          fit.breadth,
                          fit.width,
                          fit.angle,
                          shape.kinetic_energy};
  for (const auto& [potential, energy] : shape.energies) row.push_back(energy);
  return row;
}

SurfaceSnapshot Bodies::snapshot(std::size_t body) const {
  const auto& b = bodies_[body];
  return {b.positions, b.velocities, b.forces};
}

}  // namespace pliant
