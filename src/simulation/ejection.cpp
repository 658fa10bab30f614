#include "simulation/ejection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/validate.hpp"
#include "core/error.hpp"
#include "mesh/lids.hpp"
#include "signals/make_signal.hpp"

namespace pliant {
namespace {

/// What a flow brings in within a period from its beginning on.
struct Inflow {
  double least = 0, most = 0, at_end = 0;
};

Inflow integrate(const Signal& signal, double period, double factor) {
  constexpr int intervals = 20000;
  const double step = period / intervals;
  Inflow sum;
  for (int n = 0; n < intervals; ++n) {
    const double t = n * step;
    sum.at_end += factor * step / 6 * (signal.value(t) + 4 * signal.value(t + 0.5 * step) + signal.value(t + step));
    sum.least = std::min(sum.least, sum.at_end);
    sum.most = std::max(sum.most, sum.at_end);
  }
  return sum;
}

Ejection fit(const CavityConfig& cavity, CaseConfig& config, std::span<const PlacedBody> placed) {
  constexpr double largest_gain = 0.01;  // of the stroke
  const auto place = place_of(config, "cavity." + cavity.name + ".ejection_fraction");
  auto& signal = config.signals.at(cavity.flow);
  signal.scale = 1;
  const auto unscaled = make_signal(config, cavity.flow);
  const auto period = unscaled.period() ? unscaled.period() : cavity.period;
  if (!period)
    throw InputError(
        fmt::format("{} is of a cycle, but the signal \"{}\" has no period; give it one", place, cavity.flow));
  const auto inflow = integrate(unscaled, *period, cavity.flow_factor);
  const double stroke = inflow.most - inflow.least, fraction = *cavity.ejection_fraction;
  if (!(stroke > 0)) throw InputError(fmt::format("{} cannot be: the signal \"{}\" moves nothing", place, cavity.flow));
  if (std::abs(inflow.at_end) > largest_gain * stroke)
    throw InputError(fmt::format(
        "{}: the signal \"{}\" leaves the cavity {:.3g} of its stroke {} after each cycle; make what flows in and out "
        "the same",
        place, cavity.flow, std::abs(inflow.at_end) / stroke, inflow.at_end > 0 ? "larger" : "smaller"));
  const double volume = start_volume(cavity, config, placed);
  signal.scale = fraction * volume / (stroke - fraction * inflow.most);
  const auto scaled = integrate(make_signal(config, cavity.flow), *period, cavity.flow_factor);
  if (std::abs(scaled.most - scaled.least - signal.scale * stroke) > 1e-9 * signal.scale * stroke)
    throw InputError(
        fmt::format("{}: the scale of the signal \"{}\" does not set its size, as another of its keys does; "
                    "remove that",
                    place, cavity.flow));
  return {cavity.name, cavity.flow, volume, volume + signal.scale * inflow.least, volume + signal.scale * inflow.most,
          signal.scale};
}

}  // namespace

double start_volume(const CavityConfig& cavity, const CaseConfig& config, std::span<const PlacedBody> placed) {
  std::size_t b = 0;
  while (config.bodies[b].name != cavity.body) ++b;
  const auto& shape = placed[b].shape;
  const LiddedSurface surface(shape.mesh);
  const auto positions = surface.with_hubs(shape.positions);
  return std::abs(enclosed_volume_and_rate(surface.faces(), positions, positions).volume);
}

std::vector<Ejection> set_ejection_scales(CaseConfig& config, std::span<const PlacedBody> placed) {
  std::vector<Ejection> fits;
  for (const auto& cavity : config.cavities)
    if (cavity.ejection_fraction) fits.push_back(fit(cavity, config, placed));
  return fits;
}

}  // namespace pliant
