#include "mesh/shapes/icosphere.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace pliant {
namespace {

struct UnitSphere {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
};

UnitSphere icosahedron() {
  // A pole, a ring of five above the equator, a ring of five below, turned by half a step, and the other pole.
  const double height = 1.0 / std::sqrt(5.0), radius = 2.0 / std::sqrt(5.0), step = 2.0 * std::numbers::pi / 5.0;
  UnitSphere sphere;
  sphere.positions.push_back({0, 0, 1});
  for (int k = 0; k < 5; ++k)
    sphere.positions.push_back({radius * std::cos(k * step), radius * std::sin(k * step), height});
  for (int k = 0; k < 5; ++k)
    sphere.positions.push_back({radius * std::cos((k + 0.5) * step), radius * std::sin((k + 0.5) * step), -height});
  sphere.positions.push_back({0, 0, -1});
  for (int k = 0; k < 5; ++k) {
    const int up = 1 + k, up_next = 1 + (k + 1) % 5, down = 6 + k, down_next = 6 + (k + 1) % 5;
    sphere.faces.push_back({0, up, up_next});
    sphere.faces.push_back({up, down, up_next});
    sphere.faces.push_back({up_next, down, down_next});
    sphere.faces.push_back({down, 11, down_next});
  }
  return sphere;
}

/// Splits every edge into n, and every face into n^2 faces in rows; the new vertices are projected on the sphere.
UnitSphere split(const UnitSphere& coarse, int n) {
  UnitSphere fine;
  fine.positions = coarse.positions;
  std::map<std::pair<int, int>, int> first_on_edge;  // inner vertices of edge (low, high), from low to high
  const auto on_edge = [&](int a, int b, int i) {    // i of n steps from a to b
    if (i == 0) return a;
    if (i == n) return b;
    const int low = std::min(a, b), high = std::max(a, b);
    const auto [entry, is_new] = first_on_edge.try_emplace({low, high}, static_cast<int>(fine.positions.size()));
    if (is_new)
      for (int k = 1; k < n; ++k)
        fine.positions.push_back(normalized((n - k) * coarse.positions[low] + k * coarse.positions[high]));
    return entry->second + (a == low ? i : n - i) - 1;
  };
  std::vector<std::vector<int>> rows(n + 1);
  for (const Face& face : coarse.faces) {
    const auto [a, b, c] = face;
    for (int row = 0; row <= n; ++row) {  // row 0 is vertex a, row n is edge b-c
      rows[row].assign(row + 1, 0);
      for (int k = 0; k <= row; ++k) {
        if (row == n) rows[row][k] = on_edge(b, c, k);
        else if (k == 0) rows[row][k] = on_edge(a, b, row);
        else if (k == row) rows[row][k] = on_edge(a, c, row);
        else {
          rows[row][k] = static_cast<int>(fine.positions.size());
          fine.positions.push_back(
              normalized((n - row) * coarse.positions[a] + (row - k) * coarse.positions[b] + k * coarse.positions[c]));
        }
      }
    }
    for (int row = 0; row < n; ++row)
      for (int k = 0; k <= row; ++k) {
        fine.faces.push_back({rows[row][k], rows[row + 1][k], rows[row + 1][k + 1]});
        if (k < row) fine.faces.push_back({rows[row][k], rows[row + 1][k + 1], rows[row][k + 1]});
      }
  }
  return fine;
}

/// Numbers vertices by their first appearance along the faces.
UnitSphere renumbered(const UnitSphere& sphere) {
  UnitSphere result;
  std::vector<int> number(sphere.positions.size(), -1);
  for (Face face : sphere.faces) {
    for (int& v : face) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(result.positions.size());
        result.positions.push_back(sphere.positions[v]);
      }
      v = number[v];
    }
    result.faces.push_back(face);
  }
  return result;
}

}  // namespace

Surface make_icosphere(int frequency, double radius) {
  std::vector<std::string> problems;
  if (frequency < 1 || frequency > 1000)
    problems.push_back("sphere: frequency = " + std::to_string(frequency) + " is not between 1 and 1000");
  if (!(radius > 0) || !std::isfinite(radius))
    problems.push_back("sphere: radius = " + std::to_string(radius) + " is not positive");
  if (!problems.empty()) throw InputError(std::move(problems));

  int halvings = 0, odd = frequency;
  while (odd % 2 == 0) {
    odd /= 2;
    ++halvings;
  }
  UnitSphere sphere = icosahedron();
  if (odd > 1) sphere = split(sphere, odd);
  for (int i = 0; i < halvings; ++i) sphere = split(sphere, 2);
  sphere = renumbered(sphere);
  for (Vec3& x : sphere.positions) x *= radius;
  const int n_vertices = static_cast<int>(sphere.positions.size());
  return {TriangleMesh(n_vertices, std::move(sphere.faces)), std::move(sphere.positions)};
}

}  // namespace pliant
