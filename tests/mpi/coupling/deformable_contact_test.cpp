#include <gtest/gtest.h>

#include "coupling/advance_body.hpp"
#include "coupling/contact.hpp"
#include "mesh/box_cells.hpp"
#include "mesh/crossing.hpp"
#include "mesh/distance.hpp"
#include "mpi/coupling/small_cases.hpp"
#include "structure/advance_vertices.hpp"
#include "structure/stable_time_step.hpp"

// Elastic balls that are thrown at each other and at rigid ones, in no fluid, on any ranks and through periodic sides:
// no vertex of one comes into another, and contact adds no momentum.
namespace pliant {
namespace {

constexpr double radius = 0.4;

BodyConfig soft(const std::string& name, Vec3 center, double stiffness) {
  auto body = ball(name, MotionKind::deformable, center, radius);
  body.surface = SphereSurface{4, radius};
  body.coupling = CouplingKind::one_way;
  body.mass_per_vertex = 0.01;
  body.traction.form = TractionForm::none;
  body.potentials.edge = EdgeConfig{stiffness, 1.0};
  body.potentials.bending = BendingConfig{0.02 * stiffness, ReferenceAngle::initial};
  body.potentials.volume = VolumeConfig{20 * stiffness};
  return body;
}

BodyConfig hard(const std::string& name, Vec3 center, Vec3 velocity) {
  auto body = ball(name, MotionKind::rigid, center, radius);
  body.surface = SphereSurface{3, radius};
  body.material.mass = 2;
  body.rigid.velocity = velocity;
  return body;
}

struct Scene {
  CaseConfig config;
  std::vector<Vec3> velocities;  // of the bodies at the start
  int steps = 100;
};

/// What is to be seen of the bodies after a step.
struct Seen {
  std::vector<std::vector<Vec3>> positions;  // by body
  Vec3 momentum;
};

class Collision {
 public:
  Collision(const Scene& scene, const Communicator& ranks)
      : scene_(scene),
        grid_(scene.config.box, scene.config.boundary, ranks),
        bodies_(scene.config, grid_),
        contact_(grid_, scene.config) {
    for (Body& body : bodies_.own())
      if (!bodies_.kind_of(body).has_pose())
        std::fill(body.surface.velocities.begin(), body.surface.velocities.end(),
                  scene.velocities[static_cast<std::size_t>(body.id)]);
  }

  void advance(double step) {
    contact_.find(bodies_);
    for (Body& body : bodies_.own())
      if (bodies_.kind_of(body).has_pose()) advance_free(body, bodies_.kind_of(body), body.loads.contact, step);
    contact_.begin(bodies_, step, PosedBodies::at_its_end);
    for (Body& body : bodies_.own()) {
      if (bodies_.kind_of(body).has_pose()) continue;
      auto& surface = body.surface;
      const int substeps = std::max(1, static_cast<int>(std::ceil(step / (0.5 * stable_time_step(surface, {})))));
      VertexLoads loads;
      loads.assign(surface.positions.size());
      ShapeState shape(surface.mesh);
      for (int i = 0; i < substeps; ++i) {
        shape.update(surface.positions);
        advance_vertices(surface, shape, loads, step / substeps, *contact_.of(body), i * step / substeps);
      }
    }
    contact_.end(bodies_, step);
    bodies_.migrate();
  }

  const Bodies& bodies() const { return bodies_; }

  Seen look() const {
    Seen seen;
    const auto numbers = gather_bodies(
        bodies_, [](const BodyKind& kind) { return 3 * kind.prototype.positions.size(); },
        [](const Body& body) {
          std::vector<double> xyz;
          for (const Vec3 x : body.surface.positions) xyz.insert(xyz.end(), {x.x, x.y, x.z});
          return xyz;
        });
    std::size_t at = 0;
    for (const auto& kind : bodies_.kinds()) {
      auto& positions = seen.positions.emplace_back();
      for (std::size_t v = 0; v < kind.prototype.positions.size(); ++v, at += 3)
        positions.push_back({numbers[at], numbers[at + 1], numbers[at + 2]});
    }
    for (const Vec3 p : all_vectors(bodies_, [&](const Body& body) {
           const auto& kind = bodies_.kind_of(body);
           // What deformable bodies pressed on it in the last step has not moved it yet.
           if (kind.has_pose()) return kind.mass * body.pose.velocity + last_step_ * body.loads.pressed.force;
           Vec3 sum;
           for (std::size_t v = 0; v < body.surface.masses.size(); ++v)
             sum += body.surface.masses[v] * body.surface.velocities[v];
           return sum;
         }))
      seen.momentum += p;
    return seen;
  }

  void set_last_step(double step) { last_step_ = step; }

 private:
  Scene scene_;
  Grid grid_;
  Bodies bodies_;
  Contact contact_;
  double last_step_ = 0;
};

/// How near to each other bodies must have come at least: the nearest vertices of the first two.
double distance_between(const Seen& seen, Vec3 box) {
  double least = 1e300;
  for (const Vec3 a : seen.positions[0])
    for (const Vec3 b : seen.positions[1]) {
      Vec3 d = a - b;
      for (int c = 0; c < 3; ++c) d[c] -= box[c] * std::round(d[c] / box[c]);
      least = std::min(least, norm(d));
    }
  return least;
}

void expect_apart(const Bodies& bodies, const Seen& seen, Vec3 box, int step) {
  for (std::size_t a = 0; a < seen.positions.size(); ++a)
    for (std::size_t b = 0; b < seen.positions.size(); ++b) {
      if (a == b) continue;
      auto moved = seen.positions[b];
      const Vec3 apart = mean_position(seen.positions[a]) - mean_position(moved);
      for (Vec3& x : moved)
        for (int d = 0; d < 3; ++d) x[d] += box[d] * std::round(apart[d] / box[d]);
      const auto& mesh = bodies.kinds()[b].prototype.mesh;
      const Box around = box_around(moved);
      for (const Vec3 x : seen.positions[a])
        if (around.meets({x, x})) {
          ASSERT_LT(winding_number(x, mesh, moved), 0.5)
              << "a vertex of body " << a << " is in " << b << " at " << step;
        }
      ASSERT_FALSE(find_crossing({bodies.kinds()[a].prototype.mesh, seen.positions[a]}, {mesh, moved}, 0)) << step;
    }
}

void expect_no_crossing(const Scene& scene) {
  constexpr double step = 0.02;
  Collision together(scene, Communicator()), alone(scene, Communicator(MPI_COMM_SELF));
  const Vec3 momentum = together.look().momentum;
  double nearest = 1;
  for (int n = 0; n < scene.steps; ++n) {
    together.advance(step);
    together.set_last_step(step);
    const auto seen = together.look();
    EXPECT_LT(norm(seen.momentum - momentum), 1e-12 * (1 + norm(momentum))) << "step " << n;
    nearest = std::min(nearest, distance_between(seen, scene.config.box.size));
    expect_apart(together.bodies(), seen, scene.config.box.size, n);
    if (testing::Test::HasFatalFailure()) return;
    if (n >= 40) continue;
    alone.advance(step);
    const auto single = alone.look();
    double off = 0;
    for (std::size_t b = 0; b < seen.positions.size(); ++b)
      for (std::size_t v = 0; v < seen.positions[b].size(); ++v)
        off = std::max(off, norm(seen.positions[b][v] - single.positions[b][v]));
    EXPECT_LT(off, 1e-11) << "step " << n;
  }
  EXPECT_LT(nearest, scene.config.repulsion.range) << "they have met";
}

Scene two_balls(Vec3 middle, Vec3 offset, double stiffness) {
  Scene scene;
  scene.config = small_box({12, 12, 12});
  scene.config.repulsion = {0.1, 5};
  const Vec3 apart = 0.5 * offset + Vec3{0, 0, 0.5};
  scene.config.bodies = {soft("lower", middle - apart, stiffness), soft("upper", middle + apart, stiffness)};
  scene.velocities = {{0, 0, 1}, {0, 0, -1}};
  return scene;
}

TEST(DeformableContact, BallsHeadOn) { expect_no_crossing(two_balls({0.02, 0.01, 0.03}, {}, 5)); }
TEST(DeformableContact, BallsOffCentre) { expect_no_crossing(two_balls({0, 0, 0}, {0.25, 0.3, 0}, 5)); }
TEST(DeformableContact, StiffBalls) { expect_no_crossing(two_balls({0, 0, 0.5}, {0.1, 0, 0}, 500)); }

TEST(DeformableContact, AcrossAPeriodicSideAndOnTheMove) {
  auto scene = two_balls({1.9, 1.95, 1.97}, {0.1, 0.1, 0}, 5);
  for (Vec3& v : scene.velocities) v += Vec3{3, 2, 4};
  expect_no_crossing(scene);
}

TEST(DeformableContact, OfUnequalMassAndMesh) {
  auto scene = two_balls({0, 0, 0}, {0.1, 0.2, 0}, 5);
  scene.config.bodies[1].surface = SphereSurface{6, radius};
  scene.config.bodies[1].mass_per_vertex = 0.002;
  expect_no_crossing(scene);
}

TEST(DeformableContact, SoftAgainstRigid) {
  auto scene = two_balls({0, 0, 0}, {0.1, 0.2, 0}, 20);
  scene.config.bodies[1] = hard("upper", {0.05, 0.1, 0.5}, {0, 0, -1});
  expect_no_crossing(scene);
}

TEST(DeformableContact, ThreeInARow) {
  auto scene = two_balls({0, 0, 0}, {}, 20);
  scene.config.bodies[0].center = {0, 0, -1};
  scene.config.bodies[1].center = {0.1, 0, 0};
  scene.config.bodies.push_back(soft("third", {0, 0.1, 1}, 20));
  scene.velocities = {{0, 0, 1.5}, {0, 0, 0}, {0, 0, -1.5}};
  expect_no_crossing(scene);
}

}  // namespace
}  // namespace pliant
