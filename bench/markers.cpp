#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "transfer/direct_forcing.hpp"
#include "transfer/interpolate.hpp"
#include "transfer/spread.hpp"
#include "unit/transfer/generic_mls.hpp"

// The transfer between flow and markers; items are markers, so the inverse of items_per_second is the time of a marker.
// `step` is the unit of the tables: stencils, three interpolations and three spreads of a vector, and one probe with
// pressure and nine gradients.
namespace pliant {
namespace {

constexpr double step_weights[] = {8.0 / 15, 2.0 / 15, 1.0 / 3};

// Spheres of radius a tenth of the box at random places, until there are enough markers. As on a subdivided body, the
// markers of a sphere follow each other in space.
std::vector<Vec3> markers_on_spheres(int n) {
  constexpr int a_sphere = 5000;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> points;
  Vec3 center;
  for (int m = 0; m < n; ++m) {
    const int i = m % a_sphere;
    if (i == 0) center = {unit(random), unit(random), unit(random)};
    const double z = 1 - (2 * i + 1.0) / a_sphere, r = std::sqrt(1 - z * z), a = M_PI * (1 + std::sqrt(5.0)) * i;
    points.push_back(center + 0.1 * Vec3{r * std::cos(a), r * std::sin(a), z});
  }
  return points;
}

struct Box {
  Box(int n, StretchingLaw law, int markers)
      : grid(config(n, law), sides(law), Communicator(MPI_COMM_SELF)), u(grid), v(grid), w(grid), p(grid) {
    points = markers_on_spheres(markers);
    if (law != StretchingLaw::uniform)  // bounded in z: keep away from the sides
      for (Vec3& x : points) x.z = 0.1 + 0.8 * (x.z - std::floor(x.z));
    for (Vec3 x : points) ends.push_back(x + Vec3{0.3 / n, -0.5 / n, 0.8 / n});
    areas.assign(points.size(), 1.0 / (n * n));
    velocities.resize(points.size());
    double value = 0;
    for (int k = -1; k <= n; ++k)
      for (int j = -1; j <= n; ++j)
        for (int i = -1; i <= n; ++i) {
          value = std::fmod(value + 0.37, 1.0);
          u.view()(i, j, k) = v.view()(i, j, k) = w.view()(i, j, k) = p.view()(i, j, k) = value;
        }
  }
  static BoxConfig config(int n, StretchingLaw law) {
    BoxConfig box;
    box.cells = {n, n, n};
    box.stretching_z = {law, 1.0};
    return box;
  }
  static BoundaryConfig sides(StretchingLaw law) {
    BoundaryConfig all;
    if (law != StretchingLaw::uniform) all[4] = all[5] = WallSide{};
    return all;
  }
  ProbedFields fields() const { return {u.view(), v.view(), w.view(), p.view()}; }
  Grid grid;
  Field<FaceX> u;
  Field<FaceY> v;
  Field<FaceZ> w;
  Field<Center> p;
  std::vector<Vec3> points, ends, velocities;
  std::vector<double> areas;
};

Box box_of(const benchmark::State& state) {
  return Box(static_cast<int>(state.range(0)), static_cast<StretchingLaw>(state.range(1)),
             static_cast<int>(state.range(2)));
}

void count_markers(benchmark::State& state) {
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * state.range(2));
}

// In the order in which the markers' own forcing left them, which is how a body's probes would be asked.
void probe_all_markers(const Box& box, const MlsShape& shape, std::span<const Vec3> points, double& sum) {
  StencilBatch stencils;
  SlopeBatch slopes;
  ProbeBatch result;
  std::array<Vec3, mls_batch> batch;
  for (std::size_t begin = 0; begin < points.size(); begin += mls_batch) {
    const std::size_t count = std::min<std::size_t>(mls_batch, points.size() - begin);
    for (std::size_t l = 0; l < count; ++l) {
      batch[l] = points[begin + l];
      shape.bring_into_box(batch[l]);
    }
    shape.evaluate(std::span(batch).first(count), stencils, slopes);
    probe(box.fields(), stencils, slopes, static_cast<int>(count), result);
    sum += result.pressure[0] + result.gradient[2][2][count - 1];
  }
}

std::vector<Vec3> in_working_order(const Markers& markers, std::span<const Vec3> points) {
  std::vector<Vec3> sorted;
  for (int m : markers.indices()) sorted.push_back(points[static_cast<std::size_t>(m)]);
  return sorted;
}

void step(benchmark::State& state) {
  Box box = box_of(state);
  const MlsShape shape(box.grid);
  DirectForcing forcing(box.grid, 1.0);
  forcing.place(box.points, box.areas, box.velocities);
  const auto ends = in_working_order(forcing.markers(), box.ends);
  double sum = 0;
  for (auto _ : state) {
    forcing.place(box.points, box.areas, box.velocities);
    for (int l = 0; l < 3; ++l)
      forcing.apply({l, 0, 0, step_weights[l]}, 1e-3, box.u.view(), box.v.view(), box.w.view());
    probe_all_markers(box, shape, ends, sum);
    benchmark::DoNotOptimize(sum);
  }
  count_markers(state);
}

// The same without what does not belong to a marker: the passes over the force fields, and the sorting.
void step_of_markers_alone(benchmark::State& state) {
  Box box = box_of(state);
  const MlsShape shape(box.grid);
  Markers markers(box.grid);
  markers.place(box.points, box.areas);
  const auto ends = in_working_order(markers, box.ends);
  ForceFields forces(box.grid);
  forces.reach(markers);
  MarkerVectors found;
  found.assign(markers.padded_size());
  double sum = 0;
  for (auto _ : state) {
    for (int l = 0; l < 3; ++l)
      markers.for_each_block([&](const StencilBlock& block) {
        interpolate(markers, block, box.u.view(), box.v.view(), box.w.view(), found);
        spread(markers, block, found, forces);
      });
    probe_all_markers(box, shape, ends, sum);
    benchmark::DoNotOptimize(sum);
  }
  count_markers(state);
}

// One stencil by the textbook: nodes, 27 weights and a 4 x 4 solve for every component of every marker. Uniform grids.
struct GenericSupport {
  int first[3] = {};
  double offsets[3][3] = {};
  std::array<double, 3> reach{};

  /// faces: the direction whose faces are the nodes; 3 for centres.
  GenericSupport(const Grid& grid, Vec3 x, int faces) {
    for (int d = 0; d < 3; ++d) {
      const int n = grid.cells()[static_cast<std::size_t>(d)];
      const double h = grid.size()[d] / n, place = d == faces ? 1.0 : 0.5;
      const double scaled = (x[d] - grid.origin()[d]) / h - place;
      const int nearest = static_cast<int>(std::lround(scaled));
      for (int i = 0; i < 3; ++i) offsets[d][i] = (nearest + i - 1 - scaled) * h;
      first[d] = (nearest < 0 ? nearest + n : nearest >= n ? nearest - n : nearest) - 1;
      reach[static_cast<std::size_t>(d)] = default_mls_alpha * 1.5 * h;
    }
  }
};

template <class Location>
double weighted_sum(ConstView<Location> f, const GenericSupport& s, const std::array<double, 27>& weights) {
  double sum = 0;
  for (int n = 0; n < 27; ++n)
    sum += weights[static_cast<std::size_t>(n)] * f(s.first[0] + n % 3, s.first[1] + n / 3 % 3, s.first[2] + n / 9);
  return sum;
}

template <class Location>
void forward_and_back(const Grid& grid, Vec3 x, int faces, ConstView<Location> u, View<Location> force) {
  const GenericSupport s(grid, x, faces);
  const test::GenericMls<double> mls(s.offsets, s.reach);
  for (int l = 0; l < 3; ++l) {
    const double found = weighted_sum(u, s, mls.value);
    for (int n = 0; n < 27; ++n)
      force(s.first[0] + n % 3, s.first[1] + n / 3 % 3, s.first[2] + n / 9) +=
          mls.value[static_cast<std::size_t>(n)] * found;
  }
}

template <class Location>
double gradient_sum(const Grid& grid, Vec3 x, int faces, ConstView<Location> u) {
  const GenericSupport s(grid, x, faces);
  const test::GenericMls<double> mls(s.offsets, s.reach);
  return weighted_sum(u, s, mls.gradient[0]) + weighted_sum(u, s, mls.gradient[1]) +
         weighted_sum(u, s, mls.gradient[2]);
}

// The step with stencils made once a step, one for each component.
void generic_step(benchmark::State& state) {
  Box box = box_of(state);
  const MlsShape shape(box.grid);
  Markers markers(box.grid);
  markers.place(box.points, box.areas);
  auto points = in_working_order(markers, box.points), ends = in_working_order(markers, box.ends);
  for (auto* list : {&points, &ends})
    for (Vec3& x : *list) shape.bring_into_box(x);
  ForceFields forces(box.grid);
  const auto in = box.fields();
  double sum = 0;
  for (auto _ : state) {
    for (const Vec3& x : points) {
      forward_and_back(box.grid, x, 0, in.u, forces.x());
      forward_and_back(box.grid, x, 1, in.v, forces.y());
      forward_and_back(box.grid, x, 2, in.w, forces.z());
    }
    for (const Vec3& x : ends) {
      const GenericSupport s(box.grid, x, 3);
      sum += weighted_sum(in.p, s, test::GenericMls<double>(s.offsets, s.reach).value);
      sum +=
          gradient_sum(box.grid, x, 0, in.u) + gradient_sum(box.grid, x, 1, in.v) + gradient_sum(box.grid, x, 2, in.w);
    }
    benchmark::DoNotOptimize(sum);
  }
  count_markers(state);
}

void stencils(benchmark::State& state) {
  Box box = box_of(state);
  const MlsShape shape(box.grid);
  StencilBatch stencil_batch;
  SlopeBatch slopes;
  for (Vec3& x : box.points) shape.bring_into_box(x);
  for (auto _ : state)
    for (std::size_t begin = 0; begin + mls_batch <= box.points.size(); begin += mls_batch) {
      shape.evaluate(std::span(box.points).subspan(begin, mls_batch), stencil_batch, slopes);
      benchmark::DoNotOptimize(stencil_batch);
    }
  count_markers(state);
}

void placing(benchmark::State& state) {
  const Box box = box_of(state);
  Markers markers(box.grid);
  for (auto _ : state) markers.place(box.points, box.areas);
  count_markers(state);
}

void interpolation(benchmark::State& state) {
  const Box box = box_of(state);
  Markers markers(box.grid);
  markers.place(box.points, box.areas);
  MarkerVectors found;
  found.assign(markers.padded_size());
  for (auto _ : state) interpolate(markers, box.u.view(), box.v.view(), box.w.view(), found);
  count_markers(state);
}

void spreading(benchmark::State& state) {
  const Box box = box_of(state);
  Markers markers(box.grid);
  markers.place(box.points, box.areas);
  ForceFields forces(box.grid);
  forces.reach(markers);
  MarkerVectors found;
  found.assign(markers.padded_size());
  for (auto _ : state) spread(markers, found, forces);
  count_markers(state);
}

void probing(benchmark::State& state) {
  const Box box = box_of(state);
  const MlsShape shape(box.grid);
  Markers markers(box.grid);
  markers.place(box.points, box.areas);
  const auto ends = in_working_order(markers, box.ends);
  double sum = 0;
  for (auto _ : state) probe_all_markers(box, shape, ends, sum);
  benchmark::DoNotOptimize(sum);
  count_markers(state);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"n", "stretched", "markers"})->Unit(benchmark::kMillisecond);
  for (int n : {128, 256}) b->Args({n, static_cast<int>(StretchingLaw::uniform), 100000});
  b->Args({128, static_cast<int>(StretchingLaw::tanh), 100000});
  b->Args({32, static_cast<int>(StretchingLaw::uniform), 800});  // all of it in cache
}

void uniform_sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"n", "stretched", "markers"})->Unit(benchmark::kMillisecond);
  b->Args({128, static_cast<int>(StretchingLaw::uniform), 100000});
}

BENCHMARK(step)->Apply(sizes);
BENCHMARK(step_of_markers_alone)->Apply(sizes);
BENCHMARK(generic_step)->Apply(uniform_sizes);
BENCHMARK(stencils)->Apply(sizes);
BENCHMARK(placing)->Apply(sizes);
BENCHMARK(interpolation)->Apply(sizes);
BENCHMARK(spreading)->Apply(sizes);
BENCHMARK(probing)->Apply(sizes);

}  // namespace
}  // namespace pliant
