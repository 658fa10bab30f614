#pragma once
#include <span>
#include <vector>

#include "parallel/communicator.hpp"

namespace pliant {

/// Interface quasi-Newton for a fixed point x = G(x) with many unknowns (IQN-ILS; Degroote, Bathe & Vierendeels,
/// Comput. Struct. 87 (2009) 793-801): from the residuals r = G(x) - x and images of earlier iterations,
///   x_k+1 = G(x_k) + W c,  c: min |V c + r_k|,  V = [r_i - r_k], W = [G(x_i) - G(x_k)].
/// Nothing is kept from step to step, so that a run goes on from a checkpoint as if it had not stopped. The first
/// iteration moves by `first_factor` times the residual.
/// Each rank holds its own part of x; least squares run over all ranks.
class QuasiNewton {
 public:
  explicit QuasiNewton(Communicator ranks, double first_factor = 0.5);

  /// Begins a new fixed point, of any size.
  void restart();
  /// Moves x towards G(x). Collective.
  void relax(std::span<double> x, std::span<const double> image);

 private:
  using Column = std::vector<double>;
  struct Known {
    Column residual, image;  // differences
  };
  double product(const Column& a, const Column& b) const;

  Communicator ranks_;
  double first_factor_;
  bool has_last_ = false;
  Column last_residual_, last_image_;
  std::vector<Known> known_;  // newest first
};

}  // namespace pliant
