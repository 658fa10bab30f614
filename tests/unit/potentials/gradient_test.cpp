#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "deformed.hpp"
#include "potentials/potential_set.hpp"

// Each potential against central differences of an energy that is written here from its formula alone, on raw
// triangles.
namespace pliant {
namespace {

using Energy = std::function<double(const std::vector<Vec3>&)>;

double triangle_area(Vec3 a, Vec3 b, Vec3 c) {
  const double p = norm(b - a), q = norm(c - b), r = norm(a - c), s = 0.5 * (p + q + r);
  return std::sqrt(s * (s - p) * (s - q) * (s - r));  // Heron
}

double polyhedron_volume(const TriangleMesh& mesh, const std::vector<Vec3>& x) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.vertices_of_face()) volume += dot(x[a], cross(x[b], x[c])) / 6;
  return volume;
}

double surface_area(const TriangleMesh& mesh, const std::vector<Vec3>& x) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.vertices_of_face()) area += triangle_area(x[a], x[b], x[c]);
  return area;
}

/// Signed angle between the normals of two faces by acos, convex positive.
double fold(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 n1 = normalized(cross(b - a, c - a)), n2 = normalized(cross(a - b, d - b));
  const double angle = std::acos(std::clamp(dot(n1, n2), -1.0, 1.0));
  return dot(n1, d - a) > 0 ? -angle : angle;
}

template <class Potential>
void expect_gradient(const DeformedSurface& surface, const Potential& potential, const Energy& energy) {
  const auto& mesh = surface.mesh;
  const double value = energy(surface.positions);
  EXPECT_NEAR(potential.energy(ShapeState(mesh, surface.positions)), value, 1e-11 * (1 + std::abs(value)));

  const auto forces = forces_of(potential, mesh, surface.positions);
  double largest = 0;
  for (const Vec3& f : forces) largest = std::max(largest, norm(f));
  ASSERT_GT(largest, 0.01);
  constexpr double step = 1e-5;
  auto moved = surface.positions;
  for (std::size_t v = 0; v < moved.size(); ++v)
    for (int d = 0; d < 3; ++d) {
      const double keep = moved[v][d];
      moved[v][d] = keep + step;
      const double ahead = energy(moved);
      moved[v][d] = keep - step;
      const double behind = energy(moved);
      moved[v][d] = keep;
      EXPECT_NEAR(forces[v][d], -(ahead - behind) / (2 * step), 1e-7 * largest + 1e-10 * std::abs(value) / step);
    }

  Vec3 force, torque;
  for (std::size_t v = 0; v < forces.size(); ++v) {
    force += forces[v];
    torque += cross(surface.positions[v], forces[v]);
  }
  EXPECT_LT(norm(force), 1e-13 * largest * static_cast<double>(forces.size()));
  EXPECT_LT(norm(torque), 1e-13 * largest * static_cast<double>(forces.size()) * 5);
}

std::vector<DeformedSurface> all_surfaces() {
  return {deformed_sphere(2, 1), deformed_sphere(3, 2), deformed_patch(3)};
}

TEST(Gradient, EdgeSprings) {
  for (const auto& s : all_surfaces())
    for (double fraction : {1.0, 0.6, 0.0}) {
      const auto springs = EdgeSprings::uniform(s.mesh, s.reference, 3.0, fraction);
      expect_gradient(s, springs, [&](const std::vector<Vec3>& x) {
        double sum = 0;
        for (const auto& [a, b] : s.mesh.vertices_of_edge()) {
          const double l0 = fraction * norm(s.reference[a] - s.reference[b]);
          sum += 1.5 * std::pow(norm(x[a] - x[b]) - l0, 2);
        }
        return sum;
      });
    }
}

TEST(Gradient, BendingAboutAShapeAndAboutFlat) {
  for (const auto& s : all_surfaces())
    for (bool flat : {false, true}) {
      const auto bending = flat ? Bending::about_flat(s.mesh, 2.0) : Bending::about_shape(s.mesh, s.reference, 2.0);
      expect_gradient(s, bending, [&](const std::vector<Vec3>& x) {
        double sum = 0;
        for (const auto& [a, b, c, d] : s.mesh.hinge_of_edge()) {
          if (d < 0) continue;
          const double rest = flat ? 0.0 : fold(s.reference[a], s.reference[b], s.reference[c], s.reference[d]);
          sum += 2.0 * (1 - std::cos(fold(x[a], x[b], x[c], x[d]) - rest));
        }
        return sum;
      });
    }
}

TEST(Gradient, Volume) {
  for (const auto& s : {deformed_sphere(2, 1), deformed_sphere(3, 2)}) {
    const double v0 = polyhedron_volume(s.mesh, s.reference);
    expect_gradient(s, VolumePenalty{50.0, v0}, [&](const std::vector<Vec3>& x) {
      return 25.0 * std::pow((polyhedron_volume(s.mesh, x) - v0) / v0, 2) * v0;
    });
  }
}

TEST(Gradient, Pressure) {
  for (const auto& s : {deformed_sphere(2, 1), deformed_sphere(3, 2)})
    expect_gradient(s, Pressure{3.0}, [&](const std::vector<Vec3>& x) { return -3.0 * polyhedron_volume(s.mesh, x); });
}

/// Principal stretches of a triangle, from the edges of its reference and of its present shape laid out in a plane:
/// F maps one pair of edges on the other.
std::array<double, 2> stretches(const std::array<Vec3, 3>& reference, const std::array<Vec3, 3>& present) {
  const auto flat = [](const std::array<Vec3, 3>& x) {
    const Vec3 along = normalized(x[1] - x[0]), up = x[2] - x[0] - dot(x[2] - x[0], along) * along;
    return std::array<double, 3>{norm(x[1] - x[0]), dot(x[2] - x[0], along), norm(up)};
  };
  const auto [a, b, c] = flat(reference);
  const auto [p, q, r] = flat(present);
  const double f00 = p / a, f01 = (q - f00 * b) / c, f11 = r / c;  // upper triangular
  const double sum = f00 * f00 + f01 * f01 + f11 * f11, product = f00 * f11;
  const double root = std::sqrt(std::max(0.0, 0.25 * sum * sum - product * product));
  return {std::sqrt(0.5 * sum + root), std::sqrt(0.5 * sum - root)};
}

TEST(Gradient, Membranes) {
  const auto energy_of = [](const DeformedSurface& s, auto density) {
    return [&s, density](const std::vector<Vec3>& x) {
      double total = 0;
      for (const auto& [a, b, c] : s.mesh.vertices_of_face()) {
        const auto [l1, l2] = stretches({s.reference[a], s.reference[b], s.reference[c]}, {x[a], x[b], x[c]});
        total += triangle_area(s.reference[a], s.reference[b], s.reference[c]) * density(l1, l2);
      }
      return total;
    };
  };
  for (const auto& s : all_surfaces()) {
    expect_gradient(
        s, Membrane::about_shape(s.mesh, s.reference, NeoHookean{3.0}),
        energy_of(s, [](double l1, double l2) { return 1.5 * (l1 * l1 + l2 * l2 + 1 / (l1 * l1 * l2 * l2) - 3); }));
    expect_gradient(s, Membrane::about_shape(s.mesh, s.reference, Skalak{3.0, 7.0}),
                    energy_of(s, [](double l1, double l2) {
                      const double i1 = l1 * l1 + l2 * l2 - 2, i2 = l1 * l1 * l2 * l2 - 1;
                      return 0.75 * (i1 * i1 + 2 * i1 - 2 * i2 + 7 * i2 * i2);
                    }));
  }
}

TEST(Gradient, AreaPerFace) {
  for (const auto& s : all_surfaces()) {
    FaceAreaPenalty penalty{4.0, {}};
    for (const auto& [a, b, c] : s.mesh.vertices_of_face())
      penalty.reference_area.push_back(triangle_area(s.reference[a], s.reference[b], s.reference[c]));
    expect_gradient(s, penalty, [&](const std::vector<Vec3>& x) {
      double sum = 0;
      for (const auto& [a, b, c] : s.mesh.vertices_of_face()) {
        const double a0 = triangle_area(s.reference[a], s.reference[b], s.reference[c]);
        sum += 2.0 * std::pow((triangle_area(x[a], x[b], x[c]) - a0) / a0, 2) * a0;
      }
      return sum;
    });
  }
}

TEST(Gradient, TotalArea) {
  for (const auto& s : all_surfaces()) {
    const double a0 = 0.8 * surface_area(s.mesh, s.reference);
    expect_gradient(s, TotalAreaPenalty{4.0, a0}, [&](const std::vector<Vec3>& x) {
      return 2.0 * std::pow((surface_area(s.mesh, x) - a0) / a0, 2) * a0;
    });
  }
}

TEST(Gradient, SurfaceTensionWithoutMeshControl) {
  for (const auto& s : all_surfaces())
    expect_gradient(s, SurfaceTension{0.7, 0.0},
                    [&](const std::vector<Vec3>& x) { return 0.7 * surface_area(s.mesh, x); });
}

TEST(Gradient, OfASetIsTheSum) {
  const auto s = deformed_sphere(2, 5);
  PotentialSet set;
  set.add(EdgeSprings::uniform(s.mesh, s.reference, 3.0, 1.0));
  set.add(VolumePenalty{50.0, 3.0});
  std::vector<Vec3> forces(s.positions.size());
  set.add_forces(ShapeState(s.mesh, s.positions), forces);
  const auto springs = forces_of(std::get<EdgeSprings>(set.potentials()[0]), s.mesh, s.positions);
  const auto volume = forces_of(std::get<VolumePenalty>(set.potentials()[1]), s.mesh, s.positions);
  for (std::size_t v = 0; v < forces.size(); ++v) EXPECT_LT(norm(forces[v] - springs[v] - volume[v]), 1e-13);
  const auto energies = set.energies(s.mesh, s.positions);
  ASSERT_EQ(energies.size(), 2u);
  EXPECT_EQ(energies[0].first, "edge");
  EXPECT_EQ(energies[1].first, "volume");
  EXPECT_EQ(set.energy(s.mesh, s.positions), energies[0].second + energies[1].second);
}

}  // namespace
}  // namespace pliant
