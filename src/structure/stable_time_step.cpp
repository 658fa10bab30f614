#include "structure/stable_time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

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

double mean_edge(const DeformableBody& body) {
  double sum = 0;
  const auto lengths = edge_lengths(body.mesh, body.positions);
  for (double length : lengths) sum += length;
  return sum / static_cast<double>(lengths.size());
}

/// The body with cords that are slack shortened to what they span, so that they count.
DeformableBody with_taut_cords(DeformableBody body) {
  auto cords = std::make_shared<std::vector<Cord>>();
  const auto mean_of = [&](std::span<const int> vertices) {
    Vec3 sum;
    for (int v : vertices) sum += body.positions[v];
    return sum / static_cast<double>(vertices.size());
  };
  for (Cord cord : items_of(body.attachments.cords)) {
    const Vec3 end = cord.to.empty() ? body.origin + rotate(body.orientation, cord.point) : mean_of(cord.to);
    // Shorter by a part in a thousand: differences of forces must not slacken it.
    cord.rest_length = std::min(cord.rest_length, 0.999 * norm(end - mean_of(cord.from)));
    cords->push_back(std::move(cord));
  }
  body.attachments.cords = std::move(cords);
  return body;
}

bool has_elastic_forces(const DeformableBody& body) {
  return !body.potentials.empty() || !items_of(body.attachments.tethers).empty() ||
         !items_of(body.attachments.cords).empty();
}

/// Largest eigenvalue in modulus of M^-1/2 A M^-1/2, for apply(displacements, A times them), over the vertices that are
/// not pinned.
template <class Apply>
double largest_eigenvalue(const DeformableBody& body, std::span<const double> masses, Apply apply) {
  constexpr int most_iterations = 300;
  constexpr double tolerance = 1e-5;
  const std::size_t n = body.positions.size();
  std::vector<Vec3> moved(n), result(n), iterate = start_vector(n);  // iterate: M^1/2 times displacement
  std::vector<double> weight(n);
  for (std::size_t v = 0; v < n; ++v) weight[v] = body.is_pinned(v) ? 0.0 : 1.0 / std::sqrt(masses[v]);
  double eigenvalue = 0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    for (std::size_t v = 0; v < n; ++v)
      if (weight[v] == 0) iterate[v] = {};
    const double size = norm_of(iterate);
    if (size == 0) return 0;
    for (std::size_t v = 0; v < n; ++v) {
      iterate[v] *= 1.0 / size;
      moved[v] = weight[v] * iterate[v];
    }
    apply(moved, result);
    for (std::size_t v = 0; v < n; ++v) iterate[v] = weight[v] * result[v];
    const double previous = eigenvalue;
    eigenvalue = norm_of(iterate);
    if (eigenvalue == 0) return 0;
    if (std::abs(eigenvalue - previous) <= tolerance * eigenvalue) break;
  }
  return eigenvalue;
}

}  // namespace

double find_largest_frequency(const DeformableBody& given, std::span<const double> masses) {
  const std::size_t n = given.positions.size();
  if (!has_elastic_forces(given) || n == 0) return 0;
  const DeformableBody body = with_taut_cords(given);
  const double mean_length = mean_edge(body);
  ShapeState shape(body.mesh);
  std::vector<Vec3> moved(n), ahead(n);
  return std::sqrt(largest_eigenvalue(body, masses, [&](std::span<const Vec3> along, std::span<Vec3> behind) {
    double largest = 0;
    for (const Vec3& d : along) largest = std::max(largest, norm(d));
    const double step = 1e-5 * mean_length / largest;
    const auto forces_at = [&](double signed_step, std::span<Vec3> forces) {
      for (std::size_t v = 0; v < n; ++v) moved[v] = body.positions[v] + signed_step * along[v];
      shape.update(moved);
      find_elastic_forces(body, shape, forces);
    };
    forces_at(step, ahead);
    forces_at(-step, behind);
    for (std::size_t v = 0; v < n; ++v) behind[v] = 0.5 / step * (behind[v] - ahead[v]);
  }));
}

double find_largest_damping_rate(const DeformableBody& body, std::span<const double> masses) {
  const auto tethers = items_of(body.attachments.tethers);
  const bool any = body.inner_damping > 0 ||
                   std::any_of(tethers.begin(), tethers.end(), [](const Tether& t) { return t.damping > 0; });
  if (!any || body.positions.empty()) return 0;
  const ShapeState shape(body.mesh, body.positions);
  return largest_eigenvalue(body, masses, [&](std::span<const Vec3> velocities, std::span<Vec3> forces) {
    std::fill(forces.begin(), forces.end(), Vec3{});
    add_damping_forces(body, shape, velocities, forces);
  });
}

double stable_time_step(double omega, double drag_rate, double damping_rate) {
  const double rate = drag_rate - damping_rate;
  if (omega <= 0 && rate >= 0) return std::numeric_limits<double>::infinity();
  // Either form of the root, whichever has no cancellation.
  if (rate < 0) return 4.0 / (std::hypot(rate, 2.0 * omega) - rate);
  return (rate + std::hypot(rate, 2.0 * omega)) / (omega * omega);
}

double stable_time_step(const DeformableBody& body, std::span<const double> drag) {
  double least_rate = drag.empty() ? body.damping / body.masses[0] : std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < drag.size(); ++v)
    least_rate = std::min(least_rate, (drag[v] + body.damping) / body.masses[v]);
  return stable_time_step(body.largest_frequency, least_rate, body.largest_damping_rate);
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
