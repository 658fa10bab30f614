#include "coupling/aitken.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"

namespace pliant {

AitkenRelaxation::AitkenRelaxation(Communicator ranks, double first_factor, double largest_factor)
    : ranks_(ranks), first_factor_(first_factor), largest_factor_(largest_factor), factor_(first_factor) {}

void AitkenRelaxation::restart() {
  const double size = std::abs(factor_);
  factor_ = size > 0 ? std::min(size, first_factor_) : first_factor_;
  has_residual_ = false;
}

double AitkenRelaxation::relax(std::span<double> x, std::span<const double> image) {
  const std::size_t n = x.size();
  if (!has_residual_) residual_.assign(n, 0.0);
  // Number of values, r.r, r_old.dr, dr.dr with dr = r - r_old.
  std::array<double, 4> sums{static_cast<double>(n), 0, 0, 0};
  for (std::size_t i = 0; i < n; ++i) {
    const double r = image[i] - x[i], change = r - residual_[i];
    sums[1] += r * r;
    sums[2] += residual_[i] * change;
    sums[3] += change * change;
    residual_[i] = r;
  }
  ranks_.sum(sums);
  if (has_residual_ && sums[3] > 0)
    factor_ = std::clamp(-factor_ * sums[2] / sums[3], -largest_factor_, largest_factor_);
  has_residual_ = true;
  for (std::size_t i = 0; i < n; ++i) x[i] += factor_ * residual_[i];
  return sums[0] > 0 ? std::sqrt(sums[1] / sums[0]) : 0.0;
}

void AitkenRelaxation::restore(std::span<const double> state) {
  if (state.size() != 1 || !std::isfinite(state[0])) throw RunError("The saved state of a relaxation is damaged.");
  factor_ = state[0];
  has_residual_ = false;
}

}  // namespace pliant
