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
/// Use: eliminate(k, plane k, plane k - 1) for k ascending, then couple(), then substitute(k, plane k, plane k + 1) for
/// k descending. On one rank with bounded ends this is the Thomas algorithm; otherwise each slab reduces to its two end
/// unknowns, ReducedInterfaces solves for the neighbours', and substitution takes them in. Planes are never transposed.
class SlabTridiagonal {
 public:
  using Ends = ReducedInterfaces::Ends;

  /// Lines that share one set of coefficients.
  SlabTridiagonal(const Communicator& ranks, Ends ends, int planes, LinePlane lines);
  /// The same coefficients but for a shift of the diagonal, shift(row, i), constant in z: the modes of a transform.
  /// `fold` maps a row to the row whose shifts it shares (rows of equal wave number), so that tables are kept once.
  SlabTridiagonal(const Communicator& ranks, Ends ends, int planes, LinePlane lines, std::vector<int> fold,
                  const std::function<double(int row, int i)>& shift);

  /// Factorises. Collective.
  void set_coefficients(const SlabRows& rows);
  /// With, for one line alone, an addition to the diagonal of its first plane (pins a singular mode). Collective.
  void set_coefficients(const SlabRows& rows, int pinned_row, int pinned_i, double addition);

  void eliminate(int k, double* plane, const double* plane_below);
  void couple();
  void substitute(int k, double* plane, const double* plane_above);

  std::size_t bytes() const;

 private:
  struct Uniform;
  struct PerMode;
  template <class Table>
  void eliminate_with(const Table& table, int k, double* plane, const double* plane_below);
  template <class Table>
  void substitute_with(const Table& table, int k, double* plane, const double* plane_above);
  void factorise_lines(int row, int i, double shift, double addition, Closure& closure);
  std::size_t table_index(int k, int table_row) const {
    return (static_cast<std::size_t>(k) * table_rows_ + static_cast<std::size_t>(table_row)) * table_width_;
  }

  int planes_;
  LinePlane lines_;
  bool per_mode_;
  std::vector<int> fold_;
  std::vector<double> shift_;  // [table row][i]
  std::size_t table_rows_ = 1, table_width_ = 1;
  SlabRows rows_;
  std::vector<double> inverse_;     // 1 / pivot, [k][table row][i]
  std::vector<double> from_below_;  // weight of X_below in the eliminated row, same shape; coupled slabs only
  ReducedInterfaces interfaces_;
  // Running planes of coupled slabs: the first unknown y_first = sum_k weight_k d'_k, and y_last.
  std::vector<double> weight_, y_first_, y_last_;
};

}  // namespace pliant
