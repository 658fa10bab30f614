#include <gtest/gtest.h>

#include <cmath>

#include "boundary/fill_ghosts.hpp"
#include "core/error.hpp"
#include "transfer/direct_forcing.hpp"
#include "transfer/interpolate.hpp"
#include "transfer/spread.hpp"
#include "unit/transfer/transfer_fixture.hpp"

namespace pliant::test {
namespace {

constexpr StretchingLaw laws[] = {StretchingLaw::uniform, StretchingLaw::tanh};

double linear(int component, Vec3 x) {
  const Vec3 slopes[] = {{2, -3, 4}, {1, 5, -1}, {-1, 2, -7}};
  return component + dot(slopes[component], x);
}

// All points, and the corners, sides and heights of all faces and centres, where planes change hands between ranks.
std::vector<Vec3> points_everywhere(const Grid& grid) {
  auto points = random_points(grid, 500);
  for (int k = 0; k < grid.cells()[2]; ++k) {
    points.push_back({0.3, 0.7, grid.global_z_face()[k]});
    points.push_back({-0.9999, 1.9999, grid.global_z_center()[k]});
  }
  return points;
}

// Components of all markers on every rank; those of other ranks are zero before the sum.
std::vector<double> collect(const Markers& markers, const MarkerVectors& values, std::size_t n) {
  std::vector<double> all(3 * n, 0.0);
  for (int c = 0; c < 3; ++c)
    for (std::size_t m = 0; m < markers.indices().size(); ++m)
      all[3 * static_cast<std::size_t>(markers.indices()[m]) + static_cast<std::size_t>(c)] +=
          markers.share(c)[m] * values[c][m];
  markers.grid().ranks().sum(all);
  return all;
}

TEST(Markers, HaveExactlyOneRankForEveryPart) {
  for (const auto& sides : {BoundaryConfig{}, walls()})
    for (const auto law : laws) {
      const Grid grid(box_of(8, law), sides, Communicator());
      const auto points = points_everywhere(grid);
      Markers markers(grid);
      markers.place(points, std::vector<double>(points.size(), 0.01));
      MarkerVectors ones;
      ones.assign(markers.padded_size());
      for (auto& c : ones.components) std::fill(c.begin(), c.end(), 1.0);
      for (double parts : collect(markers, ones, points.size())) ASSERT_EQ(parts, 1.0);
    }
}

TEST(Markers, RefuseWhatIsOutsideAndBoxesThatAreTooThin) {
  const Grid grid(box_of(8, StretchingLaw::uniform), walls(), Communicator());
  Markers markers(grid);
  const std::vector<Vec3> outside{{0, 1, 0}, {0, 1, 1.1}};
  EXPECT_THROW(markers.place(outside, std::vector<double>(2, 1.0)), RunError);
  BoxConfig thin;
  thin.cells = {8, 2, 8};
  EXPECT_THROW(Markers(Grid(thin, walls(), Communicator())), InputError);
  EXPECT_NO_THROW(Markers(Grid(thin, BoundaryConfig{}, Communicator())));
}

TEST(Interpolate, GivesLinearFieldsExactlyEverywhere) {
  for (const auto& sides : {BoundaryConfig{}, walls()})
    for (const auto law : laws) {
      const Grid grid(box_of(8, law), sides, Communicator());
      // A linear field has no periodic ghosts: next to periodic sides it is looked at in the next test.
      const auto points = grid.is_periodic(0) ? random_points(grid, 500, 0.15) : points_everywhere(grid);
      VelocityFields f(grid);
      set_velocity(grid, f, linear);
      Markers markers(grid);
      markers.place(points, std::vector<double>(points.size(), 0.01));
      MarkerVectors found;
      found.assign(markers.padded_size());
      interpolate(markers, f.u.view(), f.v.view(), f.w.view(), found);
      const auto all = collect(markers, found, points.size());
      for (std::size_t n = 0; n < points.size(); ++n)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(all[3 * n + static_cast<std::size_t>(c)], linear(c, points[n]), 1e-12);
    }
}

TEST(Interpolate, DoesNotSeePeriodicSidesOrRanks) {
  // The same field and points, moved by a part of the box along every periodic direction.
  const Grid grid(box_of(8, StretchingLaw::uniform), BoundaryConfig{}, Communicator());
  const Vec3 shift{3 * grid.dx(), -4 * grid.dy(), 5 * grid.size().z / grid.cells()[2]};
  const auto wave = [](int c, Vec3 x) {
    return std::sin(M_PI * x.x + c) * std::cos(2 * M_PI / 1.5 * x.y - c) + std::sin(2 * M_PI / 3 * x.z + 2 * c);
  };
  auto points = points_everywhere(grid);
  std::vector<std::vector<double>> results;
  for (const Vec3 by : {Vec3{}, shift}) {
    VelocityFields f(grid);
    set_velocity(grid, f, [&](int c, Vec3 x) { return wave(c, x - by); });
    auto moved = points;
    for (Vec3& x : moved) x += by;
    Markers markers(grid);
    markers.place(moved, std::vector<double>(points.size(), 0.01));
    MarkerVectors found;
    found.assign(markers.padded_size());
    interpolate(markers, f.u.view(), f.v.view(), f.w.view(), found);
    results.push_back(collect(markers, found, points.size()));
  }
  // Points half-way between nodes may take either side's nodes: those on faces and centres are not among the random.
  for (std::size_t n = 0; n < 3 * 500; ++n) EXPECT_NEAR(results[0][n], results[1][n], 1e-12);
}

struct Loads {
  Vec3 force, torque;
};

Vec3 force_of(std::size_t n) {
  const auto x = static_cast<double>(n);
  return {std::sin(x), std::cos(2.1 * x), std::sin(3.7 * x + 1)};
}

// Markers' forces against the nodes' after spreading; torques about the origin.
struct Balance {
  Loads markers, nodes;
  double scale = 0;  // of the torque: sum of |x x F|
};

Balance balance(const Grid& grid, std::span<const Vec3> points) {
  Markers markers(grid);
  std::vector<double> areas;
  for (std::size_t n = 0; n < points.size(); ++n) areas.push_back(0.01 + 0.001 * static_cast<double>(n % 7));
  markers.place(points, areas);
  ForceFields fields(grid);
  fields.reach(markers);
  MarkerVectors forces;
  forces.assign(markers.padded_size());
  Balance b;
  double sums[13] = {};
  for (std::size_t m = 0; m < markers.indices().size(); ++m) {
    const auto n = static_cast<std::size_t>(markers.indices()[m]);
    Vec3 part;
    for (int c = 0; c < 3; ++c) {
      forces[c][m] = force_of(n)[c];
      part[c] = markers.volume(c)[m] * forces[c][m];
    }
    const Vec3 torque = cross(points[n], part);
    for (int c = 0; c < 3; ++c) sums[c] += part[c], sums[3 + c] += torque[c];
    sums[12] += norm(torque);
  }
  spread(markers, forces, fields);
  fields.gather();
  for_each_node(grid, 0, [&](int c, int i, int j, int k, Vec3 x) {
    Vec3 f;
    f[c] = (c == 0   ? fields.x()(i, j, k)
            : c == 1 ? fields.y()(i, j, k)
                     : fields.z()(i, j, k)) *
           node_volume(grid, c, k);
    const Vec3 torque = cross(x, f);
    for (int d = 0; d < 3; ++d) sums[6 + d] += f[d], sums[9 + d] += torque[d];
  });
  grid.ranks().sum(sums);
  b.markers = {{sums[0], sums[1], sums[2]}, {sums[3], sums[4], sums[5]}};
  b.nodes = {{sums[6], sums[7], sums[8]}, {sums[9], sums[10], sums[11]}};
  b.scale = sums[12];
  return b;
}

TEST(Spread, ConservesForce) {
  // At walls the faces on the sides themselves lie outside the nodes that are summed: keep away from them.
  for (const auto& sides : {BoundaryConfig{}, walls()})
    for (const auto law : laws) {
      const Grid grid(box_of(8, law), sides, Communicator());
      const auto points = grid.is_periodic(0) ? points_everywhere(grid) : random_points(grid, 500, 0.25);
      const auto b = balance(grid, points);
      EXPECT_LT(norm(b.markers.force - b.nodes.force), 1e-13 * b.scale);
    }
}

TEST(Spread, ConservesTorque) {
  const Grid uniform(box_of(16, StretchingLaw::uniform), walls(), Communicator());
  const auto a = balance(uniform, random_points(uniform, 500, 0.15));
  EXPECT_LT(norm(a.markers.torque - a.nodes.torque), 1e-13 * a.scale);

  // Neighbouring cells differ by 10 % where the stretching is strongest.
  BoxConfig config = box_of(16, StretchingLaw::tanh, 0.74);
  const Grid stretched(config, walls(), Communicator());
  double growth = 0;
  for (int k = 1; k < config.cells[2]; ++k)
    growth = std::max(growth, std::abs(stretched.global_dz_c()[k] / stretched.global_dz_c()[k - 1] - 1));
  EXPECT_NEAR(growth, 0.1, 0.02);
  const auto b = balance(stretched, random_points(stretched, 500, 0.15));
  EXPECT_LT(norm(b.markers.torque - b.nodes.torque), 0.005 * norm(b.markers.torque));
}

// A sphere of markers, as a spiral: radius 0.4 around `center`.
struct Sphere {
  std::vector<Vec3> points;
  std::vector<double> areas;
  explicit Sphere(Vec3 center, int n = 900) {
    for (int i = 0; i < n; ++i) {
      const double z = 1 - (2 * i + 1.0) / n, r = std::sqrt(1 - z * z), a = M_PI * (1 + std::sqrt(5.0)) * i;
      points.push_back(center + 0.4 * Vec3{r * std::cos(a), r * std::sin(a), z});
      areas.push_back(4 * M_PI * 0.16 / n);
    }
  }
};

double oncoming(int component, Vec3 x) {
  return component == 0 ? 1 + 0.1 * std::sin(2 * M_PI / 3 * x.z) : 0.2 * component;
}

struct Forced {
  double slip = 0;
  Vec3 given, forces;  // momentum given to the fluid, force on the markers times the step
  std::vector<double> u;
};

Forced force_sphere(const Grid& grid, int iterations, Vec3 center) {
  const double dt = 0.02, density = 1.7;
  VelocityFields f(grid);
  set_velocity(grid, f, oncoming);
  const Sphere sphere(center);
  DirectForcing forcing(grid, density, iterations);
  forcing.place(sphere.points, sphere.areas, std::vector<Vec3>(sphere.points.size()));
  const auto momentum = [&] {
    double sums[3] = {};
    for_each_node(grid, 0, [&](int c, int i, int j, int k, Vec3) {
      const double value = c == 0 ? f.u.view()(i, j, k) : c == 1 ? f.v.view()(i, j, k) : f.w.view()(i, j, k);
      sums[c] += density * value * node_volume(grid, c, k);
    });
    grid.ranks().sum(sums);
    return Vec3{sums[0], sums[1], sums[2]};
  };
  const Vec3 before = momentum();
  SlabHalo halo(grid.ranks(), SlabHalo::Ends::periodic, grid.nz());
  const double alphas[] = {8.0 / 15, 2.0 / 15, 1.0 / 3};
  Forced result;
  for (int l = 0; l < 3; ++l) {
    forcing.apply({l, 0, 0, alphas[l]}, dt, f.u.view(), f.v.view(), f.w.view());
    // As the flow solver does after the hook, less the projection.
    for (int k = 0; k < grid.nz(); ++k) {
      fill_periodic_ghosts(f.u.view(), grid, k);
      fill_periodic_ghosts(f.v.view(), grid, k);
      fill_periodic_ghosts(f.w.view(), grid, k);
    }
    halo.fill({plane_stack(f.u), plane_stack(f.v), plane_stack(f.w)});
    if (l == 0) result.slip = forcing.rms_slip(f.u.view(), f.v.view(), f.w.view());
  }
  result.given = momentum() - before;
  std::vector<Vec3> forces(sphere.points.size());
  forcing.add_forces(forces);
  double sums[3] = {};
  for (Vec3 x : forces)
    for (int c = 0; c < 3; ++c) sums[c] += dt * x[c];
  grid.ranks().sum(sums);
  result.forces = {sums[0], sums[1], sums[2]};
  for_each_node(grid, 0, [&](int c, int i, int j, int k, Vec3) {
    if (c == 0) result.u.push_back(f.u.view()(i, j, k));
    if (c == 1) result.u.push_back(f.v.view()(i, j, k));
    if (c == 2) result.u.push_back(f.w.view()(i, j, k));
  });
  return result;
}

BoxConfig forcing_box(StretchingLaw law) {
  auto box = box_of(24, law, 1.0);
  box.cells = {32, 24, 48};
  return box;
}

TEST(DirectForcing, SlipFallsWithIterationsAndMomentumIsGivenByTheMarkers) {
  const Grid grid(forcing_box(StretchingLaw::uniform), BoundaryConfig{}, Communicator());
  for (const Vec3 center :
       {Vec3{0.01, 1.23, -0.52}, Vec3{0.99, 0.52, -1.97}}) {  // inside, and across all periodic sides
    double last = 1;
    for (int iterations : {1, 2, 4, 8}) {
      const auto result = force_sphere(grid, iterations, center);
      EXPECT_LT(result.slip, 0.8 * last) << iterations << " iterations";
      last = result.slip;
      EXPECT_LT(norm(result.given + result.forces), 1e-12 * norm(result.given));
      EXPECT_LT(result.given.x, 0) << "the sphere holds the fluid back";
    }
  }
}

// The whole solver: in a periodic box nothing but the markers changes the fluid's momentum.
TEST(DirectForcing, HoldsAFixedSphereInTheFlow) {
  const Grid grid(forcing_box(StretchingLaw::uniform), BoundaryConfig{}, Communicator());
  FlowParameters parameters;
  parameters.density = 1.7;
  parameters.viscosity = 5e-3;
  InitialConfig initial;
  initial.flow = InitialFlow::uniform;
  initial.velocity = {1, 0.2, 0.4};
  const Sphere sphere({0.01, 1.23, -0.52});
  const double dt = 0.02;
  double last = 1;
  for (int iterations : {1, 2, 4}) {
    FlowSolver solver(grid, parameters);
    set_initial_flow(solver, initial);
    DirectForcing forcing(grid, parameters.density, iterations);
    forcing.place(sphere.points, sphere.areas, std::vector<Vec3>(sphere.points.size()));
    const auto hook = [&](const Substep& s, double step, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
      forcing.apply(s, step, u, v, w);
    };
    for (int n = 0; n < 30; ++n) {
      const Vec3 before = solver.bulk_velocity();
      solver.advance(dt, hook);
      std::vector<Vec3> forces(sphere.points.size());
      forcing.add_forces(forces);
      double sums[3] = {};
      for (Vec3 f : forces)
        for (int c = 0; c < 3; ++c) sums[c] += dt * f[c];
      grid.ranks().sum(sums);
      const Vec3 given = parameters.density * grid.volume() * (solver.bulk_velocity() - before);
      EXPECT_LT(norm(given + Vec3{sums[0], sums[1], sums[2]}), 1e-11 * norm(given));
    }
    const auto& flow = solver.state();
    const double slip = forcing.rms_slip(flow.u.view(), flow.v.view(), flow.w.view());
    EXPECT_LT(slip, 0.8 * last) << iterations << " iterations";
    EXPECT_LT(slip, 0.03) << "of the speed far away, once the impulse of the start is over";
    last = slip;
  }
}

TEST(DirectForcing, IsTheSameOnAllNumbersOfRanksAndAtEveryRun) {
  for (const auto law : laws) {
    const Grid shared(forcing_box(law), BoundaryConfig{}, Communicator());
    const Grid alone(forcing_box(law), BoundaryConfig{}, Communicator(MPI_COMM_SELF));
    const Vec3 center{0.99, 0.52, -1.97};
    const auto a = force_sphere(shared, 3, center), again = force_sphere(shared, 3, center);
    const auto b = force_sphere(alone, 3, center);
    EXPECT_EQ(a.u, again.u);
    const std::size_t begin = 3 * static_cast<std::size_t>(shared.slab().begin) *
                              static_cast<std::size_t>(shared.nx()) * static_cast<std::size_t>(shared.ny());
    double difference = 0;
    for (std::size_t n = 0; n < a.u.size(); ++n) difference = std::max(difference, std::abs(a.u[n] - b.u[begin + n]));
    EXPECT_LT(difference, 1e-11);
    EXPECT_NEAR(a.slip, b.slip, 1e-11);
  }
}

}  // namespace
}  // namespace pliant::test
