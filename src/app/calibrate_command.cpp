#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "app/load_case.hpp"
#include "app/output_name.hpp"
#include "app/shear_calibration.hpp"
#include "core/error.hpp"
#include "diagnostics/shape.hpp"
#include "simulation/simulation.hpp"

namespace pliant {
namespace {
enum class ReportStyle { text, json };

struct CalibrateArguments {
  CaseArguments input;
  std::string output, body;
  std::optional<double> average_from;
  ReportStyle style = ReportStyle::text;
};

/// The body to calibrate: the one named, or the only deformable one.
std::size_t find_body(const CaseConfig& config, const std::string& name) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < config.bodies.size(); ++i) {
    const auto& body = config.bodies[i];
    if (body.motion == MotionKind::deformable && (name.empty() || body.name == name)) found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  if (found.empty())
    throw InputError(name.empty() ? fmt::format("{}: has no deformable body to calibrate", config.file.string())
                                  : fmt::format("{}: has no deformable body \"{}\"", config.file.string(), name));
  throw InputError(
      fmt::format("{}: has {} deformable bodies; choose one with --body", config.file.string(), found.size()));
}

/// The drop's shape now, the same on all ranks: the one that holds it tells it to the others.
ShapeSample sample(const Simulation& simulation, long id) {
  std::array<double, 4> numbers{};
  if (const Body* drop = simulation.bodies().find(id)) {
    const auto shape = fit_ellipsoid(drop->surface.mesh, drop->surface.positions);
    const double radius = drop->surface.radius;
    numbers = {shape.length / radius, shape.breadth / radius, shape.width / radius, shape.angle};
  }
  simulation.bodies().grid().ranks().sum(numbers);
  return {simulation.time(), numbers[0], numbers[1], numbers[2], numbers[3]};
}

void print_text(const ShearCalibration& c) {
  fmt::print("body                {}\n", c.body);
  fmt::print("shear rate          {:.6g}\n", c.shear_rate);
  fmt::print("radius              {:.6g}\n", c.radius);
  fmt::print("averaged over time  {:.6g} to {:.6g}\n", c.window_begin, c.window_end);
  fmt::print("L, B, W over R      {:.5f} {:.5f} {:.5f}\n", c.mean.major, c.mean.minor, c.mean.width);
  fmt::print("capillary number    {:.6g}\n", c.fit.capillary);
  fmt::print("surface tension     {:.6g}\n", c.surface_tension);
  fmt::print("residual of L, B    {:.3g} (rms; Maffettone-Minale has L {:.5f}, B {:.5f})\n", c.fit.residual,
             c.model.major, c.model.minor);
  fmt::print("angle [deg]         {:.3f} (Maffettone-Minale {:.3f})\n", c.mean.angle, c.model.angle);
  fmt::print("drift               {:.2f} % of the deformation between the halves of the window{}\n", 100 * c.drift,
             std::abs(c.drift) > 0.01 ? ": NOT STEADY, run longer or average from a later time" : "");
}

void print_json(const ShearCalibration& c) {
  const nlohmann::ordered_json report{{"body", c.body},
                                      {"shear_rate", c.shear_rate},
                                      {"radius", c.radius},
                                      {"window", {c.window_begin, c.window_end}},
                                      {"L", c.mean.major},
                                      {"B", c.mean.minor},
                                      {"W", c.mean.width},
                                      {"angle", c.mean.angle},
                                      {"capillary_number", c.fit.capillary},
                                      {"surface_tension", c.surface_tension},
                                      {"residual", c.fit.residual},
                                      {"model", {{"L", c.model.major}, {"B", c.model.minor}, {"angle", c.model.angle}}},
                                      {"drift", c.drift}};
  fmt::print("{}\n", report.dump(2));
}

int calibrate(const CalibrateArguments& arguments, const Communicator& ranks) {
  auto config = load_case(arguments.input, ranks);
  // The average is over the whole run, so there is nothing to continue.
  config.checkpoint.keep = 0;
  const auto body = find_body(config, arguments.body);
  const double rate = shear_rate(config);
  SimulationOptions options;
  // Not the folder of `run`: what is there may be wanted.
  options.output =
      arguments.output.empty() ? default_output(config) += "-calibration" : std::filesystem::path(arguments.output);
  // Standard output is for the report alone when a program reads it.
  if (arguments.style == ReportStyle::json) options.progress = ProgressStyle::silent;
  Simulation simulation(config, ranks, options);
  std::vector<ShapeSample> samples;
  const long id = simulation.bodies().first_id(body);
  const auto end = simulation.run([&](const Simulation& now) { samples.push_back(sample(now, id)); });
  if (end.end == RunEnd::signal) return end.exit_code();
  const double begin = arguments.average_from.value_or(0.5 * end.time);
  auto result =
      calibrate_shear(samples, begin, config.fluid.viscosity, rate, simulation.bodies().kinds()[body].prototype.radius);
  result.body = config.bodies[body].name;
  if (ranks.is_root()) arguments.style == ReportStyle::json ? print_json(result) : print_text(result);
  return exit_success;
}
}  // namespace

void add_calibrate_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<CalibrateArguments>();
  auto* command = app.add_subcommand(
      "calibrate", "Run a drop in shear; print the capillary number and surface tension that its constants stand for");
  add_case_arguments(*command, arguments->input);
  command
      ->add_option("--out", arguments->output,
                   "Folder for the outputs; default: out/ and the name of the case, -calibration")
      ->type_name("DIR");
  command->add_option("--body", arguments->body, "The body, if there are several")->type_name("NAME");
  command->add_option("--average-from", arguments->average_from, "Average from this time; default: half of the run")
      ->type_name("T");
  command->add_flag_callback(
      "--json", [arguments] { arguments->style = ReportStyle::json; }, "Print JSON, and nothing else");
  command->callback([arguments, &action] {
    action = [arguments](const Communicator& ranks) { return calibrate(*arguments, ranks); };
  });
}

}  // namespace pliant
