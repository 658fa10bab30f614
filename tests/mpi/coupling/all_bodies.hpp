#pragma once
#include <vector>

#include "coupling/bodies.hpp"

namespace pliant {

/// Numbers of all bodies of a run, by id, whole on every rank: `numbers(body)` gives `width(kind)` of each. Sums with
/// exact zeros, so the bits are those of the ranks that hold the bodies. Collective.
template <class Width, class Numbers>
std::vector<double> gather_bodies(const Bodies& bodies, Width width, Numbers numbers) {
  std::vector<std::size_t> begin(1, 0);
  for (std::size_t k = 0; k < bodies.kinds().size(); ++k)
    for (long n = 0; n < bodies.count(k); ++n) begin.push_back(begin.back() + width(bodies.kinds()[k]));
  std::vector<double> all(begin.back(), 0.0);
  for (const Body& body : bodies.own()) {
    const std::vector<double> of_body = numbers(body);
    std::copy(of_body.begin(), of_body.end(),
              all.begin() + static_cast<std::ptrdiff_t>(begin[static_cast<std::size_t>(body.id)]));
  }
  bodies.grid().ranks().sum(all);
  return all;
}

/// Positions, velocities and forces of all vertices of all bodies.
inline std::vector<double> all_vertices(const Bodies& bodies) {
  return gather_bodies(
      bodies, [](const BodyKind& kind) { return 9 * kind.prototype.positions.size(); },
      [](const Body& body) {
        std::vector<double> numbers;
        for (const auto* values : {&body.surface.positions, &body.surface.velocities, &body.surface.forces})
          for (const Vec3 x : *values) numbers.insert(numbers.end(), {x.x, x.y, x.z});
        return numbers;
      });
}

/// Three numbers of every body.
template <class Get>
std::vector<Vec3> all_vectors(const Bodies& bodies, Get get) {
  const auto numbers = gather_bodies(
      bodies, [](const BodyKind&) { return std::size_t{3}; },
      [&](const Body& body) {
        const Vec3 v = get(body);
        return std::vector<double>{v.x, v.y, v.z};
      });
  std::vector<Vec3> vectors;
  for (std::size_t n = 0; n < numbers.size(); n += 3) vectors.push_back({numbers[n], numbers[n + 1], numbers[n + 2]});
  return vectors;
}

}  // namespace pliant
