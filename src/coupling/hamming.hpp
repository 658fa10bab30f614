#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace pliant {

/// Hamming's fourth-order predictor, modifier and corrector for y' = f (Hamming, J. ACM 6 (1959) 37-47), made for
/// strong coupling: f comes from outside, and the corrector may be repeated until y stays.
///   P = y_n-3 + 4h/3 (2 f_n - f_n-1 + 2 f_n-2),  guess = P + 112/121 (C_n - P_n),
///   C = (9 y_n - y_n-2 + 3h (f + 2 f_n - f_n-1)) / 8,  y_n+1 = C + 9/121 (P - C).
/// A step: guess = predict(h); then y = correct(f(guess)), y = correct(f(y)) .. as often as wished; accept().
///
/// The first three steps, and those after a change of h, for which the history is dropped, use Adams' formulae of
/// rising order with as much history as there is (trapezoidal rule, then third and fourth order). The one trapezoidal
/// step makes the whole third order unless the history is given (start with several levels); a run whose step changes
/// all the time is second order.
class Hamming {
 public:
  struct Level {
    std::vector<double> y, f;
  };

  Hamming() = default;
  /// The value and its rate at the start.
  Hamming(std::span<const double> y, std::span<const double> f);
  /// Known levels `step` apart, oldest first, at least 1; the last four are used. All have the same size.
  Hamming(std::vector<Level> levels, double step);

  /// Begins a step of length `step` and returns the guess of y at its end. Discards a step that was not accepted.
  std::span<const double> predict(double step);
  /// y at the end of the step, if the rate there is `rate`.
  std::span<const double> correct(std::span<const double> rate);
  /// Ends the step with the last y and the last rate.
  void accept();

  std::size_t size() const { return size_; }
  /// y of the last accepted step, and its rate.
  std::span<const double> value() const { return levels_[0].y; }
  std::span<const double> rate() const { return levels_[0].f; }
  /// Number of levels in the history, 1 to 4; with 4 a step of unchanged length is Hamming's.
  int n_levels() const { return n_levels_; }

  /// All that a checkpoint between two steps needs, as plain numbers, and the way back. Throws RunError if `state` is
  /// not such a list.
  std::vector<double> state() const;
  static Hamming from_state(std::span<const double> state);

 private:
  bool is_full_step() const { return n_levels_ == 4; }

  std::size_t size_ = 0;
  int n_levels_ = 0;
  std::array<Level, 4> levels_;  ///< newest first
  double step_ = 0;              ///< between levels; 0: only one is known
  bool has_gap_ = false;         ///< the last step was Hamming's, gap_ is of it
  std::vector<double> gap_;      ///< C_n - P_n

  std::vector<double> predicted_, corrected_, result_, new_rate_;
};

}  // namespace pliant
