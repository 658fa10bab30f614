#include "coupling/hamming.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace pliant {
namespace {

constexpr double modify = 112.0 / 121.0;
constexpr double finish = 9.0 / 121.0;

/// Adams' weights of f_n, f_n-1 .. for the guess, and of f, f_n, f_n-1 .. for the corrector, with k levels known.
constexpr double bashforth[3][3] = {{1, 0, 0}, {3.0 / 2, -1.0 / 2, 0}, {23.0 / 12, -16.0 / 12, 5.0 / 12}};
constexpr double moulton[3][4] = {
    {1.0 / 2, 1.0 / 2, 0, 0}, {5.0 / 12, 8.0 / 12, -1.0 / 12, 0}, {9.0 / 24, 19.0 / 24, -5.0 / 24, 1.0 / 24}};

}  // namespace

Hamming::Hamming(std::span<const double> y, std::span<const double> f)
    : Hamming({Level{{y.begin(), y.end()}, {f.begin(), f.end()}}}, 0.0) {}

Hamming::Hamming(std::vector<Level> levels, double step)
    : size_(levels.back().y.size()), n_levels_(static_cast<int>(std::min<std::size_t>(4, levels.size()))), step_(step) {
  for (int k = 0; k < n_levels_; ++k) levels_[k] = std::move(levels[levels.size() - 1 - k]);
  for (auto* work : {&gap_, &predicted_, &corrected_, &result_, &new_rate_}) work->assign(size_, 0.0);
}

std::span<const double> Hamming::predict(double step) {
  // A step that is a difference of two times carries their round-off.
  constexpr double same = 1e-9;
  if (n_levels_ > 1 && std::abs(step - step_) > same * std::abs(step_)) {
    n_levels_ = 1;
    has_gap_ = false;
  }
  step_ = step;
  for (std::size_t i = 0; i < size_; ++i) {
    if (is_full_step()) {
      predicted_[i] =
          levels_[3].y[i] + 4.0 / 3.0 * step * (2.0 * levels_[0].f[i] - levels_[1].f[i] + 2.0 * levels_[2].f[i]);
      result_[i] = predicted_[i] + (has_gap_ ? modify * gap_[i] : 0.0);
    } else {
      double rate = 0;
      for (int k = 0; k < n_levels_; ++k) rate += bashforth[n_levels_ - 1][k] * levels_[k].f[i];
      result_[i] = predicted_[i] = levels_[0].y[i] + step * rate;
    }
  }
  // A step may be accepted as guessed, with the last known rate.
  corrected_ = result_;
  new_rate_ = levels_[0].f;
  return result_;
}

std::span<const double> Hamming::correct(std::span<const double> rate) {
  std::copy(rate.begin(), rate.end(), new_rate_.begin());
  for (std::size_t i = 0; i < size_; ++i) {
    if (is_full_step()) {
      corrected_[i] = 0.125 * (9.0 * levels_[0].y[i] - levels_[2].y[i] +
                               3.0 * step_ * (rate[i] + 2.0 * levels_[0].f[i] - levels_[1].f[i]));
      result_[i] = corrected_[i] + finish * (predicted_[i] - corrected_[i]);
    } else {
      const auto& weights = moulton[n_levels_ - 1];
      double mean = weights[0] * rate[i];
      for (int k = 0; k < n_levels_; ++k) mean += weights[k + 1] * levels_[k].f[i];
      result_[i] = corrected_[i] = levels_[0].y[i] + step_ * mean;
    }
  }
  return result_;
}

void Hamming::accept() {
  has_gap_ = is_full_step();
  for (std::size_t i = 0; i < size_; ++i) gap_[i] = corrected_[i] - predicted_[i];
  std::rotate(levels_.begin(), levels_.end() - 1, levels_.end());
  levels_[0] = {result_, new_rate_};
  n_levels_ = std::min(n_levels_ + 1, 4);
}

std::vector<double> Hamming::state() const {
  std::vector<double> state{static_cast<double>(size_), static_cast<double>(n_levels_), step_, has_gap_ ? 1.0 : 0.0};
  const auto append = [&](const std::vector<double>& values) {
    state.insert(state.end(), values.begin(), values.end());
  };
  for (int k = n_levels_ - 1; k >= 0; --k) {
    append(levels_[k].y);
    append(levels_[k].f);
  }
  append(gap_);
  return state;
}

Hamming Hamming::from_state(std::span<const double> state) {
  const RunError damaged("The saved state of Hamming's scheme is damaged.");
  if (state.size() < 4 || !(state[1] >= 1 && state[1] <= 4) || !(state[0] >= 0 && state[0] < 1e15)) throw damaged;
  const auto size = static_cast<std::size_t>(state[0]), n_levels = static_cast<std::size_t>(state[1]);
  if (state.size() != 4 + (2 * n_levels + 1) * size) throw damaged;
  auto next = state.begin() + 4;
  const auto take = [&] {
    std::vector<double> values(next, next + static_cast<std::ptrdiff_t>(size));
    next += static_cast<std::ptrdiff_t>(size);
    return values;
  };
  std::vector<Level> levels(n_levels);
  for (Level& level : levels) {
    level.y = take();
    level.f = take();
  }
  Hamming hamming(std::move(levels), state[2]);
  hamming.gap_ = take();
  hamming.has_gap_ = state[3] != 0;
  return hamming;
}

}  // namespace pliant
