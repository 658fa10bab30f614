#include "app/shear_calibration.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "config/validate.hpp"
#include "core/error.hpp"

namespace pliant {
namespace {
/// Mean over time by the trapezoidal rule.
ShapeSample mean_of(std::span<const ShapeSample> samples) {
  ShapeSample sum{0, 0, 0, 0, 0};
  double span = 0;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const auto &a = samples[i], &b = samples[i + 1];
    const double half = 0.5 * (b.time - a.time);
    sum.time += half * (a.time + b.time);
    sum.major += half * (a.major + b.major);
    sum.minor += half * (a.minor + b.minor);
    sum.width += half * (a.width + b.width);
    sum.angle += half * (a.angle + b.angle);
    span += 2 * half;
  }
  return {sum.time / span, sum.major / span, sum.minor / span, sum.width / span, sum.angle / span};
}

double deformation(const ShapeSample& shape) { return (shape.major - shape.minor) / (shape.major + shape.minor); }
}  // namespace

double shear_rate(const CaseConfig& config) {
  const auto* bottom = std::get_if<WallSide>(&config.boundary[4]);
  const auto* top = std::get_if<WallSide>(&config.boundary[5]);
  const double rate = bottom && top ? (top->velocity.x - bottom->velocity.x) / config.box.size.z : 0;
  const bool along_x = bottom && top && top->velocity.y == bottom->velocity.y;
  if (!(rate > 0) || !along_x)
    throw InputError(
        fmt::format("{}: calibrate needs a shear along x between walls of z: give boundary.\"z-\" and "
                    "boundary.\"z+\" the type \"wall\", and z+ the larger x velocity",
                    config.file.string()));
  return rate;
}

ShearCalibration calibrate_shear(const std::vector<ShapeSample>& samples, double window_begin, double viscosity,
                                 double rate, double radius) {
  std::span<const ShapeSample> window(samples);
  while (!window.empty() && window.front().time < window_begin) window = window.subspan(1);
  if (window.size() < 5)
    throw RunError(
        fmt::format("only {} steps lie between the time {} and the end of the run; average from an earlier "
                    "time (--average-from), or run longer (time.end)",
                    window.size(), window_begin));
  const auto middle = window.size() / 2;
  ShearCalibration result;
  result.shear_rate = rate;
  result.radius = radius;
  result.window_begin = window.front().time;
  result.window_end = window.back().time;
  result.mean = mean_of(window);
  const double before = deformation(mean_of(window.first(middle + 1))),
               after = deformation(mean_of(window.subspan(middle)));
  result.drift = (after - before) / deformation(result.mean);
  result.fit = fit_capillary(result.mean.major, result.mean.minor);
  result.surface_tension = viscosity * rate * radius / result.fit.capillary;
  result.model = maffettone_minale(result.fit.capillary);
  return result;
}

}  // namespace pliant
