#include <benchmark/benchmark.h>

#include "core/loops.hpp"
#include "flow/momentum.hpp"
#include "flow/projection.hpp"
#include "solvers/plane_helmholtz.hpp"
#include "solvers/plane_transform.hpp"
#include "solvers/row_helmholtz.hpp"

// The kernels of a flow step by themselves, on planes that stay in cache: items are cells, so that the inverse of
// items_per_second is the time of a cell.
namespace pliant {
namespace {

struct Box {
  explicit Box(int n)
      : grid(config(n), boundary(), Communicator(MPI_COMM_SELF)),
        u(grid),
        v(grid),
        w(grid),
        p(grid),
        hu(grid),
        hv(grid),
        hw(grid),
        ru(grid),
        rv(grid),
        rw(grid) {}
  static BoxConfig config(int n) {
    BoxConfig box;
    box.cells = {n, n, 4};
    return box;
  }
  static BoundaryConfig boundary() { return {}; }
  Grid grid;
  Field<FaceX> u;
  Field<FaceY> v;
  Field<FaceZ> w;
  Field<Center> p;
  Field<FaceX> hu;
  Field<FaceY> hv;
  Field<FaceZ> hw;
  Field<FaceX> ru;
  Field<FaceY> rv;
  Field<FaceZ> rw;
};

void count_cells(benchmark::State& state, const Grid& grid) {
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * grid.nx() * grid.ny());
}

void momentum(benchmark::State& state) {
  Box box(static_cast<int>(state.range(0)));
  const auto p = box.p.view();
  const MomentumInput in{planes_around(box.u.view(), 1), planes_around(box.v.view(), 1), planes_around(box.w.view(), 1),
                         p.at_plane(1), p.at_plane(2)};
  const MomentumOutput out{box.ru.view().at_plane(1), box.rv.view().at_plane(1), box.rw.view().at_plane(1),
                           box.hu.view().at_plane(1), box.hv.view().at_plane(1), box.hw.view().at_plane(1)};
  const MomentumFactors factors{1e-3, -1e-4, 1e-3, 1e-3, {}};
  FluxRows fluxes(box.grid);
  const MomentumRows rows(box.grid, static_cast<ViscousMode>(state.range(1)), HistoryUse::read_write, factors, in, out,
                          fluxes, 1);
  for (auto _ : state) for_rows(box.grid.ny(), rows);
  count_cells(state, box.grid);
}
BENCHMARK(momentum)->ArgsProduct({{64, 128, 256}, {0, 1, 2}})->ArgNames({"n", "mode"});

void correction(benchmark::State& state) {
  Box box(static_cast<int>(state.range(0)));
  Field<Center> phi(box.grid);
  const auto planes = planes_around(phi.view(), 1);
  const VelocityPlane<double> velocity{box.u.view().at_plane(1), box.v.view().at_plane(1), box.w.view().at_plane(1)};
  const VelocityCorrection correct_velocity(box.grid, 1e-3, planes.here, planes.above,
                                            {velocity.u, velocity.v, velocity.w}, velocity, 1);
  const PressureCorrection correct_pressure(box.grid, static_cast<CorrectionTerms>(state.range(1)), 1e-6,
                                            {planes.below, planes.here, planes.above}, box.p.view().at_plane(1), 1);
  for (auto _ : state)
    for (int j = 0; j < box.grid.ny(); ++j) {
      correct_velocity(j);
      correct_pressure(j);
    }
  count_cells(state, box.grid);
}
BENCHMARK(correction)->ArgsProduct({{64, 256}, {0, 1, 2}})->ArgNames({"n", "terms"});

void transform_pair(benchmark::State& state) {
  Box box(static_cast<int>(state.range(0)));
  const auto kind = state.range(1) == 0 ? PlaneTransform::Kind::fourier : PlaneTransform::Kind::cosine;
  const auto planning = state.range(2) == 0 ? TransformPlanning::estimate : TransformPlanning::measure;
  double* plane = box.p.view().at_row(0, 0);
  const PlaneTransform transform(box.grid.nx(), box.grid.ny(), box.p.row(), kind, kind, planning);
  for (auto _ : state) {
    transform.forward(plane);
    transform.backward(plane);
  }
  count_cells(state, box.grid);
}
BENCHMARK(transform_pair)->ArgsProduct({{128, 150, 256}, {0, 1}, {0, 1}})->ArgNames({"n", "cosine", "measure"});

void x_solves(benchmark::State& state) {
  Box box(static_cast<int>(state.range(0)));
  const RowHelmholtz solve(box.grid.nx(), 0.5, LineEnds::periodic, 0, 0);
  for (auto _ : state)
    for (int j = 0; j < box.grid.ny(); ++j) solve.solve(box.u.view().at_row(j, 0));
  count_cells(state, box.grid);
}
BENCHMARK(x_solves)->Arg(128)->Arg(256);

void y_solves(benchmark::State& state) {
  Box box(static_cast<int>(state.range(0)));
  const PlaneHelmholtz solve(box.grid.ny(), 0.5, LineEnds::periodic, 0, 0);
  std::vector<double> work(2 * static_cast<std::size_t>(box.grid.nx()));
  for (auto _ : state) solve.solve(box.u.view().at_row(0, 0), box.grid.nx(), box.u.row(), work.data());
  count_cells(state, box.grid);
}
BENCHMARK(y_solves)->Arg(128)->Arg(256);

}  // namespace
}  // namespace pliant
