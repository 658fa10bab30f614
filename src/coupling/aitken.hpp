#pragma once
#include <span>
#include <vector>

#include "parallel/communicator.hpp"

namespace pliant {

/// Dynamic relaxation of a fixed point x = G(x) (Aitken; Kuettler & Wall, Comput. Mech. 43 (2008) 61-72):
///   x_k+1 = x_k + w_k r_k,  r_k = G(x_k) - x_k,  w_k = -w_k-1 r_k-1 . (r_k - r_k-1) / |r_k - r_k-1|^2.
/// It finds the solution where x_k+1 = G(x_k) runs away, if one number can stand for the slope of G.
/// Each rank holds its own part of x, none or some; the products run over all ranks, so w is the same on each.
class AitkenRelaxation {
 public:
  /// The first factor of each solve is `first_factor`, later ones of the first solve too until two residuals are known;
  /// no factor's size exceeds `largest_factor`.
  explicit AitkenRelaxation(Communicator ranks, double first_factor = 0.5, double largest_factor = 2.0);

  /// Begins a new fixed point, of any size. Its first factor is the last one of the solve before, but no larger in size
  /// than `first_factor`, and positive.
  void restart();

  /// Moves x towards G(x). Both have the same size, which stays until restart(). Collective. Returns the root mean
  /// square of G(x) - x over all ranks, of the x that was given; not finite on every rank if any value is not.
  double relax(std::span<double> x, std::span<const double> image);

  double factor() const { return factor_; }

  /// All that a checkpoint between two solves needs, and the way back.
  std::vector<double> state() const { return {factor_}; }
  void restore(std::span<const double> state);

 private:
  Communicator ranks_;
  double first_factor_, largest_factor_;
  double factor_;
  bool has_residual_ = false;
  std::vector<double> residual_;
};

}  // namespace pliant
