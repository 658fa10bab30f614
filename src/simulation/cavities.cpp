#include "simulation/cavities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "signals/make_signal.hpp"
#include "simulation/cycles.hpp"

namespace pliant {
namespace {

std::size_t kind_named(const std::string& name, const Bodies& bodies) {
  for (std::size_t k = 0; k < bodies.kinds().size(); ++k)
    if (bodies.kinds()[k].config.name == name) return k;
  throw InputError(fmt::format("a cavity names \"{}\", which is no body", name));
}

double largest_size(const Signal& signal, double end) {
  constexpr int samples = 2000;
  double largest = 0;
  for (int n = 0; n <= samples; ++n) largest = std::max(largest, std::abs(signal.value(end * n / samples)));
  return largest;
}

/// Numbers of one rank on all ranks.
void share(const Communicator& ranks, int owner, std::vector<double>& numbers) {
  long size = static_cast<long>(numbers.size());
  check_mpi(MPI_Bcast(&size, 1, MPI_LONG, owner, ranks.handle()), "MPI_Bcast");
  numbers.resize(static_cast<std::size_t>(size));
  check_mpi(MPI_Bcast(numbers.data(), static_cast<int>(size), MPI_DOUBLE, owner, ranks.handle()), "MPI_Bcast");
}

}  // namespace

Cavities::Cavities(const CaseConfig& config, const Bodies& bodies, const Grid& grid)
    : grid_(grid), density_(config.fluid.density), centered_(grid, config.boundary) {
  if (config.cavities.empty()) return;
  const auto signals = make_signals(config);
  for (const auto& given : config.cavities) {
    Cavity cavity;
    cavity.config = given;
    const auto kind = kind_named(given.body, bodies);
    cavity.body = bodies.first_id(kind);
    const auto& prototype = bodies.kinds()[kind].prototype;
    cavity.surface = std::make_shared<LiddedSurface>(prototype.mesh);
    const auto positions = cavity.surface->with_hubs(prototype.positions);
    if (enclosed_volume_and_rate(cavity.surface->faces(), positions, positions).volume < 0) cavity.orientation = -1;
    cavity.period = given.period ? given.period : config.output.period;
    if (!given.flow.empty()) {
      cavity.flow = make_signal_or_formula(given.flow, signals);
      if (!given.period && cavity.flow->period()) cavity.period = cavity.flow->period();
      cavity.peak = std::abs(given.flow_factor) * largest_size(*cavity.flow, cavity.period.value_or(config.time.end));
    }
    cavities_.push_back(std::move(cavity));
  }
}

std::vector<std::string> Cavities::columns(std::size_t n) const {
  std::vector<std::string> names{"volume", "dV_dt"};
  if (cavities_[n].flow) names.insert(names.end(), {"flow", "difference"});
  names.insert(names.end(), {"kinetic_energy", "enstrophy"});
  if (cavities_[n].config.jet) names.insert(names.end(), {"jet_depth", "jet_depth_over_apex"});
  return names;
}

std::vector<double> Cavities::row(std::size_t n) const {
  const auto& cavity = cavities_[n];
  std::vector<double> values{cavity.now.volume, cavity.now.rate};
  if (cavity.flow) values.insert(values.end(), {cavity.flow_now, difference(cavity)});
  values.insert(values.end(), {cavity.inside.kinetic_energy, cavity.inside.enstrophy});
  if (cavity.config.jet)
    values.insert(values.end(), {cavity.inside.jet_depth, cavity.inside.jet_depth / cavity.apex_depth});
  return values;
}

// The body's rank finds what follows from its surface, and tells the others.
std::vector<InsidePiece> Cavities::share_pieces(Cavity& cavity, const Bodies& bodies) const {
  const auto& ranks = grid_.ranks();
  const Body* body = bodies.find(cavity.body);
  std::vector<double> numbers;
  if (body != nullptr) {
    const auto& surface = body->surface;
    const auto positions = cavity.surface->with_hubs(surface.positions);
    const auto velocities = cavity.surface->with_hubs(surface.velocities);
    const auto faces = cavity.surface->faces();
    const auto [volume, rate] = enclosed_volume_and_rate(faces, positions, velocities);
    double apex = 0;
    if (const auto& jet = cavity.config.jet)
      for (const Vec3& x : surface.positions) apex = std::max(apex, dot(x - jet->origin, normalized(jet->axis)));
    numbers = {cavity.orientation * volume, cavity.orientation * rate, apex};
    for (const auto& piece : find_inside(grid_, faces, positions, cavity.orientation))
      numbers.insert(numbers.end(), {static_cast<double>(piece.i), static_cast<double>(piece.j), piece.from, piece.to});
  }
  share(ranks, ranks.max(body != nullptr ? ranks.rank() : -1), numbers);
  cavity.now = {numbers[0], numbers[1]};
  cavity.apex_depth = numbers[2];
  std::vector<InsidePiece> pieces;
  for (std::size_t n = 3; n < numbers.size(); n += 4)
    pieces.push_back({static_cast<int>(numbers[n]), static_cast<int>(numbers[n + 1]), numbers[n + 2], numbers[n + 3]});
  return pieces;
}

void Cavities::measure(double time, const FlowSolver& flow, const Bodies& bodies) {
  for (auto& cavity : cavities_) {
    const auto pieces = share_pieces(cavity, bodies);
    cavity.inside = find_cavity_flow(grid_, pieces, flow.state(), centered_, density_, cavity.config.jet);
    if (cavity.flow) cavity.flow_now = cavity.config.flow_factor * cavity.flow->value(time);
    record(cavity, time);
  }
}

double Cavities::difference(const Cavity& cavity) {
  if (!(cavity.peak > 0)) return std::numeric_limits<double>::quiet_NaN();
  return (cavity.now.rate - cavity.flow_now) / cavity.peak;
}

// The moment at which a cycle ends and the next begins counts for both.
void Cavities::record(Cavity& cavity, double time) {
  auto& cycles = cavity.cycles;
  const auto put_into = [&](CavityCycle& cycle) {
    cycle.end = time;
    cycle.largest_volume = std::max(cycle.largest_volume, cavity.now.volume);
    cycle.smallest_volume = std::min(cycle.smallest_volume, cavity.now.volume);
    if (cavity.peak > 0) cycle.largest_difference = std::max(cycle.largest_difference, std::abs(difference(cavity)));
  };
  const auto at = cavity.period ? cycle_time(time, *cavity.period) : CycleTime{};
  const long number = at.cycle + 1;
  if (cycles.empty() || cycles.back().number < number) {
    if (!cycles.empty() && at.phase < 1e-9) put_into(cycles.back());
    const double begin = cavity.period ? static_cast<double>(at.cycle) * *cavity.period : 0;
    cycles.push_back({number, begin, time, cavity.now.volume, cavity.now.volume, 0});
  }
  put_into(cycles.back());
}

std::string Cavities::describe(const Cavity& cavity, const CavityCycle& cycle) {
  auto text = fmt::format(
      "cavity {}, cycle {} (t = {:.6g} to {:.6g}): volume {:.5g} to {:.5g}, stroke {:.5g}, ejection fraction {:.4f}",
      cavity.config.name, cycle.number, cycle.begin, cycle.end, cycle.smallest_volume, cycle.largest_volume,
      cycle.stroke_volume(), cycle.ejection_fraction());
  if (cavity.peak > 0)
    text += fmt::format("; dV/dt is off the flow by up to {:.2g} of its peak", cycle.largest_difference);
  return text;
}

std::vector<std::string> Cavities::take_news() {
  std::vector<std::string> lines;
  for (auto& cavity : cavities_)
    for (; cavity.told + 1 < cavity.cycles.size(); ++cavity.told)
      lines.push_back(describe(cavity, cavity.cycles[cavity.told]));
  return lines;
}

std::vector<std::string> Cavities::describe_unfinished() const {
  std::vector<std::string> lines;
  for (const auto& cavity : cavities_)
    if (!cavity.cycles.empty() && cavity.cycles.back().end > cavity.cycles.back().begin)
      lines.push_back(describe(cavity, cavity.cycles.back()) + ", up to here");
  return lines;
}

Json Cavities::results() const {
  auto all = Json::object();
  for (const auto& cavity : cavities_) {
    auto cycles = Json::array();
    for (const auto& cycle : cavity.cycles) {
      if (!(cycle.end > cycle.begin)) continue;
      Json entry{{"cycle", cycle.number},
                 {"begin", cycle.begin},
                 {"end", cycle.end},
                 {"largest_volume", cycle.largest_volume},
                 {"smallest_volume", cycle.smallest_volume},
                 {"stroke_volume", cycle.stroke_volume()},
                 {"ejection_fraction", cycle.ejection_fraction()}};
      if (cavity.peak > 0) entry["largest_difference"] = cycle.largest_difference;
      cycles.push_back(std::move(entry));
    }
    all[cavity.config.name] = std::move(cycles);
  }
  return all;
}

void Cavities::write(ByteWriter& out) const {
  out.write(static_cast<std::uint64_t>(cavities_.size()));
  for (const auto& cavity : cavities_) {
    out.write(cavity.config.name);
    out.write(cavity.cycles);
  }
}

// Cavities may be added and taken away between the parts of a run.
void Cavities::read(ByteReader& in) {
  const auto count = in.read<std::uint64_t>();
  for (std::uint64_t n = 0; n < count; ++n) {
    const auto name = in.read_text();
    const auto cycles = in.read_vector<CavityCycle>();
    for (auto& cavity : cavities_) {
      if (cavity.config.name != name) continue;
      cavity.cycles = cycles;
      cavity.told = cycles.empty() ? 0 : cycles.size() - 1;
    }
  }
}

}  // namespace pliant
