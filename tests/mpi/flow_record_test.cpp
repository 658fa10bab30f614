#include "flow/flow_record.hpp"

#include <gtest/gtest.h>

#include "core/byte_stream.hpp"
#include "mpi/against_one_rank.hpp"

// What a flow solver keeps between steps is all in its record: from it the run goes on with the same bits, in the same
// solver, in one that has never made a step, and (to round-off) on another number of ranks.
namespace pliant::test {
namespace {

struct Setting {
  BoxConfig box;
  FlowParameters parameters;
};

std::vector<Setting> settings() {
  BoundaryConfig along_x = walls_along(2), along_z = walls_along(1);
  along_x[0] = InflowSide{{1, 0, 0}, InflowProfile::parabolic, 0.5};
  along_x[1] = OutflowSide{};
  along_z[5] = InflowSide{{0.2, 0, -1}};
  along_z[4] = OutflowSide{};
  std::vector<Setting> all;
  for (const auto& sides : {periodic_box(), walls_along(2, {-0.5, 0, 0}, {0.5, 0, 0}), along_x, along_z})
    for (ViscousMode mode : {ViscousMode::explicit_rk3, ViscousMode::implicit_z, ViscousMode::implicit}) {
      Setting setting;
      setting.box.cells = {12, 10, 9};
      setting.box.size = {1.5, 1, 1.2};
      setting.box.stretching_z = {StretchingLaw::tanh, 1.0};
      setting.parameters.viscosity = 2e-3;
      setting.parameters.viscous = mode;
      setting.parameters.boundary = sides;
      if (std::holds_alternative<PeriodicSide>(sides[0]))
        setting.parameters.forcing.bulk_velocity = ForcingConfig::BulkVelocity{Axis::x, 0.4};
      all.push_back(setting);
    }
  return all;
}

void begin(FlowSolver& solver) {
  InitialConfig initial;
  initial.flow = InitialFlow::perturbed;
  initial.velocity = {0.4, 0.1, -0.2};
  set_initial_flow(solver, initial);
}

void advance(FlowSolver& solver, int steps, double dt = 5e-3) {
  for (int n = 0; n < steps; ++n) solver.advance(dt);
}

void expect_same_bits(const FlowSolver& a, const FlowSolver& b) {
  FlowSnapshot first, second;
  a.save_state(first);
  b.save_state(second);
  // With ghosts: markers read them.
  EXPECT_EQ(first.u, second.u);
  EXPECT_EQ(first.v, second.v);
  EXPECT_EQ(first.w, second.w);
  EXPECT_EQ(first.p, second.p);
  EXPECT_EQ(first.open.mean_outwards, second.open.mean_outwards);
  EXPECT_EQ(first.time, second.time);
  EXPECT_EQ(first.forcing, second.forcing);
}

TEST(FlowRecord, ASnapshotTakesTheSolverBack) {
  for (const auto& setting : settings()) {
    const Grid grid(setting.box, setting.parameters.boundary, Communicator());
    FlowSolver disturbed(grid, setting.parameters), straight(grid, setting.parameters);
    begin(disturbed);
    begin(straight);
    advance(disturbed, 3);
    FlowSnapshot snapshot;
    disturbed.save_state(snapshot);
    advance(disturbed, 2, 2e-3);
    disturbed.restore_state(snapshot);
    advance(disturbed, 2);
    advance(straight, 5);
    expect_same_bits(disturbed, straight);
  }
}

TEST(FlowRecord, TablesAndNumbersContinueInANewSolver) {
  for (const auto& setting : settings()) {
    const Grid grid(setting.box, setting.parameters.boundary, Communicator());
    FlowSolver old(grid, setting.parameters), fresh(grid, setting.parameters);
    begin(old);
    advance(old, 3);
    const auto tables = old.state_tables();
    for (std::size_t t = 0; t < tables.size(); ++t) {
      std::vector<double> values(tables[t].size());
      old.save_table(t, values);
      fresh.load_table(t, values);
    }
    fresh.finish_loading(old.state_numbers());
    expect_same_bits(old, fresh);
    advance(old, 3);
    advance(fresh, 3);
    expect_same_bits(old, fresh);
  }
}

// The whole of a table on every rank.
std::vector<double> gather(const RowTable& table, const std::vector<double>& mine) {
  std::vector<double> whole(static_cast<std::size_t>(table.rows) * table.row_size, 0.0);
  std::copy(mine.begin(), mine.end(), whole.begin() + static_cast<std::ptrdiff_t>(table.first * table.row_size));
  Communicator().sum(whole);
  return whole;
}

TEST(FlowRecord, TablesFitAnotherNumberOfRanks) {
  for (const auto& setting : settings()) {
    const Grid shared_grid(setting.box, setting.parameters.boundary, Communicator());
    const Grid own_grid(setting.box, setting.parameters.boundary, Communicator(MPI_COMM_SELF));
    FlowSolver shared(shared_grid, setting.parameters), own(own_grid, setting.parameters);
    begin(shared);
    advance(shared, 2);
    const auto tables = shared.state_tables(), own_tables = own.state_tables();
    ASSERT_EQ(tables.size(), own_tables.size());
    for (std::size_t t = 0; t < tables.size(); ++t) {
      EXPECT_EQ(tables[t].name, own_tables[t].name);
      EXPECT_EQ(shared_grid.ranks().sum(static_cast<long>(tables[t].count)), static_cast<long>(tables[t].rows));
      std::vector<double> values(tables[t].size());
      shared.save_table(t, values);
      own.load_table(t, gather(tables[t], values));
    }
    own.finish_loading(shared.state_numbers());
    advance(shared, 20);
    advance(own, 20);
    // Of velocities of order 1; round-off that 20 steps have spread.
    EXPECT_LT(against_one_rank(shared, own).largest, 1e-11);
  }
}

TEST(FlowRecord, RefusesTheNumbersOfAnotherKindOfFlow) {
  const auto all = settings();
  const Grid closed(all.front().box, all.front().parameters.boundary, Communicator());
  const Grid open(all.back().box, all.back().parameters.boundary, Communicator());
  FlowSolver a(closed, all.front().parameters), b(open, all.back().parameters);
  EXPECT_THROW(a.finish_loading(b.state_numbers()), ByteStreamError);
  EXPECT_THROW(b.finish_loading(a.state_numbers()), ByteStreamError);
}

}  // namespace
}  // namespace pliant::test
