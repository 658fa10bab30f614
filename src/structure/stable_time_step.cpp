#include "structure/stable_time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/error.hpp"
#include "mesh/geometry.hpp"
#include "structure/body_forces.hpp"

namespace pliant {
namespace {

double norm_of(std::span<const Vec3> vectors) {
  double sum = 0;
  for (const Vec3& v : vectors) sum += dot(v, v);
  return std::sqrt(sum);
}

/// A fixed vector without symmetry, so that no mode is missed: splitmix64 in [-1, 1).
std::vector<Vec3> start_vector(std::size_t n) {
  std::uint64_t state = 1;
  const auto next = [&] {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return 2.0 * static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53 - 1.0;
  };
  std::vector<Vec3> vector(n);
  for (Vec3& v : vector) v = {next(), next(), next()};
  return vector;
}

}  // namespace

double find_largest_frequency(const DeformableBody& body) { return find_largest_frequency(body, body.masses); }

double find_largest_frequency(const DeformableBody& body, std::span<const double> masses) {
  constexpr int most_iterations = 300;
  constexpr double tolerance = 1e-5;
  const std::size_t n = body.positions.size();
  if (body.potentials.empty() || n == 0) return 0;

  const auto lengths = edge_lengths(body.mesh, body.positions);
  double mean_length = 0;
  for (double length : lengths) mean_length += length / static_cast<double>(lengths.size());

  ShapeState shape(body.mesh);
  std::vector<Vec3> moved(n), ahead(n), behind(n), iterate = start_vector(n);  // iterate: M^1/2 times displacement
  for (std::size_t v = 0; v < n; ++v)
    if (is_pinned(body, v)) iterate[v] = {};
  double eigenvalue = 0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const double scale = 1.0 / norm_of(iterate);
    double largest = 0;
    for (std::size_t v = 0; v < n; ++v) {
      iterate[v] *= scale;
      largest = std::max(largest, norm(iterate[v]) / std::sqrt(masses[v]));
    }
    const double step = 1e-5 * mean_length / largest;
    const auto forces_at = [&](double signed_step, std::vector<Vec3>& forces) {
      for (std::size_t v = 0; v < n; ++v)
        moved[v] = body.positions[v] + signed_step / std::sqrt(masses[v]) * iterate[v];
      shape.update(moved);
      find_body_forces(body, shape, forces);
    };
    forces_at(step, ahead);
    forces_at(-step, behind);
    for (std::size_t v = 0; v < n; ++v)
      iterate[v] = is_pinned(body, v) ? Vec3{} : 0.5 / (step * std::sqrt(masses[v])) * (behind[v] - ahead[v]);
    const double previous = eigenvalue;
    eigenvalue = norm_of(iterate);
    if (eigenvalue == 0) return 0;
    if (std::abs(eigenvalue - previous) <= tolerance * eigenvalue) break;
  }
  return std::sqrt(eigenvalue);
}

double stable_time_step(double omega, double drag_rate) {
  if (omega <= 0) return std::numeric_limits<double>::infinity();
  return (drag_rate + std::hypot(drag_rate, 2.0 * omega)) / (omega * omega);
}

double stable_time_step(const DeformableBody& body, std::span<const double> drag) {
  double least_rate = drag.empty() ? body.damping / body.masses[0] : std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < drag.size(); ++v)
    least_rate = std::min(least_rate, (drag[v] + body.damping) / body.masses[v]);
  return stable_time_step(body.largest_frequency, least_rate);
}

int substeps_for(double time, double limit, const std::string& body) {
  constexpr double most_substeps = 1e6;
  const double count = std::ceil(time / (substep_safety * limit));
  if (!(count <= most_substeps))
    throw RunError(
        fmt::format("body '{}': a fluid step of {:g} would need {:g} substeps; take a smaller fluid step, softer "
                    "potentials or a larger mass",
                    body, time, count));
  return std::max(1, static_cast<int>(count));
}

}  // namespace pliant
