#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/angles.hpp"
#include "io/field_writer.hpp"
#include "mpi/coupling/small_cases.hpp"
#include "mpi/io/shared_folder.hpp"
#include "simulation/hinge_times.hpp"
#include "simulation/phase_average.hpp"
#include "unit/io/text_of.hpp"

// What runs over cycles leave behind: averages by phase, times of stops, volumes of cavities.
namespace pliant {
namespace {

namespace fs = std::filesystem;

/// A flow that is the same everywhere.
FlowState uniform_flow(const Grid& grid, Vec3 velocity, double pressure) {
  FlowState state(grid);
  for (int k = -1; k <= grid.nz(); ++k)
    for (int j = -1; j <= grid.ny(); ++j)
      for (int i = -1; i <= grid.nx(); ++i) {
        state.u.view()(i, j, k) = velocity.x;
        state.v.view()(i, j, k) = velocity.y;
        state.w.view()(i, j, k) = velocity.z * (1 + grid.x_center(i));
        state.p.view()(i, j, k) = pressure;
      }
  return state;
}

struct Averaged {
  Grid grid;
  PhaseAverage average;

  explicit Averaged(PhaseAverageConfig config, double period = 2)
      : grid(small_box({5, 4, 6}).box, BoundaryConfig{}, Communicator()),
        average(config, period, true, grid, BoundaryConfig{}, 3.0) {}

  void add(double time, double size) { average.add(time, uniform_flow(grid, size * Vec3{1, 2, 3}, 4 * size)); }
  /// The sums of all bins, this rank's cells.
  std::vector<std::vector<double>> sums() {
    std::vector<std::vector<double>> all;
    for (const auto& table : average.tables()) table.save(all.emplace_back(table.shape.size()));
    return all;
  }
};

TEST(PhaseAverage, IsTheMeanOverTimeInEachBin) {
  Averaged flow({4, 1.0, 1});
  flow.add(0.9, 1000);  // before it counts
  flow.add(1.2, 1);     // phase 0.6: weight 0.2
  flow.add(3.3, 2);     // phase 0.65 of the next cycle: weight 2.1
  flow.add(4.0, 5);     // phase 0: weight 0.7
  const auto& weights = flow.average.weights();
  EXPECT_NEAR(weights[0], 0.7, 1e-14);
  EXPECT_EQ(weights[1], 0);
  EXPECT_NEAR(weights[2], 2.3, 1e-14);
  const double mean = (0.2 * 1 + 2.1 * 2) / 2.3;
  const auto sums = flow.sums();
  for (std::size_t n = 0; n < sums[2].size(); n += 7) {
    EXPECT_NEAR(sums[2][n] / weights[2], mean, 1e-13);
    EXPECT_NEAR(sums[2][n + 1] / weights[2], 2 * mean, 1e-13);
    EXPECT_NEAR(sums[2][n + 3] / weights[2], 3 * 4 * mean, 1e-13) << "pressure is density times p";
    EXPECT_NEAR(sums[2][n + 5] / weights[2], -3 * mean, 1e-12) << "vorticity about y is -dw/dx";
    EXPECT_NEAR(sums[0][n] / weights[0], 5, 1e-13);
  }
  const SharedFolder owner;
  flow.average.write_files(owner.path());
  if (!flow.grid.ranks().is_root()) return;
  const auto series = text_of(owner.path() / "phase_average.xdmf");
  EXPECT_NE(series.find("<Time Value=\"0.25\"/>"), std::string::npos) << "the middle of the first bin";
  EXPECT_NE(series.find("phase_average/phase_average_000002.h5:/vorticity"), std::string::npos);
  EXPECT_EQ(series.find("phase_average_000001"), std::string::npos) << "a bin that saw nothing";
}

TEST(PhaseAverage, GoesBackAndThroughACheckpoint) {
  Averaged flow({3, 0, 1});
  flow.add(0.3, 1);
  flow.add(0.9, 2);
  flow.average.keep();
  const auto kept = flow.sums();
  const auto weights = flow.average.weights();
  flow.add(1.0, 7);
  flow.add(1.9, 8);
  flow.add(2.1, 9);
  EXPECT_NE(flow.sums(), kept);
  flow.average.roll_back();
  EXPECT_EQ(flow.sums(), kept);
  EXPECT_EQ(flow.average.weights(), weights);

  ByteWriter out;
  flow.average.write(out);
  Averaged other({3, 0, 1}), finer({4, 0, 1});
  ByteReader in(out.bytes()), again(out.bytes());
  EXPECT_FALSE(finer.average.read(again));
  ASSERT_TRUE(other.average.read(in));
  const auto to = other.average.tables();
  for (std::size_t t = 0; t < to.size(); ++t) to[t].load(kept[t]);
  flow.add(1.5, 3);
  other.add(1.5, 3);
  EXPECT_EQ(other.sums(), flow.sums());
  EXPECT_EQ(other.average.weights(), flow.average.weights());
}

TEST(HingeTimes, AreWhereTheAngleComesWithinADegreeOfAStop) {
  auto config = small_box({8, 8, 9});
  auto upper = leaflet({0, 0, 0.7}), free = leaflet({0, 0, -1.5});
  upper.name = "upper";
  free.name = "free";
  free.hinge.min_angle.reset();
  free.hinge.max_angle.reset();
  config.bodies = {upper, free};
  const Grid grid(config.box, config.boundary, Communicator());
  Bodies bodies(config, grid);
  HingeTimes times(bodies, 10.0);
  ASSERT_TRUE(times.any());
  // From -20 to 20 degrees and back, straight between the looks, and a day at the upper stop.
  const auto look = [&](double time, double angle) {
    for (Body& body : bodies.own()) body.hinge.angle = angle * degree;
    times.observe(time, bodies);
  };
  look(10, -20);
  look(10.5, -20);
  look(11.5, -10);
  look(13.5, 10);
  look(14.5, 20);
  look(15.0, 20);
  look(21.0, -20);
  const auto events = times.results()["upper"];
  ASSERT_EQ(events.size(), 4u);
  const auto expect = [&](std::size_t n, const std::string& what, double stop, double time) {
    EXPECT_EQ(events[n]["what"], what);
    EXPECT_EQ(events[n]["stop"], stop);
    EXPECT_NEAR(events[n]["time"].get<double>(), time, 1e-12);
    EXPECT_NEAR(events[n]["phase"].get<double>(), time / 10 - std::floor(time / 10), 1e-12);
  };
  expect(0, "leaves", -20, 10.6);
  expect(1, "comes to", 20, 14.4);
  expect(2, "leaves", 20, 15.15);
  expect(3, "comes to", -20, 20.85);
  EXPECT_FALSE(times.results().contains("free")) << "it has no stops";
  EXPECT_NE(times.describe().at(0).find("hinge upper: leaves -20 deg at t = 10.6 (phase 0.0600), comes to 20 deg"),
            std::string::npos)
      << times.describe().at(0);
}

std::vector<std::vector<double>> rows_of(const fs::path& table, std::vector<std::string>& names) {
  std::istringstream text(text_of(table));
  std::vector<std::vector<double>> rows;
  for (std::string line, cell; std::getline(text, line);) {
    std::istringstream cells(line);
    std::vector<double> row;
    const bool is_head = names.empty();
    while (std::getline(cells, cell, ','))
      if (is_head) names.push_back(cell);
      else row.push_back(std::stod(cell));
    if (!is_head) rows.push_back(std::move(row));
  }
  return rows;
}

CaseConfig soft_ball() {
  auto config = small_box({10, 10, 11});
  config.initial.flow = InitialFlow::perturbed;
  config.initial.amplitude = 1;
  config.output.history.every = 1;
  config.output.period = 0.3;
  config.time.end = 0.7;
  config.bodies = {drop({0.1, 0.2, 0}, 1.2), ball("rock", MotionKind::fixed, {-1.3, -1.3, -1.3}, 0.6)};
  config.bodies[0].potentials.volume.reset();
  CavityConfig cavity;
  cavity.name = "inside";
  cavity.body = "drop";
  cavity.flow = "0.01*cos(t)";
  cavity.jet = JetConfig{{0, 0, 1}, {0, 0, -1}, 0.2};
  config.cavities = {cavity};
  return config;
}

TEST(Cavities, TellVolumesRatesAndCyclesTheSameOnAllRanks) {
  const SharedFolder owner;
  const Communicator ranks;
  const auto alone = owner.path() / ("alone-" + std::to_string(ranks.rank())), folder = owner.path() / "shared";
  Simulation(soft_ball(), ranks, silent(folder)).run();
  Simulation(soft_ball(), Communicator(MPI_COMM_SELF), silent(alone)).run();
  if (!ranks.is_root()) return;
  std::vector<std::string> names, same_names, of_body;
  const auto rows = rows_of(folder / "cavities/inside.csv", names),
             own = rows_of(alone / "cavities/inside.csv", same_names);
  const auto shapes = rows_of(folder / "bodies/drop.csv", of_body);
  ASSERT_EQ(names, (std::vector<std::string>{"step", "time", "volume", "dV_dt", "flow", "difference", "kinetic_energy",
                                             "enstrophy", "jet_depth", "jet_depth_over_apex"}));
  EXPECT_EQ(same_names, names);
  ASSERT_EQ(rows.size(), 36u);
  ASSERT_EQ(own.size(), rows.size());
  double energy = 0, deepest = 0;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    for (std::size_t c = 0; c < names.size(); ++c) EXPECT_NEAR(rows[n][c], own[n][c], 1e-11) << names[c];
    EXPECT_NEAR(rows[n][2], shapes[n][5], 1e-12) << "the volume in the table of the body: " << of_body[5];
    EXPECT_NEAR(rows[n][4], 0.01 * std::cos(rows[n][1]), 1e-15);
    EXPECT_NEAR(rows[n][5], (rows[n][3] - rows[n][4]) / 0.01, 1e-9);
    energy = std::max(energy, rows[n][6]);
    deepest = std::max(deepest, rows[n][8]);
    if (n == 0) continue;
    // Between two lines the volume changes at a rate between those of the lines.
    const double slope = (rows[n][2] - rows[n - 1][2]) / (rows[n][1] - rows[n - 1][1]);
    const double before = rows[n - 1][3], after = rows[n][3];
    EXPECT_NEAR(slope, 0.5 * (before + after), 0.5 * std::abs(after - before) + 0.01);
  }
  EXPECT_GT(energy, 0.1);
  EXPECT_GT(deepest, 0.1);

  const auto report = Json::parse(text_of(folder / "run.json"))["results"];
  const auto cycles = report["cavities"]["inside"];
  ASSERT_EQ(cycles.size(), 3u) << "the third of them is begun";
  for (std::size_t c = 0; c < 3; ++c) {
    double most = 0, least = 1e300;
    for (const auto& row : rows)
      if (row[1] > 0.3 * static_cast<double>(c) - 1e-9 && row[1] < 0.3 * static_cast<double>(c + 1) + 1e-9) {
        most = std::max(most, row[2]);
        least = std::min(least, row[2]);
      }
    EXPECT_EQ(cycles[c]["largest_volume"], most);
    EXPECT_EQ(cycles[c]["smallest_volume"], least);
    EXPECT_NEAR(cycles[c]["ejection_fraction"].get<double>(), (most - least) / most, 1e-15);
  }
  EXPECT_NEAR(report["energy"]["fluid"]["first"].get<double>(), 0.5 * 64, 40) << "energies are there";
}

}  // namespace
}  // namespace pliant
