#include "coupling/strong.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "coupling/loose.hpp"
#include "coupling/strong_unknowns.hpp"
#include "parallel/agree.hpp"

namespace pliant {
namespace {

void apply(StrongUnknowns& unknowns, const Communicator& ranks) {
  std::string problem;
  try {
    unknowns.apply();
  } catch (const RunError& error) { problem = error.what(); }
  agree(ranks, problem);
}

bool uses_quasi_newton(CoupledFlow& coupled) {
  const auto scheme = coupled.settings().scheme;
  if (scheme != StrongScheme::automatic) return scheme == StrongScheme::quasi_newton;
  const auto kinds = coupled.bodies().kinds();
  return std::any_of(kinds.begin(), kinds.end(),
                     [](const BodyKind& kind) { return !kind.has_pose() && kind.coupling == CouplingKind::strong; });
}

}  // namespace

StrongCoupling::StrongCoupling(const Communicator& ranks, const CouplingConfig& settings)
    : ranks_(ranks),
      settings_(settings),
      relaxation_(ranks, settings.relaxation),
      quasi_newton_(ranks, settings.relaxation, settings.reuse) {}

// Speaks for the body that changes most: agree takes the word of the rank that holds it.
void StrongCoupling::fail(const StrongUnknowns& unknowns, std::span<const double> image, double change,
                          const StrongReport& report) const {
  const auto worst = unknowns.largest_change(image);
  const auto text = fmt::format(
      "strong coupling did not converge in {} iterations: velocities still change by {:.3g} of the largest one, "
      "coupling.tolerance is {:.3g}; take a smaller step, a lower coupling.relaxation, or more "
      "coupling.max_iterations",
      report.iterations, report.residual, settings_.tolerance);
  const auto body = unknowns.body_of_largest_change(image);
  agree(ranks_, worst < change || body.empty() ? "" : fmt::format("body '{}': {}", body, text));
  throw CollectiveError(text);
}

StrongReport StrongCoupling::advance(CoupledFlow& coupled, double time, double step) {
  coupled.flow().save_state(start_);
  coupled.save_soft_bodies();
  move_prescribed(coupled.bodies(), time);
  StrongUnknowns unknowns(coupled, step);
  const bool by_secants = uses_quasi_newton(coupled);
  relaxation_.restart();
  if (by_secants) quasi_newton_.restart(unknowns.kept_secants());
  StrongReport report;
  // Below this no velocity is worth telling from another: a cell in a billion steps.
  const double floor = 1e-9 * coupled.flow().grid().dx() / step;
  while (true) {
    ++report.iterations;
    if (report.iterations > 1) {
      coupled.flow().restore_state(start_);
      coupled.restore_soft_bodies();
    }
    unknowns.rewind();
    coupled.begin_contact(step);
    apply(unknowns, ranks_);
    coupled.place_markers();
    coupled.advance_fluid(step);
    coupled.find_loads(step);
    const auto image = unknowns.image();
    const double change = ranks_.max(unknowns.largest_change(image));
    const double scale = std::max(ranks_.max(unknowns.largest_velocity()), floor);
    report.residual = change / scale;
    if (report.residual <= settings_.tolerance) break;
    if (report.iterations >= settings_.max_iterations || !std::isfinite(report.residual))
      fail(unknowns, image, change, report);
    if (by_secants) quasi_newton_.relax(unknowns.values(), image);
    else relaxation_.relax(unknowns.values(), image);
  }
  unknowns.accept();
  if (by_secants) unknowns.keep(quasi_newton_.secants_to_keep());
  coupled.finish_soft_bodies(step);
  coupled.accept();
  advance_loose_bodies(coupled, step);
  coupled.end_contact(step);
  return report;
}

}  // namespace pliant
