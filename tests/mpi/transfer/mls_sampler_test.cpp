#include "transfer/mls_sampler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "core/error.hpp"

namespace pliant {
namespace {

using Formula = std::function<double(Vec3)>;

struct Flow {
  Formula u, v, w, p;
};

struct Fields {
  explicit Fields(const Grid& grid) : u(grid), v(grid), w(grid), p(grid) {}
  Field<FaceX> u;
  Field<FaceY> v;
  Field<FaceZ> w;
  Field<Center> p;
  SampledFields view() const { return {&u, &v, &w, &p}; }
};

// Values of the formulas at all nodes, ghosts included, so that only the interpolation is tested.
Fields make_fields(const Grid& grid, const Flow& flow) {
  Fields f(grid);
  for (int k = -1; k <= grid.nz(); ++k)
    for (int j = -1; j <= grid.ny(); ++j)
      for (int i = -1; i <= grid.nx(); ++i) {
        const Vec3 c{grid.x_center(i), grid.y_center(j), grid.z_center()[k]};
        f.u.view()(i, j, k) = flow.u({grid.x_face(i), c.y, c.z});
        f.v.view()(i, j, k) = flow.v({c.x, grid.y_face(j), c.z});
        f.w.view()(i, j, k) = flow.w({c.x, c.y, grid.z_face()[k]});
        f.p.view()(i, j, k) = flow.p(c);
      }
  return f;
}

BoundaryConfig walls() { return {WallSide{}, WallSide{}, WallSide{}, WallSide{}, WallSide{}, WallSide{}}; }

BoxConfig box(int n, StretchingLaw law) {
  BoxConfig config;
  config.size = {2.0, 1.5, 3.0};
  config.origin = {-1.0, 0.5, -2.0};
  config.cells = {n, n + 1, n + 2};
  config.stretching_z = {law, 1.5};
  return config;
}

// Random points with the corners and the heights of all faces among them, where planes change hands between ranks.
std::vector<Vec3> points_in(const Grid& grid) {
  std::vector<Vec3> points;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto place = [&](double a, double b, double c) {
    const auto o = grid.origin(), s = grid.size();
    points.push_back({o.x + a * s.x, o.y + b * s.y, o.z + c * s.z});
  };
  for (int n = 0; n < 400; ++n) place(unit(random), unit(random), unit(random));
  for (int corner = 0; corner < 8; ++corner) place(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
  for (int k = 0; k < grid.cells()[2]; ++k) {
    points.push_back({grid.origin().x + 0.3, grid.origin().y + 0.2, grid.global_z_face()[k]});
    points.push_back({grid.origin().x + 0.3, grid.origin().y + 0.2, grid.global_z_center()[k]});
  }
  return points;
}

struct Errors {
  double value = 0, gradient = 0, pressure = 0;
};

Errors largest_errors(const Grid& grid, const Flow& flow, double density) {
  const auto fields = make_fields(grid, flow);
  const MlsSampler sampler(grid, fields.view(), density);
  const auto points = points_in(grid);
  std::vector<FlowSample> samples(points.size());
  sampler.sample(points, samples);
  Errors errors;
  const Formula* formulas[] = {&flow.u, &flow.v, &flow.w};
  for (std::size_t n = 0; n < points.size(); ++n) {
    for (int c = 0; c < 3; ++c) {
      const auto& f = *formulas[c];
      errors.value = std::max(errors.value, std::abs(samples[n].velocity[c] - f(points[n])));
      for (int d = 0; d < 3; ++d) {
        const double h = 1e-3;
        Vec3 a = points[n], b = points[n], aa = a, bb = b;
        a[d] -= h, b[d] += h, aa[d] -= 2 * h, bb[d] += 2 * h;
        const double exact = (8 * (f(b) - f(a)) - (f(bb) - f(aa))) / (12 * h);
        errors.gradient = std::max(errors.gradient, std::abs(samples[n].gradient[c][d] - exact));
      }
    }
    errors.pressure = std::max(errors.pressure, std::abs(samples[n].pressure - density * flow.p(points[n])));
  }
  return errors;
}

Flow linear_flow() {
  return {[](Vec3 x) { return 1 + 2 * x.x - 3 * x.y + 4 * x.z; }, [](Vec3 x) { return -2 + x.x + 5 * x.y - x.z; },
          [](Vec3 x) { return 3 - x.x + 2 * x.y - 7 * x.z; }, [](Vec3 x) { return 0.5 + x.x + x.y + x.z; }};
}

// Periodic in all directions over the box of `box`.
Flow smooth_flow() {
  const auto wave = [](Vec3 x, double a) {
    return std::sin(M_PI * x.x + a) * std::cos(2 * M_PI / 1.5 * x.y - a) + std::sin(2 * M_PI / 3 * x.z + 2 * a);
  };
  return {[=](Vec3 x) { return wave(x, 0.1); }, [=](Vec3 x) { return wave(x, 0.7); },
          [=](Vec3 x) { return wave(x, 1.3); }, [=](Vec3 x) { return wave(x, 2.0); }};
}

TEST(MlsSampler, GivesLinearFieldsExactlyUpToTheWalls) {
  for (const auto law : {StretchingLaw::uniform, StretchingLaw::tanh}) {
    const Grid grid(box(6, law), walls(), Communicator());
    const auto errors = largest_errors(grid, linear_flow(), 2.5);
    EXPECT_LT(errors.value, 1e-13);
    EXPECT_LT(errors.gradient, 1e-11) << "the reference difference itself rounds at 1e-12";
    EXPECT_LT(errors.pressure, 1e-13);
  }
}

TEST(MlsSampler, GivesLinearGradientsToRoundOff) {
  const Mat3 slopes{{{2, -3, 4}, {1, 5, -1}, {-1, 2, -7}}};
  for (const auto law : {StretchingLaw::uniform, StretchingLaw::tanh}) {
    const Grid grid(box(6, law), walls(), Communicator());
    const auto fields = make_fields(grid, linear_flow());
    const auto points = points_in(grid);
    std::vector<FlowSample> samples(points.size());
    MlsSampler(grid, fields.view(), 1.0).sample(points, samples);
    for (const auto& sample : samples)
      for (int c = 0; c < 3; ++c) EXPECT_LT(norm(sample.gradient[c] - slopes[c]), 2e-12);
  }
}

TEST(MlsSampler, ConvergesOnSmoothPeriodicFields) {
  for (const auto law : {StretchingLaw::uniform, StretchingLaw::tanh}) {
    const Grid coarse(box(24, law), BoundaryConfig{}, Communicator());
    const Grid fine(box(48, law), BoundaryConfig{}, Communicator());
    const auto a = largest_errors(coarse, smooth_flow(), 1.0);
    const auto b = largest_errors(fine, smooth_flow(), 1.0);
    // Order 2 for the value and 1 for the gradient; the maximum over fixed points scatters a little.
    EXPECT_GT(std::log2(a.value / b.value), 1.7);
    EXPECT_GT(std::log2(a.gradient / b.gradient), 0.8);
    EXPECT_LT(b.value, 1e-2);
  }
}

TEST(MlsSampler, BringsPointsBackIntoAPeriodicBox) {
  const Grid grid(box(12, StretchingLaw::uniform), BoundaryConfig{}, Communicator());
  const auto fields = make_fields(grid, smooth_flow());
  const MlsSampler sampler(grid, fields.view(), 1.0);
  const std::vector<Vec3> points{{0.3, 1.1, -0.4}, {0.3 + 2.0, 1.1 - 1.5, -0.4 + 6.0}};
  std::vector<FlowSample> samples(2);
  sampler.sample(points, samples);
  EXPECT_NEAR(norm(samples[0].velocity - samples[1].velocity), 0, 1e-13);
}

TEST(MlsSampler, DoesNotDependOnTheNumberOfRanks) {
  const auto config = box(9, StretchingLaw::tanh);
  const Grid shared(config, walls(), Communicator());
  const Grid alone(config, walls(), Communicator(MPI_COMM_SELF));
  const auto shared_fields = make_fields(shared, smooth_flow());
  const auto own_fields = make_fields(alone, smooth_flow());
  const auto points = points_in(shared);
  std::vector<FlowSample> a(points.size()), b(points.size());
  MlsSampler(shared, shared_fields.view(), 1.0).sample(points, a);
  MlsSampler(alone, own_fields.view(), 1.0).sample(points, b);
  for (std::size_t n = 0; n < points.size(); ++n) {
    EXPECT_EQ(a[n].velocity, b[n].velocity);
    for (int d = 0; d < 3; ++d) EXPECT_EQ(a[n].gradient[d], b[n].gradient[d]);
    EXPECT_EQ(a[n].pressure, b[n].pressure);
  }
}

TEST(MlsSampler, RefusesPointsThatAreNowhere) {
  const Grid grid(box(6, StretchingLaw::uniform), walls(), Communicator());
  const auto fields = make_fields(grid, linear_flow());
  const MlsSampler sampler(grid, fields.view(), 1.0);
  std::vector<FlowSample> sample(1);
  const std::vector<Vec3> outside{{0, 1, 1.1}}, nowhere{{std::numeric_limits<double>::quiet_NaN(), 1, 0}};
  EXPECT_THROW(sampler.sample(outside, sample), RunError);
  EXPECT_THROW(sampler.sample(nowhere, sample), RunError);
}

}  // namespace
}  // namespace pliant
