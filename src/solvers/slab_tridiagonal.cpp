#include "solvers/slab_tridiagonal.hpp"

#include <algorithm>

#include "core/loops.hpp"

namespace pliant {
namespace {
// Weights of a neighbour's unknown below this are dropped: they cannot be seen beside that unknown.
constexpr double negligible = 1e-30;
double flushed(double v) { return v > -negligible && v < negligible ? 0.0 : v; }
}  // namespace

struct SlabTridiagonal::Uniform {
  struct Constant {
    double value;
    double operator[](int) const { return value; }
  };
  const SlabTridiagonal& s;
  Constant inverse(int step, int) const { return {s.inverse_[static_cast<std::size_t>(step)]}; }
  Constant from_below(int step, int) const { return {s.from_below_[static_cast<std::size_t>(step)]}; }
};

struct SlabTridiagonal::PerMode {
  const SlabTridiagonal& s;
  const double* inverse(int step, int row) const {
    return s.inverse_.data() + s.table_index(step, s.fold_[static_cast<std::size_t>(row)]);
  }
  const double* from_below(int step, int row) const {
    return s.from_below_.data() + s.table_index(step, s.fold_[static_cast<std::size_t>(row)]);
  }
};

SlabTridiagonal::SlabTridiagonal(const Communicator& ranks, Ends ends, int planes, LinePlane lines, Order order)
    : planes_(planes),
      lines_(lines),
      per_mode_(false),
      order_(order),
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

void SlabTridiagonal::set_coefficients(const SlabRows& rows) { set_coefficients(rows, 0, 0); }

void SlabTridiagonal::set_coefficients(const SlabRows& rows, int pinned, double addition) {
  rows_ = rows;
  if (order_ == Order::descending) {
    std::swap(rows_.lower, rows_.upper);
    for (auto* of : {&rows_.lower, &rows_.diagonal, &rows_.upper}) std::reverse(of->begin(), of->end());
  }
  const std::size_t lines = table_rows_ * table_width_;
  inverse_.resize(lines * static_cast<std::size_t>(planes_));
  const auto n = static_cast<std::size_t>(lines_.width) * static_cast<std::size_t>(lines_.rows);
  if (interfaces_.is_coupled()) {
    from_below_.resize(inverse_.size());
    if (per_mode_) {
      weight_.resize(n);
      second_from_before_.resize(lines);
      second_from_after_.resize(lines);
    } else {
      weights_.resize(static_cast<std::size_t>(planes_));
    }
    for (auto* of : {&first_, &second_, &last_}) of->resize(n);
    for (auto* until : {&linked_until_, &weighted_until_}) until->assign(table_rows_, 0);
  }
  std::vector<Closure> closures(lines);
  for (std::size_t row = 0; row < table_rows_; ++row)
    for (std::size_t i = 0; i < table_width_; ++i) {
      const bool is_pinned = row == 0 && static_cast<int>(i) < pinned;
      const std::size_t line = row * table_width_ + i;
      Closure second;
      factorise_lines(static_cast<int>(row), static_cast<int>(i), per_mode_ ? shift_[line] : 0.0,
                      is_pinned ? addition : 0.0, closures[line], second);
      if (second_from_before_.empty()) continue;
      second_from_before_[line] = second.first_below;
      second_from_after_[line] = second.first_above;
    }
  // ReducedInterfaces counts from below.
  const auto from_below_upwards = [&](const Closure& c) {
    return order_ == Order::ascending ? c : Closure{c.last_above, c.last_below, c.first_above, c.first_below};
  };
  if (!per_mode_) return interfaces_.set_closure(from_below_upwards(closures[0]));
  if (!interfaces_.is_coupled()) return;
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

// Closures in the order of steps: "below" is the neighbour before the first, "above" the one after the last. `second`
// holds the unknown of the second step in its first entries.
void SlabTridiagonal::factorise_lines(int row, int i, double shift, double addition, Closure& closure,
                                      Closure& second) {
  const bool coupled = interfaces_.is_coupled();
  double pivot_inverse = 0, below = 0, weight = 1, first_link = 0;
  for (int step = 0; step < planes_; ++step) {
    const auto at = static_cast<std::size_t>(step);
    const double diagonal = rows_.diagonal[at] + shift + (step == 0 ? addition : 0.0);
    const double upper_before = step == 0 ? 0.0 : rows_.upper[at - 1];
    const double link = -upper_before * pivot_inverse;  // of the unknown before to this one
    const double eliminated = step == 0 ? 0.0 : rows_.lower[at] * upper_before * pivot_inverse;
    if (step == 1) first_link = link;
    if (step > 1) weight = flushed(link * weight);
    if (!weights_.empty()) weights_[at] = weight;
    pivot_inverse = 1 / (diagonal - eliminated);
    below = flushed(-rows_.lower[at] * pivot_inverse * (step == 0 ? 1.0 : below));
    const std::size_t entry = table_index(step, row) + static_cast<std::size_t>(i);
    inverse_[entry] = pivot_inverse;
    if (coupled) {
      from_below_[entry] = below;
      const auto table_row = static_cast<std::size_t>(row);
      if (below != 0) linked_until_[table_row] = std::max(linked_until_[table_row], step);
      if (weight != 0) weighted_until_[table_row] = std::max(weighted_until_[table_row], step);
    }
    if (step == 0) closure.first_below = below;
    else second.first_below += weight * below;
  }
  const double last_upper = rows_.upper[static_cast<std::size_t>(planes_) - 1] * pivot_inverse;
  closure.last_below = below;
  closure.last_above = -last_upper;
  if (planes_ == 1) {
    closure.first_above = -last_upper;
    return;
  }
  second.first_above = -weight * last_upper;
  closure.first_below += first_link * second.first_below;
  closure.first_above = first_link * second.first_above;
}

// Gathers what the end unknowns of a coupled slab need of this step.
template <class Table>
void SlabTridiagonal::reduce_row(const Table& table, int step, int row, const double* d) {
  const int width = lines_.width;
  const std::ptrdiff_t line = static_cast<std::ptrdiff_t>(row) * width;
  double* __restrict first = first_.data() + line;
  double* __restrict second = second_.data() + line;
  const bool is_weighted = step <= weighted_until_[static_cast<std::size_t>(fold_[static_cast<std::size_t>(row)])];
  if (step == planes_ - 1) std::copy_n(d, width, last_.data() + line);
  if (step == 0) {
    std::copy_n(d, width, first);
    std::fill_n(second, width, 0.0);
    if (per_mode_) std::fill_n(weight_.data() + line, width, 1.0);
  } else if (step == 1) {
    std::copy_n(d, width, second);
  } else if (is_weighted && !per_mode_) {
    const double weight = weights_[static_cast<std::size_t>(step)];
    for_each(width, [=](int i) { second[i] += weight * d[i]; });
  } else if (is_weighted) {
    const double upper_before = rows_.upper[static_cast<std::size_t>(step) - 1];
    const auto inverse_before = table.inverse(step - 1, row);
    double* __restrict weight = weight_.data() + line;
    for_each(width, [=](int i) {
      const double w = -upper_before * inverse_before[i] * weight[i];
      weight[i] = w > negligible || w < -negligible ? w : 0.0;
      second[i] += weight[i] * d[i];
    });
  }
  if (step == planes_ - 1 && step > 0) {
    const double upper = rows_.upper[0];
    const auto inverse = table.inverse(0, row);
    for_each(width, [=](int i) { first[i] -= upper * inverse[i] * second[i]; });
  }
}

// d'_s = (d_s - lower_s d'_{s-1}) / pivot_s
template <class Table, class Source>
void SlabTridiagonal::eliminate_with(const Table& table, int step, int row, double* d, const double* before,
                                     const Source& source) {
  const int width = lines_.width;
  const auto inverse = table.inverse(step, row);
  if (step == 0) {
    for_each(width, [=](int i) { d[i] = source(i) * inverse[i]; });
  } else {
    const double lower = rows_.lower[static_cast<std::size_t>(step)];
    for_each(width, [=](int i) { d[i] = (source(i) - lower * before[i]) * inverse[i]; });
  }
  if (interfaces_.is_coupled()) reduce_row(table, step, row, d);
}

void SlabTridiagonal::eliminate_row(int k, int row, double* d, const double* before) {
  const auto source = [=](int i) { return d[i]; };
  if (per_mode_) eliminate_with(PerMode{*this}, step_of(k), row, d, before, source);
  else eliminate_with(Uniform{*this}, step_of(k), row, d, before, source);
}

void SlabTridiagonal::eliminate_row_added(int k, int row, double* d, const double* before, const double* x_below,
                                          const double* x, const double* x_above) {
  const int step = step_of(k);
  const auto at = static_cast<std::size_t>(step);
  const bool up = order_ == Order::ascending;
  const double below = up ? rows_.lower[at] : rows_.upper[at], above = up ? rows_.upper[at] : rows_.lower[at];
  const double diagonal = rows_.diagonal[at];
  eliminate_with(Uniform{*this}, step, row, d, before,
                 [=](int i) { return d[i] + (below * x_below[i] + diagonal * x[i] + above * x_above[i]); });
}

// x_s = d'_s + from_below_s X_before - upper_s / pivot_s x_{s+1}
template <class Table>
void SlabTridiagonal::substitute_with(const Table& table, int step, int row, const double* d, const double* before,
                                      double* x) const {
  const double upper = rows_.upper[static_cast<std::size_t>(step)];
  const int width = lines_.width;
  const std::ptrdiff_t line = static_cast<std::ptrdiff_t>(row) * width;
  const auto inverse = table.inverse(step, row);
  const bool coupled = interfaces_.is_coupled(), starts = step == planes_ - 1;
  const double* above = starts && coupled ? last_.data() + line : before;
  if (coupled && step <= linked_until_[static_cast<std::size_t>(fold_[static_cast<std::size_t>(row)])]) {
    const auto from_below = table.from_below(step, row);
    const double* __restrict below = first_.data() + line;
    for_each(width, [=](int i) { x[i] = d[i] + from_below[i] * below[i] - upper * inverse[i] * above[i]; });
  } else if (starts && !coupled) {
    if (x != d) std::copy_n(d, width, x);
  } else {
    for_each(width, [=](int i) { x[i] = d[i] - upper * inverse[i] * above[i]; });
  }
}

void SlabTridiagonal::substitute_row(int k, int row, const double* d, const double* before, double* x) const {
  if (per_mode_) substitute_with(PerMode{*this}, step_of(k), row, d, before, x);
  else substitute_with(Uniform{*this}, step_of(k), row, d, before, x);
}

void SlabTridiagonal::eliminate(int k, double* plane, const double* before) {
  for (int row = 0; row < lines_.rows; ++row)
    eliminate_row(k, row, plane + row * lines_.stride, before + row * lines_.stride);
}

void SlabTridiagonal::substitute(int k, double* plane, const double* before) const {
  for (int row = 0; row < lines_.rows; ++row) {
    double* x = plane + row * lines_.stride;
    substitute_row(k, row, x, before + row * lines_.stride, x);
  }
}

void SlabTridiagonal::couple() {
  if (order_ == Order::ascending) interfaces_.solve(first_.data(), last_.data());
  else interfaces_.solve(last_.data(), first_.data());
}

void SlabTridiagonal::find_second_plane(double* plane) const {
  const int width = lines_.width;
  for (int row = 0; row < lines_.rows; ++row) {
    const std::ptrdiff_t line = static_cast<std::ptrdiff_t>(row) * width;
    const std::size_t table = table_index(0, fold_[static_cast<std::size_t>(row)]);
    const double* __restrict second = second_.data() + line;
    const double* __restrict before = first_.data() + line;
    const double* __restrict after = last_.data() + line;
    const double* __restrict from_before = second_from_before_.data() + table;
    const double* __restrict from_after = second_from_after_.data() + table;
    double* __restrict x = plane + row * lines_.stride;
    for_each(width, [=](int i) { x[i] = second[i] + from_before[i] * before[i] + from_after[i] * after[i]; });
  }
}

std::size_t SlabTridiagonal::bytes() const {
  std::size_t doubles = 0;
  for (const auto* of : {&inverse_, &from_below_, &shift_, &weight_, &first_, &second_, &last_, &second_from_before_,
                         &second_from_after_})
    doubles += of->size();
  return doubles * sizeof(double) + interfaces_.bytes();
}

}  // namespace pliant
