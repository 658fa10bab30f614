#pragma once
#include <vector>

#include "parallel/communicator.hpp"

namespace pliant {

/// What a slab's first and last unknown of one line feel of the neighbouring slabs:
/// first = y_first + first_below X_below + first_above X_above, and likewise last, where X_below is the last unknown of
/// the slab below and X_above the first of the slab above.
struct Closure {
  double first_below = 0, first_above = 0, last_below = 0, last_above = 0;
};

/// Solves the small systems that couple the slabs' end unknowns, for many lines at once. The lines are shared out over
/// the ranks: each rank solves its share for all slabs. Two all-to-all exchanges of two values a line a solve.
class ReducedInterfaces {
 public:
  enum class Ends { bounded, periodic };
  ReducedInterfaces(const Communicator& ranks, Ends ends, std::size_t lines);

  /// True if a slab has neighbours (or itself, if periodic): otherwise there is nothing to solve.
  bool is_coupled() const { return coupled_; }

  /// Sets the coefficients. Collective. One closure for all lines.
  void set_closure(const Closure& closure);
  /// One closure a line; arrays of `lines` values.
  void set_closure(const double* first_below, const double* first_above, const double* last_below,
                   const double* last_above);

  /// y_first, y_last: `lines` values each; overwritten by X_below and X_above. Collective.
  void solve(double* y_first, double* y_last);

  std::size_t bytes() const;

 private:
  void solve_share();

  Communicator ranks_;
  bool periodic_, coupled_;
  std::size_t lines_, share_;
  std::vector<int> counts_, offsets_;                  // lines of each rank's share
  std::vector<int> receive_counts_, receive_offsets_;  // this rank's share from each rank
  std::vector<double> coefficients_;                   // [closure entry][slab][line of the share], or [entry][slab]
  std::size_t line_step_ = 0;                          // 0: one closure for all lines
  std::vector<double> first_, last_;                   // [slab][line of the share]
};

}  // namespace pliant
