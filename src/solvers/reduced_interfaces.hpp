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
/// the ranks: each rank solves its share for all slabs. Two all-to-all exchanges a solve, of two values a line there
/// and two back; nothing is divided or allocated in it.
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
  /// 2 x 2 matrices (a b; c d) of every interface and line of the share, or of every interface alone.
  struct Matrices {
    std::vector<double> a, b, c, d;
    void resize(std::size_t n);
  };
  /// The lines' unknowns at an interface: the last of the slab below it and the first of the slab above it.
  struct Interface {
    double* low;
    double* high;
  };
  void factorise(const std::vector<double>& closures);
  void factorise_line(const std::vector<double>& closures, std::size_t line);
  template <class At>
  void solve_share(At at);
  Interface interface(int t);
  void send_to_shares(const double* y_first, const double* y_last);
  void return_from_shares(double* y_first, double* y_last);
  void exchange(const std::vector<int>& counts, const std::vector<int>& offsets, std::vector<double>& from,
                const std::vector<int>& receive_counts, const std::vector<int>& receive_offsets,
                std::vector<double>& to) const;

  Communicator ranks_;
  bool periodic_, coupled_;
  int interfaces_;  // of a line
  std::size_t lines_, share_;
  std::vector<int> counts_, offsets_;                  // values of each rank's share: first and last of its lines
  std::vector<int> receive_counts_, receive_offsets_;  // this rank's share from each rank
  bool per_line_ = false;
  // Block elimination over the interfaces of a line; a periodic line keeps its last interface as a border.
  std::size_t line_count_ = 0;          // lines with coefficients of their own
  Matrices factor_, inverse_, border_;  // [interface][line]
  std::vector<double> lower_, upper_;   // the only entries of the coupling to the interfaces below and above
  std::vector<double> lines_buffer_;    // [rank][first, last][line of the rank's share]
  std::vector<double> share_buffer_;    // [slab][first, last][line of this share]
};

}  // namespace pliant
