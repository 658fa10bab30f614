#pragma once
#include <span>
#include <vector>

#include "parallel/communicator.hpp"

namespace pliant {

/// What two iterations say of a fixed point: the differences of their residuals and of their images, this rank's part.
struct Secant {
  std::vector<double> residual, image;
  int age = 0;  ///< steps since
};

/// Interface quasi-Newton for a fixed point x = G(x) with many unknowns (IQN-ILS; Degroote, Bathe & Vierendeels,
/// Comput. Struct. 87 (2009) 793-801): from the residuals r = G(x) - x and images of earlier iterations,
///   x_k+1 = x_k + U c + w (r_k + V c),  c: min |V c + r_k|,  V = [r_i - r_k], U = [x_i - x_k].
/// w, the first factor, is for what secants say nothing of: a light wall answers with many times what it was told, and
/// 1 lets that grow until secants say it all (13 iterations, 10 with 0.3, for a wall of 0.03 of the fluid's mass).
/// Secants of the last `reuse` fixed points serve too, as long as they are linearly independent of newer ones: what G
/// does to many unknowns takes many iterations to learn, and changes little from step to step.
/// Each rank holds its own part of x; least squares run over all ranks.
class QuasiNewton {
 public:
  static constexpr std::size_t most_secants = 60;

  explicit QuasiNewton(Communicator ranks, double first_factor = 0.5, int reuse = 0);

  /// Begins a new fixed point, of any size, with the secants that earlier ones have left, newest first; the same number
  /// on all ranks. Collective.
  void restart(std::vector<Secant> kept = {});
  /// Moves x towards G(x). Collective.
  void relax(std::span<double> x, std::span<const double> image);
  /// For the next fixed points of the same unknowns, newest first.
  std::vector<Secant> secants_to_keep() const;

 private:
  void learn(std::span<const double> residual, std::span<const double> image);
  std::vector<double> products_with(std::span<const double> residual) const;
  std::vector<double> solve(std::vector<double> of_residual) const;

  Communicator ranks_;
  double first_factor_;
  int reuse_;
  bool has_last_ = false;
  std::vector<double> last_residual_, last_image_;
  std::vector<Secant> known_;                  // newest first
  std::vector<std::vector<double>> products_;  // of their residuals
};

}  // namespace pliant
