#pragma once
#include <cstddef>
#include <functional>
#include <vector>

#include "solvers/reduced_interfaces.hpp"

namespace pliant {

/// A plane of lines: `rows` rows of `width` values, `stride` apart.
struct LinePlane {
  int width = 0, rows = 0;
  std::ptrdiff_t stride = 0;
};

/// Coefficients of lower_k x_{k-1} + diagonal_k x_k + upper_k x_{k+1} = d_k over one slab, neighbours' unknowns
/// included.
struct SlabRows {
  std::vector<double> lower, diagonal, upper;
};

/// Solves many tridiagonal systems along z at once, plane by plane; each rank holds the planes of its slab.
///
/// Use: eliminate all rows of the planes in the given order (ascending k unless told otherwise), then couple(), then
/// substitute in the reverse order; a plane needs the one treated before it. On one rank with bounded ends this is the
/// Thomas algorithm; otherwise each slab reduces to its two end unknowns, ReducedInterfaces solves for the neighbours',
/// and substitution takes them in. Planes are never transposed.
class SlabTridiagonal {
 public:
  using Ends = ReducedInterfaces::Ends;
  enum class Order { ascending, descending };  ///< of the elimination

  /// Lines that share one set of coefficients.
  SlabTridiagonal(const Communicator& ranks, Ends ends, int planes, LinePlane lines, Order order = Order::ascending);
  /// The same coefficients but for a shift of the diagonal, shift(row, i), constant in z: the modes of a transform.
  /// `fold` maps a row to the row whose shifts it shares (rows of equal wave number), so that tables are kept once.
  SlabTridiagonal(const Communicator& ranks, Ends ends, int planes, LinePlane lines, std::vector<int> fold,
                  const std::function<double(int row, int i)>& shift);

  /// Factorises. Collective.
  void set_coefficients(const SlabRows& rows);
  /// With, for the lines i < pinned of row 0 alone, an addition to the diagonal of their first plane (pins a singular
  /// mode). Collective.
  void set_coefficients(const SlabRows& rows, int pinned, double addition);

  /// Eliminates a row of plane k in place; `before`: the same row of the plane eliminated before it, not read at first.
  void eliminate_row(int k, int row, double* d, const double* before);
  /// The same for the right-hand side d + T x, T the matrix and x three rows of any old solution. One set of
  /// coefficients only.
  void eliminate_row_added(int k, int row, double* d, const double* before, const double* x_below, const double* x,
                           const double* x_above);
  /// Collective.
  void couple();
  /// Substitutes a row of plane k: x from the eliminated d (may be x itself) and the same row of the plane substituted
  /// before it, not read at first.
  void substitute_row(int k, int row, const double* d, const double* before, double* x) const;

  /// Whole planes in place.
  void eliminate(int k, double* plane, const double* before);
  void substitute(int k, double* plane, const double* before) const;

  /// True if slabs hang together, or one with itself.
  bool is_coupled() const { return interfaces_.is_coupled(); }
  /// After couple(), the unknowns of the plane that was eliminated second, without substitution, so that it and the
  /// first are known before all others. Ascending per-mode systems of coupled slabs with two planes or more.
  void find_second_plane(double* plane) const;

  std::size_t bytes() const;

 private:
  struct Uniform;
  struct PerMode;
  template <class Table>
  void reduce_row(const Table& table, int step, int row, const double* d);
  template <class Table, class Source>
  void eliminate_with(const Table& table, int step, int row, double* d, const double* before, const Source& source);
  template <class Table>
  void substitute_with(const Table& table, int step, int row, const double* d, const double* before, double* x) const;
  void factorise_lines(int row, int i, double shift, double addition, Closure& closure, Closure& second);
  std::size_t table_index(int step, int table_row) const {
    return (static_cast<std::size_t>(step) * table_rows_ + static_cast<std::size_t>(table_row)) * table_width_;
  }
  int step_of(int k) const { return order_ == Order::ascending ? k : planes_ - 1 - k; }

  int planes_;
  LinePlane lines_;
  bool per_mode_;
  Order order_ = Order::ascending;
  std::vector<int> fold_;
  std::vector<double> shift_;  // [table row][i]
  std::size_t table_rows_ = 1, table_width_ = 1;
  SlabRows rows_;                   // by step: lower towards the step before, upper towards the one after
  std::vector<double> inverse_;     // 1 / pivot, [step][table row][i]
  std::vector<double> from_below_;  // weight of the neighbour before the first step, same shape; coupled slabs only
  ReducedInterfaces interfaces_;
  // Of coupled slabs, a plane each. The unknown of the second step is sum_s weight_s d'_s over the steps from the
  // second on, but for the neighbours; the one of the first follows from it. couple() turns first and last into the
  // unknowns of the neighbours before and after.
  std::vector<double> weight_, first_, second_, last_;
  // By table row: the last step that feels the neighbour before the first (from_below_), and the last that the second
  // unknown feels (weight_). Beyond them these are too small to be seen, for most modes after a few planes.
  std::vector<int> linked_until_, weighted_until_;
  std::vector<double> weights_;             // by step, if one set of coefficients serves all lines
  std::vector<double> second_from_before_;  // [table row][i]: the second unknown from the neighbours'
  std::vector<double> second_from_after_;
};

}  // namespace pliant
