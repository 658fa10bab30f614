#include "app/bench_markers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/random_reals.hpp"
#include "mesh/geometry.hpp"
#include "mesh/shapes/icosphere.hpp"

namespace pliant {
namespace {

constexpr int frequency = 8, n_faces = 20 * frequency * frequency;

template <class T>
void reorder(std::vector<T>& list, const std::vector<std::size_t>& order) {
  std::vector<T> sorted;
  sorted.reserve(list.size());
  for (std::size_t n : order) sorted.push_back(list[n]);
  list.swap(sorted);
}

}  // namespace

BenchMarkers make_bench_markers(const Grid& grid, int n, MarkerOrder order) {
  const double smallest = std::min({grid.size().x, grid.size().y, grid.size().z});
  const double face_area = std::numbers::sqrt3 / 4;
  const double radius = std::min(std::sqrt(n_faces * face_area / (4 * std::numbers::pi)), 0.25 * smallest);
  const double probe = std::min(1.5, 0.1 * smallest), reach = radius + probe;
  const Surface sphere = make_icosphere(frequency, radius);
  const auto centroids = face_centroids(sphere.mesh, sphere.positions);
  const auto normals = face_normals(sphere.mesh, sphere.positions);

  RandomReals random(5);
  BenchMarkers markers;
  Vec3 center;
  for (int m = 0; m < n; ++m) {
    const auto f = static_cast<std::size_t>(m % n_faces);
    if (f == 0)
      for (int d = 0; d < 3; ++d) {
        const double margin = grid.is_periodic(d) ? 0 : reach;
        center[d] = grid.origin()[d] + margin + random.next() * (grid.size()[d] - 2 * margin);
      }
    markers.positions.push_back(center + centroids[f]);
    markers.ends.push_back(center + centroids[f] + probe * normals[f]);
  }
  if (order == MarkerOrder::random) {
    std::vector<std::size_t> places(markers.positions.size());
    std::iota(places.begin(), places.end(), std::size_t{0});
    for (std::size_t i = places.size(); i > 1; --i)
      std::swap(places[i - 1], places[static_cast<std::size_t>(random.next() * static_cast<double>(i))]);
    reorder(markers.positions, places);
    reorder(markers.ends, places);
  }
  return markers;
}

}  // namespace pliant
