#include "solvers/slab_tridiagonal.hpp"

#include <algorithm>

#include "core/loops.hpp"

namespace pliant {
namespace {
// Weights below this are dropped: they cannot be seen in a result, and denormal numbers are slow.
constexpr double negligible = 1e-200;
double flushed(double v) { return v > -negligible && v < negligible ? 0.0 : v; }
}  // namespace

struct SlabTridiagonal::Uniform {
  struct Constant {
    double value;
    double operator[](int) const { return value; }
  };
  const SlabTridiagonal& s;
  Constant inverse(int k, int) const { return {s.inverse_[static_cast<std::size_t>(k)]}; }
  Constant from_below(int k, int) const { return {s.from_below_[static_cast<std::size_t>(k)]}; }
};

struct SlabTridiagonal::PerMode {
  const SlabTridiagonal& s;
  const double* inverse(int k, int row) const {
    return s.inverse_.data() + s.table_index(k, s.fold_[static_cast<std::size_t>(row)]);
  }
  const double* from_below(int k, int row) const {
    return s.from_below_.data() + s.table_index(k, s.fold_[static_cast<std::size_t>(row)]);
  }
};

SlabTridiagonal::SlabTridiagonal(const Communicator& ranks, Ends ends, int planes, LinePlane lines)
    : planes_(planes),
      lines_(lines),
      per_mode_(false),
      interfaces_(ranks, ends, static_cast<std::size_t>(lines.width) * static_cast<std::size_t>(lines.rows)) {
  fold_.assign(static_cast<std::size_t>(lines.rows), 0);
}

SlabTridiagonal::SlabTridiagonal(const Communicator& ranks, Ends ends, int planes, LinePlane lines,
                                 std::vector<int> fold, const std::function<double(int row, int i)>& shift)
    : planes_(planes),
      lines_(lines),
      per_mode_(true),
      fold_(std::move(fold)),
      interfaces_(ranks, ends, static_cast<std::size_t>(lines.width) * static_cast<std::size_t>(lines.rows)) {
  table_rows_ = static_cast<std::size_t>(*std::max_element(fold_.begin(), fold_.end())) + 1;
  table_width_ = static_cast<std::size_t>(lines.width);
  shift_.resize(table_rows_ * table_width_);
  for (int row = 0; row < lines.rows; ++row)
    for (int i = 0; i < lines.width; ++i)
      shift_[static_cast<std::size_t>(fold_[static_cast<std::size_t>(row)]) * table_width_ +
             static_cast<std::size_t>(i)] = shift(row, i);
}

void SlabTridiagonal::set_coefficients(const SlabRows& rows) { set_coefficients(rows, -1, -1, 0); }

void SlabTridiagonal::set_coefficients(const SlabRows& rows, int pinned_row, int pinned_i, double addition) {
  rows_ = rows;
  const std::size_t lines = table_rows_ * table_width_;
  inverse_.resize(lines * static_cast<std::size_t>(planes_));
  if (interfaces_.is_coupled()) {
    from_below_.resize(inverse_.size());
    const auto n = static_cast<std::size_t>(lines_.width) * static_cast<std::size_t>(lines_.rows);
    weight_.resize(per_mode_ ? n : 1);
    y_first_.resize(n);
    y_last_.resize(n);
  }
  std::vector<Closure> closures(lines);
  for (std::size_t row = 0; row < table_rows_; ++row)
    for (std::size_t i = 0; i < table_width_; ++i) {
      const bool pinned = static_cast<int>(row) == pinned_row && static_cast<int>(i) == pinned_i;
      factorise_lines(static_cast<int>(row), static_cast<int>(i), per_mode_ ? shift_[row * table_width_ + i] : 0.0,
                      pinned ? addition : 0.0, closures[row * table_width_ + i]);
    }
  if (!per_mode_) return interfaces_.set_closure(closures[0]);
  if (!interfaces_.is_coupled()) return;
  const auto n = y_first_.size();
  std::vector<double> entries(4 * n);
  for (std::size_t row = 0; row < static_cast<std::size_t>(lines_.rows); ++row)
    for (std::size_t i = 0; i < table_width_; ++i) {
      const Closure& c = closures[static_cast<std::size_t>(fold_[row]) * table_width_ + i];
      const std::size_t line = row * table_width_ + i;
      entries[line] = c.first_below;
      entries[n + line] = c.first_above;
      entries[2 * n + line] = c.last_below;
      entries[3 * n + line] = c.last_above;
    }
  interfaces_.set_closure(entries.data(), entries.data() + n, entries.data() + 2 * n, entries.data() + 3 * n);
}

void SlabTridiagonal::factorise_lines(int row, int i, double shift, double addition, Closure& closure) {
  const bool coupled = interfaces_.is_coupled();
  double pivot_inverse = 0, below = 0, weight = 1, first_below = 0;
  for (int k = 0; k < planes_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double diagonal = rows_.diagonal[at] + shift + (k == 0 ? addition : 0.0);
    const double upper_before = k == 0 ? 0.0 : rows_.upper[at - 1];
    const double eliminated = k == 0 ? 0.0 : rows_.lower[at] * upper_before * pivot_inverse;
    if (k > 0) weight = flushed(-upper_before * pivot_inverse * weight);
    pivot_inverse = 1 / (diagonal - eliminated);
    below = flushed(-rows_.lower[at] * pivot_inverse * (k == 0 ? 1.0 : below));
    const std::size_t entry = table_index(k, row) + static_cast<std::size_t>(i);
    inverse_[entry] = pivot_inverse;
    if (coupled) from_below_[entry] = below;
    first_below += weight * below;
  }
  const double last_upper = rows_.upper[static_cast<std::size_t>(planes_) - 1] * pivot_inverse;
  closure = {first_below, -weight * last_upper, below, -last_upper};
}

// d'_k = (d_k - lower_k d'_{k-1}) / pivot_k
template <class Table>
void SlabTridiagonal::eliminate_with(const Table& table, int k, double* plane, const double* plane_below) {
  const double lower = k == 0 ? 0.0 : rows_.lower[static_cast<std::size_t>(k)];
  const int width = lines_.width;
  for (int row = 0; row < lines_.rows; ++row) {
    double* __restrict d = plane + row * lines_.stride;
    const auto inverse = table.inverse(k, row);
    if (k == 0) {
      for_each(width, [=](int i) { d[i] *= inverse[i]; });
    } else {
      const double* __restrict below = plane_below + row * lines_.stride;
      for_each(width, [=](int i) { d[i] = (d[i] - lower * below[i]) * inverse[i]; });
    }
  }
  if (!interfaces_.is_coupled()) return;

  const double upper_before = k == 0 ? 0.0 : rows_.upper[static_cast<std::size_t>(k) - 1];
  if (!per_mode_)
    weight_[0] = k == 0 ? 1.0 : flushed(-upper_before * inverse_[static_cast<std::size_t>(k) - 1] * weight_[0]);
  for (int row = 0; row < lines_.rows; ++row) {
    const double* __restrict d = plane + row * lines_.stride;
    const std::ptrdiff_t line = static_cast<std::ptrdiff_t>(row) * width;
    double* __restrict y = y_first_.data() + line;
    if (k == planes_ - 1) std::copy_n(d, width, y_last_.data() + line);
    if (k == 0) {
      if (per_mode_) std::fill_n(weight_.data() + line, width, 1.0);
      std::copy_n(d, width, y);
    } else if (per_mode_) {
      const auto inverse_before = table.inverse(k - 1, row);
      double* __restrict weight = weight_.data() + line;
      for_each(width, [=](int i) {
        const double w = -upper_before * inverse_before[i] * weight[i];
        weight[i] = w > negligible || w < -negligible ? w : 0.0;
        y[i] += weight[i] * d[i];
      });
    } else if (const double weight = weight_[0]; weight != 0) {
      for_each(width, [=](int i) { y[i] += weight * d[i]; });
    }
  }
}

// x_k = d'_k + from_below_k X_below - upper_k / pivot_k x_{k+1}
template <class Table>
void SlabTridiagonal::substitute_with(const Table& table, int k, double* plane, const double* plane_above) {
  const double upper = rows_.upper[static_cast<std::size_t>(k)];
  const int width = lines_.width;
  const bool coupled = interfaces_.is_coupled(), last = k == planes_ - 1;
  if (last && !coupled) return;
  for (int row = 0; row < lines_.rows; ++row) {
    double* __restrict d = plane + row * lines_.stride;
    const std::ptrdiff_t line = static_cast<std::ptrdiff_t>(row) * width;
    const double* __restrict above = last ? y_last_.data() + line : plane_above + row * lines_.stride;
    const auto inverse = table.inverse(k, row);
    if (coupled) {
      const auto from_below = table.from_below(k, row);
      const double* __restrict below = y_first_.data() + line;
      for_each(width, [=](int i) { d[i] += from_below[i] * below[i] - upper * inverse[i] * above[i]; });
    } else {
      for_each(width, [=](int i) { d[i] -= upper * inverse[i] * above[i]; });
    }
  }
}

void SlabTridiagonal::eliminate(int k, double* plane, const double* plane_below) {
  if (per_mode_) eliminate_with(PerMode{*this}, k, plane, plane_below);
  else eliminate_with(Uniform{*this}, k, plane, plane_below);
}

void SlabTridiagonal::couple() { interfaces_.solve(y_first_.data(), y_last_.data()); }

void SlabTridiagonal::substitute(int k, double* plane, const double* plane_above) {
  if (per_mode_) substitute_with(PerMode{*this}, k, plane, plane_above);
  else substitute_with(Uniform{*this}, k, plane, plane_above);
}

std::size_t SlabTridiagonal::bytes() const {
  return (inverse_.size() + from_below_.size() + shift_.size() + weight_.size() + y_first_.size() + y_last_.size()) *
             sizeof(double) +
         interfaces_.bytes();
}

}  // namespace pliant
