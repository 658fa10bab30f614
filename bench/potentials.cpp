#include <benchmark/benchmark.h>

#include <cmath>

#include "mesh/shapes/icosphere.hpp"
#include "structure/make_body.hpp"

// One evaluation of a body's internal forces; items are faces, so the inverse of items_per_second is the time of a
// face.
namespace pliant {
namespace {

PotentialsConfig four_potentials() {
  PotentialsConfig config;
  config.edge = EdgeConfig{400, 1.0};
  config.bending = BendingConfig{64, ReferenceAngle::initial};
  config.volume = VolumeConfig{2e4};
  config.area = AreaConfig{400};
  return config;
}

PotentialsConfig liquid_interface() {
  PotentialsConfig config;
  config.surface_tension = SurfaceTensionConfig{114, 66};
  config.volume = VolumeConfig{2e5};
  return config;
}

void evaluate(benchmark::State& state, const PotentialsConfig& potentials) {
  Surface surface = make_icosphere(static_cast<int>(state.range(0)), 1.0);
  BodyConfig body;
  body.potentials = potentials;
  const PotentialSet set = make_potentials(body, surface.mesh, surface.positions);
  for (Vec3& x : surface.positions) x.x += 0.1 * std::sin(3 * x.y) * x.z;
  ShapeState shape(surface.mesh);
  std::vector<Vec3> forces(surface.positions.size());
  for (auto _ : state) {
    shape.update(surface.positions);
    set.add_forces(shape, forces);
    benchmark::DoNotOptimize(forces.data());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * surface.mesh.n_faces());
}

void edge_bending_volume_area(benchmark::State& state) { evaluate(state, four_potentials()); }
BENCHMARK(edge_bending_volume_area)->Arg(4)->Arg(8)->Arg(16)->Arg(64)->ArgName("frequency");

void surface_tension_and_volume(benchmark::State& state) { evaluate(state, liquid_interface()); }
BENCHMARK(surface_tension_and_volume)->Arg(4)->Arg(8)->Arg(16)->Arg(64)->ArgName("frequency");

}  // namespace
}  // namespace pliant
