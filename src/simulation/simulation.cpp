#include "simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "core/byte_stream.hpp"
#include "core/error.hpp"
#include "core/timer.hpp"
#include "core/version.hpp"
#include "coupling/body_rates.hpp"
#include "coupling/describe_kind.hpp"
#include "coupling/loose.hpp"
#include "coupling/strong.hpp"
#include "io/run_report.hpp"
#include "parallel/agree.hpp"
#include "simulation/case_identity.hpp"
#include "simulation/energy_record.hpp"
#include "simulation/explain_failure.hpp"
#include "simulation/flow_parameters.hpp"
#include "simulation/hinge_times.hpp"
#include "simulation/output_folder.hpp"
#include "simulation/outputs.hpp"
#include "simulation/phase_average.hpp"
#include "simulation/slowest_phases.hpp"
#include "simulation/stop_signals.hpp"
#include "simulation/time_step.hpp"
#include "simulation/wall_clock.hpp"

namespace pliant {
namespace {

// What the ranks have to agree on after a step, the most urgent first; the largest of all ranks counts.
constexpr int show_progress = 1;   // of the root alone, as is
constexpr int checkpoint_due = 2;  // added to the one above
constexpr int stop_by_clock = 500;
constexpr int stop_by_signal = 1000;  // plus the signal
constexpr int body_failed = 10000;
constexpr int flow_failed = 20000;  // above the bodies: a flow that fails takes them along

// A state is kept in memory at every so many steps, for the checkpoint of a run that fails: a copy of four fields, far
// cheaper than that many steps, and from before most of the growth of an instability.
constexpr long steps_between_good_states = 20;

// Which of the run's numbers are wanted at a step: the table's as scheduled, people's too, or both as the run ends.
enum class Record { scheduled, shown, last };

// All that a checkpoint says of a moment, in memory.
struct GoodState {
  CheckpointHead head;
  FlowSnapshot flow;
  std::vector<BodyBlob> bodies;
};

// The fluid, and bodies that deform.
std::vector<std::string> parts_with_energy(const Bodies& bodies) {
  std::vector<std::string> parts{"fluid"};
  for (const auto& kind : bodies.kinds())
    if (!kind.has_pose()) parts.push_back("body " + kind.config.name);
  return parts;
}

}  // namespace

struct Simulation::Impl {
  Impl(const CaseConfig& case_config, const Communicator& communicator, SimulationOptions run_options);

  RunResult run(const Simulation& self, const Observer& observer);
  RunResult loop(const Simulation& self, const Observer& observer, const StopSignals& signals);

  void introduce() const;
  double choose_step();
  void advance(double dt);
  void warn_of_first_step(double step) const;
  double bodies_rate();
  void diagnose_bodies();
  int agree_on_state(const StopSignals& signals);
  void record(Record wanted);
  void measure_cavities();
  void note_energies(double of_fluid);
  void observe();
  void summarize_run();
  Json results() const;
  void restore_records(ByteReader& run, CheckpointReader& checkpoint);
  std::vector<StoredTable> tables() { return phase_average ? phase_average->tables() : std::vector<StoredTable>(); }
  void write_outputs(Urgency urgency);
  bool is_at_end() const;
  [[noreturn]] void fail(int state);
  void begin_anew();
  void begin_from_checkpoint();
  CheckpointHead head() const;
  void write_checkpoint();
  void keep_good_state();
  std::string write_good_state();
  void report(const std::string& status);
  PhaseTimer::Seconds slowest_phases();

  CaseConfig config;
  Communicator ranks;
  SimulationOptions options;
  Log log;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  PhaseTimer timer;
  Grid grid;
  Bodies bodies;
  FlowSolver flow;
  double side_rate;  // convective, that the signals of the sides ask for at some time
  double path_rate;  // the same of prescribed motions
  std::optional<CoupledFlow> coupled;
  StrongCoupling strong;
  Cavities cavities;
  HingeTimes hinge_times;
  EnergyRecord energies;
  std::optional<PhaseAverage> phase_average;
  std::optional<Outputs> outputs;
  std::optional<RunReport> run_report;  // on the root
  Progress progress;
  Checkpoints checkpoints;
  WallClock wall_clock;
  std::string case_text;
  std::optional<GoodState> good_state;
  bool is_checkpoint_failing = false;

  Moment now;
  double next_event = 0;
  double dt = 0;
  double last_cfl = 0;
  long last_shown = -1;
  long last_diagnosed = -1;
  long first_step = 0;
  int iterations = 0;  // of strong coupling in the last step
  std::string body_problem;
};

Simulation::Impl::Impl(const CaseConfig& case_config, const Communicator& communicator, SimulationOptions run_options)
    : config(case_config),
      ranks(communicator),
      options(std::move(run_options)),
      log(ranks.is_root() && options.progress != ProgressStyle::silent ? Speaker::this_rank : Speaker::silent),
      grid(config.box, config.boundary, ranks),
      bodies(config, grid),
      flow(grid, flow_parameters(config)),
      side_rate(flow.largest_side_rate(config.time.end)),
      path_rate(largest_path_rate(bodies, config.time.end)),
      strong(ranks, config.coupling),
      cavities(config, bodies, grid),
      hinge_times(bodies, config.output.period),
      energies(parts_with_energy(bodies)),
      progress(log, ranks.is_root() ? options.progress : ProgressStyle::silent,
               {config.time.end, config.time.max_steps.value_or(-1),
                static_cast<double>(config.box.cells[0]) * config.box.cells[1] * config.box.cells[2]}),
      checkpoints(options.output, config.checkpoint, ranks),
      wall_clock(options.wall_clock, start),
      case_text(case_identity(config).dump(-1, ' ', false, Json::error_handler_t::replace)) {
  if (const auto& average = config.output.phase_average)
    phase_average.emplace(*average, *config.output.period, config.output.fields.vorticity, grid, config.boundary,
                          config.fluid.density);
  if (options.restart) begin_from_checkpoint();
  else begin_anew();
  report("running");
  timer.add("set-up", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

void Simulation::Impl::begin_anew() {
  set_initial_flow(flow, config.initial);
  coupled.emplace(config, flow, bodies, RunStart::anew);
  prepare_output_folder(options.output, ranks, EarlierOutputs::removed);
  outputs.emplace(options.output, config, grid, bodies, cavities);
  do_on_root(ranks, [&] { run_report.emplace(options.output / "run.json", config, ranks); });
}

void Simulation::Impl::begin_from_checkpoint() {
  const auto checkpoint = open_checkpoint(*options.restart, options.output, config, ranks, log);
  const auto& saved = checkpoint.reader->head();
  // The outputs go on in the folder that the checkpoint is in; in another one they start with it.
  const auto folder = std::filesystem::weakly_canonical(std::filesystem::absolute(checkpoint.file)).parent_path();
  const bool goes_on =
      folder == std::filesystem::weakly_canonical(std::filesystem::absolute(options.output) / "checkpoints");
  try {
    checkpoint.reader->restore(flow);
    bodies.restore(checkpoint.reader->read_bodies());
    ByteReader run(saved.run);
    run.read(dt);
    run.read(last_cfl);
    const auto strong_state = run.read_vector<double>();
    strong.restore(strong_state);
    bodies.follow_schedules(saved.time - 0.5 * dt);
    coupled.emplace(config, flow, bodies, RunStart::continued);
    now = {saved.step, saved.time};
    restore_records(run, *checkpoint.reader);
    run.expect_end();
    if (!goes_on) require_unused(options.output, checkpoint.file, ranks);
    prepare_output_folder(options.output, ranks, goes_on ? EarlierOutputs::continued : EarlierOutputs::removed);
    const auto grown = OutputsState::decode(saved.outputs);
    outputs.emplace(options.output, config, grid, bodies, cavities, goes_on ? &grown : nullptr);
  } catch (const CheckpointRefused& refused) {
    throw InputError(fmt::format("{} {}", checkpoint.file.string(), refused.what()));
  } catch (const ByteStreamError& error) {
    throw InputError(fmt::format("{} cannot be read: {}", checkpoint.file.string(), error.what()));
  } catch (const CollectiveError& error) {
    throw InputError(
        fmt::format("the outputs in {} cannot be continued: {}; continue in another folder with --out DIR "
                    "--restart {}",
                    options.output.string(), error.what(), checkpoint.file.string()));
  }
  first_step = now.step;
  if (goes_on) checkpoints.resume_after(now.step);
  do_on_root(ranks, [&] {
    if (goes_on) remove_unlisted_snapshots(options.output, now.step);
    run_report.emplace(options.output / "run.json", config, ranks);
    run_report->note_restart(checkpoint.file, now.step, now.time);
  });
  progress.begin_at(now.step, now.time);
  log.info("continuing from {}: step {}, t = {:.6g}", checkpoint.file.string(), now.step, now.time);
}

// What the run has found out so far.
void Simulation::Impl::restore_records(ByteReader& run, CheckpointReader& checkpoint) {
  cavities.read(run);
  hinge_times.read(run);
  energies.read(run);
  const auto averaged = run.read_vector<std::byte>();
  if (!phase_average) return;
  phase_average->begin_at(now.time);
  if (averaged.empty()) return;
  ByteReader average(averaged);
  if (phase_average->read(average)) checkpoint.restore(phase_average->tables());
  else log.warn("output.phase_average has changed since the checkpoint: averages begin anew");
}

RunResult Simulation::Impl::run(const Simulation& self, const Observer& observer) {
  StopSignals signals;
  try {
    const auto result = loop(self, observer, signals);
    progress.finish();
    summarize_run();
    if (result.end == RunEnd::signal) {
      report(fmt::format("stopped by signal {}", result.signal));
      log.info("stopped by signal {} at step {}, t = {:.6g}; the outputs up to here are in {}", result.signal,
               result.steps, result.time, options.output.string());
    } else if (result.end == RunEnd::wall_clock) {
      report("stopped by the wall clock");
      log.info("stopped by the wall clock at step {}, t = {:.6g}; run again with --restart to go on", result.steps,
               result.time);
    } else {
      report("finished");
      log.info("finished at step {}, t = {:.6g}; outputs are in {}", result.steps, result.time,
               options.output.string());
    }
    return result;
  } catch (const std::exception& error) {
    progress.finish();
    const std::string status = fmt::format("failed: {}", error.what());
    const bool is_known_to_all = dynamic_cast<const CollectiveError*>(&error) != nullptr;
    if (is_known_to_all && !is_checkpoint_failing) {
      const auto note = write_good_state();
      if (!note.empty()) log.info("{}", note);
    }
    try {
      if (is_known_to_all) report(status);
      else if (run_report)  // other ranks may know nothing of this: no collective call can be made any more
        run_report->write({status, now.step, now.time, 0, timer.seconds()});
    } catch (const RunError&) {
      // The first error is the one to tell; a full disk takes the report along.
    }
    throw;
  }
}

RunResult Simulation::Impl::loop(const Simulation& self, const Observer& observer, const StopSignals& signals) {
  introduce();
  record(Record::shown);
  write_outputs(Urgency::scheduled);
  hinge_times.observe(now.time, bodies);
  if (observer) observer(self);
  int state = 0;
  keep_good_state();
  wall_clock.end_step();
  while (!is_at_end() && state < stop_by_clock) {
    dt = choose_step();
    advance(dt);

    state = agree_on_state(signals);
    if (state >= body_failed) fail(state);
    observe();
    const bool is_going_on = state < stop_by_clock;
    record(is_going_on && (state & show_progress) != 0 ? Record::shown : Record::scheduled);
    write_outputs(Urgency::scheduled);
    if (observer) observer(self);
    if (now.step % steps_between_good_states == 0) keep_good_state();
    if (checkpoints.is_due_by_step(now.step) || (is_going_on && (state & checkpoint_due) != 0)) write_checkpoint();
    wall_clock.end_step();
  }
  // Before the outputs of the last step that are on no schedule: a run that goes on from here does not have them.
  write_checkpoint();
  record(Record::last);
  write_outputs(Urgency::last);
  if (phase_average) phase_average->write_files(options.output);

  RunResult result{RunEnd::end_time, 0, now.step, now.time};
  if (state >= stop_by_signal) {
    result.end = RunEnd::signal;
    result.signal = state - stop_by_signal;
  } else if (state >= stop_by_clock && !is_at_end()) {
    result.end = RunEnd::wall_clock;
  } else if (now.time < config.time.end) {
    result.end = RunEnd::max_steps;
  }
  return result;
}

void Simulation::Impl::introduce() const {
  const auto& n = config.box.cells;
  const auto build = build_info();
  log.info("Pliant {} ({}): {}", build.version, build.commit, config.title);
  log.info("{} x {} x {} cells on {} rank{}, {:.3g} MB for the flow on the first", n[0], n[1], n[2], ranks.size(),
           ranks.size() == 1 ? "" : "s", static_cast<double>(flow.bytes()) / 1e6);
  for (std::size_t k = 0; k < bodies.kinds().size(); ++k) log.info("{}", describe(bodies.kinds()[k], bodies.count(k)));
  log.info("until t = {:.6g}; outputs in {}", config.time.end, options.output.string());
  if (config.time.step && *config.time.step > flow.viscous_step_limit())
    log.warn(
        "time.step = {:.3g} is beyond the limit of the explicit viscous terms, {:.3g}: the run is likely to blow up",
        *config.time.step, flow.viscous_step_limit());
}

bool Simulation::Impl::is_at_end() const {
  return now.time >= config.time.end || (config.time.max_steps && now.step >= *config.time.max_steps);
}

double Simulation::Impl::choose_step() {
  const auto scope = timer.measure("diagnostics");
  const double rate = flow.step_rate();
  const auto limits = step_limits(config, grid, std::max({rate, side_rate, bodies_rate()}), flow.viscous_step_limit(),
                                  coupled->step_limit());
  // An output at the end but for rounding must not leave it a step of its own, whose forces would be round-off over it.
  constexpr double rounding = 1e-14;
  next_event = outputs->next_time(now.time);
  if (next_event > config.time.end * (1 - rounding)) next_event = config.time.end;
  const double step = step_towards(limits.smallest(), next_event - now.time);
  if (!(now.time + step > now.time))
    throw CollectiveError(
        fmt::format("step {} (t = {:.6g}): the time step has shrunk to {:.3g}, ruled by {}: the flow "
                    "has become too fast to follow; look at the last fields in {}",
                    now.step, now.time, step, limits.ruling(), options.output.string()));
  last_cfl = step * rate;
  if (now.step == first_step) warn_of_first_step(step);
  return step;
}

void Simulation::Impl::warn_of_first_step(double step) const {
  const double number = forcing_viscous_number(config, grid, step);
  for (const auto& kind : bodies.kinds())
    for (const auto& warning : foresee(kind, grid, step)) log.warn("{}", warning);
  if (!coupled->forces_late() || number <= largest_forcing_viscous_number) return;
  log.warn(
      "the step is {:.2g} h^2/nu of the smallest spacing h, above {}: the flow slips at the bodies and drag falls "
      "short by "
      "some per cent; watch slip_max, and lower time.max_step or raise immersed_boundary.forcing_iterations",
      number, largest_forcing_viscous_number);
}

void Simulation::Impl::advance(double step) {
  const double end = step == next_event - now.time ? next_event : now.time + step;
  try {
    coupled->follow_schedules(end - 0.5 * step);
    if (coupled->has_strong()) iterations = strong.advance(*coupled, end, step).iterations;
    else advance_loose(*coupled, end, step);
    coupled->advance_one_way_bodies(step);
    bodies.migrate();
  } catch (const CollectiveError& error) { body_problem = error.what(); }
  ++now.step;
  now.time = end;
}

// Bodies that move, or will, set the flow in motion as walls do.
double Simulation::Impl::bodies_rate() { return std::max(ranks.max(convective_rate(bodies)), path_rate); }

void Simulation::Impl::diagnose_bodies() {
  if (last_diagnosed == now.step) return;
  coupled->diagnose();
  last_diagnosed = now.step;
}

int Simulation::Impl::agree_on_state(const StopSignals& signals) {
  int state = 0;
  if (ranks.is_root()) {
    if (progress.is_due()) state += show_progress;
    if (checkpoints.is_due_by_clock()) state += checkpoint_due;
    if (wall_clock.is_time_to_stop(checkpoints.expected_seconds(flow))) state = stop_by_clock;
  }
  if (const int signal = signals.received()) state = stop_by_signal + signal;
  if (!body_problem.empty()) state = body_failed;
  if (!flow.may_be_finite()) state = flow_failed;
  return ranks.max(state);
}

void Simulation::Impl::record(Record wanted) {
  const bool history = outputs->is_history_due(now.step) || wanted == Record::last;
  const bool shown = wanted != Record::scheduled;
  if (!history && !shown) return;
  const auto scope = timer.measure("diagnostics");
  HistoryRow row;
  row.dt = dt;
  row.cfl = dt * flow.convective_rate();
  row.divergence = flow.largest_divergence();
  if (history) {
    row.kinetic_energy = flow.kinetic_energy();
    row.bulk_velocity = flow.bulk_velocity();
    row.bulk_forcing = flow.bulk_forcing();
    row.coupling_iterations = iterations;
    diagnose_bodies();
    for (const auto& patch : flow.patch_flow_rates()) row.patch_flow_rates.push_back(patch.value);
    measure_cavities();
    if (outputs->write_history(now, row, bodies, cavities)) note_energies(row.kinetic_energy * grid.volume());
  }
  if (shown && now.step != last_shown) progress.show({now.step, now.time, dt, row.cfl, row.divergence});
  if (shown) last_shown = now.step;
}

void Simulation::Impl::measure_cavities() {
  if (!cavities.any()) return;
  cavities.measure(now.time, flow, bodies);
  for (const auto& line : cavities.take_news()) {
    progress.finish();
    log.info("{}", line);
  }
}

void Simulation::Impl::note_energies(double of_fluid) {
  std::vector<double> all{of_fluid};
  for (std::size_t k = 0; k < bodies.kinds().size(); ++k)
    if (!bodies.kinds()[k].has_pose()) all.push_back(outputs->body_energies()[k]);
  if (all.size() > 1) energies.note(all);
}

// After every step.
void Simulation::Impl::observe() {
  hinge_times.observe(now.time, bodies);
  if (!phase_average || !phase_average->is_due(now.step)) return;
  const auto scope = timer.measure("phase averages");
  phase_average->add(now.time, flow.state());
}

void Simulation::Impl::summarize_run() {
  for (const auto& line : summarize(bodies)) log.info("{}", line);
  if (const auto line = energies.describe(); !line.empty()) log.info("{}", line);
  for (const auto& line : cavities.describe_unfinished()) log.info("{}", line);
  for (const auto& line : hinge_times.describe()) log.info("{}", line);
}

Json Simulation::Impl::results() const {
  auto all = Json::object();
  if (cavities.any()) all["cavities"] = cavities.results();
  if (hinge_times.any()) all["hinges"] = hinge_times.results();
  if (auto found = energies.results(); !found.empty()) all["energy"] = std::move(found);
  return all;
}

void Simulation::Impl::write_outputs(Urgency urgency) {
  const auto scope = timer.measure("output");
  if (outputs->has_surfaces_due(now, urgency)) diagnose_bodies();
  if (outputs->write_snapshots(now, flow, bodies, urgency)) report("running");
}

void Simulation::Impl::fail(int state) {
  const std::string where = fmt::format("step {} (t = {:.6g})", now.step, now.time);
  const std::string what = state >= flow_failed ? explain_flow_failure(bodies, flow, dt, last_cfl) : body_problem;
  std::string evidence = "The last state is in " + options.output.string();
  try {
    outputs->write_evidence(now, flow, bodies);
  } catch (const CollectiveError& error) {
    evidence = fmt::format("The last state could not be written: {}", error.what());
  }
  const auto note = write_good_state();
  throw CollectiveError(fmt::format("{}: {}. {}{}", where, what, evidence, note.empty() ? "" : ". " + note));
}

CheckpointHead Simulation::Impl::head() const {
  const auto build = build_info();
  CheckpointHead head;
  head.step = now.step;
  head.time = now.time;
  head.ranks = ranks.size();
  head.program = fmt::format("Pliant {} ({})", build.version, build.commit);
  head.case_text = case_text;
  ByteWriter run;
  run.write(dt);
  run.write(last_cfl);
  run.write(strong.state());
  cavities.write(run);
  hinge_times.write(run);
  energies.write(run);
  ByteWriter average;
  if (phase_average) phase_average->write(average);
  run.write(average.bytes());
  head.run = run.take();
  head.flow = flow.state_numbers();
  head.outputs = outputs->state().encode();
  return head;
}

void Simulation::Impl::write_checkpoint() {
  if (!checkpoints.are_wanted() || checkpoints.last_step() == now.step) return;
  const auto scope = timer.measure("checkpoints");
  is_checkpoint_failing = true;
  do_on_root(ranks, [&] { outputs->bring_to_disk(); });
  checkpoints.write(head(), flow, bodies.save(), tables());
  is_checkpoint_failing = false;
}

void Simulation::Impl::keep_good_state() {
  if (!checkpoints.are_wanted()) return;
  const auto scope = timer.measure("checkpoints");
  if (!good_state) good_state.emplace();
  good_state->head = head();
  flow.save_state(good_state->flow);
  good_state->bodies = bodies.save();
  if (phase_average) phase_average->keep();
}

// For a run that fails: the last state known to be good. Says where it is, or why it is nowhere.
std::string Simulation::Impl::write_good_state() {
  if (!good_state) return "";
  const auto good = *std::exchange(good_state, std::nullopt);
  std::string problem;
  if (checkpoints.last_step() < good.head.step) {
    try {
      flow.restore_state(good.flow);
      if (phase_average) phase_average->roll_back();
      checkpoints.write(good.head, flow, good.bodies, tables());
    } catch (const CollectiveError& error) { problem = error.what(); }
  }
  if (checkpoints.last_step() < 0) return fmt::format("No checkpoint could be written: {}", problem);
  return fmt::format("The checkpoint before it is {}", checkpoints.last_path().string());
}

void Simulation::Impl::report(const std::string& status) {
  const auto phases = slowest_phases();
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  do_on_root(ranks, [&] {
    run_report->set_results(results());
    run_report->write({status, now.step, now.time, wall, phases});
  });
}

PhaseTimer::Seconds Simulation::Impl::slowest_phases() {
  auto mine = timer.seconds();
  for (const auto& [phase, seconds] : flow.timer().seconds()) mine["fluid: " + phase] += seconds;
  for (const auto& [phase, seconds] : coupled->timer().seconds()) mine[phase] += seconds;
  return slowest_of(ranks, mine);
}

Simulation::Simulation(const CaseConfig& config, const Communicator& ranks, SimulationOptions options)
    : impl_(std::make_unique<Impl>(config, ranks, std::move(options))) {}
Simulation::~Simulation() = default;

RunResult Simulation::run(const Observer& observer) { return impl_->run(*this, observer); }
const CaseConfig& Simulation::config() const { return impl_->config; }
const FlowSolver& Simulation::flow() const { return impl_->flow; }
const Bodies& Simulation::bodies() const { return impl_->bodies; }
long Simulation::step() const { return impl_->now.step; }
double Simulation::time() const { return impl_->now.time; }

}  // namespace pliant
