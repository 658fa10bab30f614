#include "solvers/reduced_interfaces.hpp"

#include <algorithm>
#include <array>

#include "core/loops.hpp"

namespace pliant {
namespace {

struct Mat2 {
  double a = 0, b = 0, c = 0, d = 0;  // rows (a b), (c d)
};
Mat2 operator*(const Mat2& m, const Mat2& n) {
  return {m.a * n.a + m.b * n.c, m.a * n.b + m.b * n.d, m.c * n.a + m.d * n.c, m.c * n.b + m.d * n.d};
}
Mat2 operator-(const Mat2& m, const Mat2& n) { return {m.a - n.a, m.b - n.b, m.c - n.c, m.d - n.d}; }
Mat2 inverse(const Mat2& m) {
  const double s = 1 / (m.a * m.d - m.b * m.c);
  return {s * m.d, -s * m.b, -s * m.c, s * m.a};
}

}  // namespace

void ReducedInterfaces::Matrices::resize(std::size_t n) {
  for (auto* entries : {&a, &b, &c, &d}) entries->assign(n, 0.0);
}

ReducedInterfaces::ReducedInterfaces(const Communicator& ranks, Ends ends, std::size_t lines)
    : ranks_(ranks),
      periodic_(ends == Ends::periodic),
      coupled_(periodic_ || ranks.size() > 1),
      interfaces_(periodic_ ? ranks.size() : ranks.size() - 1),
      lines_(lines) {
  const auto n = static_cast<std::size_t>(ranks.size());
  for (std::size_t r = 0; r < n; ++r) {
    offsets_.push_back(static_cast<int>(2 * (lines * r / n)));
    counts_.push_back(static_cast<int>(2 * (lines * (r + 1) / n - lines * r / n)));
  }
  share_ = static_cast<std::size_t>(counts_[static_cast<std::size_t>(ranks.rank())] / 2);
  for (std::size_t r = 0; r < n; ++r) {
    receive_counts_.push_back(static_cast<int>(2 * share_));
    receive_offsets_.push_back(static_cast<int>(2 * share_ * r));
  }
  if (!coupled_) return;
  lines_buffer_.resize(2 * lines);
  share_buffer_.resize(2 * share_ * n);
}

void ReducedInterfaces::set_closure(const Closure& closure) {
  if (!coupled_) return;
  const std::array<double, 4> mine{closure.first_below, closure.first_above, closure.last_below, closure.last_above};
  std::vector<double> all(4 * static_cast<std::size_t>(ranks_.size()));
  check_mpi(MPI_Allgather(mine.data(), 4, MPI_DOUBLE, all.data(), 4, MPI_DOUBLE, ranks_.handle()), "MPI_Allgather");
  per_line_ = false;
  line_count_ = 1;
  factorise(all);
}

void ReducedInterfaces::set_closure(const double* first_below, const double* first_above, const double* last_below,
                                    const double* last_above) {
  if (!coupled_) return;
  const auto n = static_cast<std::size_t>(ranks_.size());
  per_line_ = true;
  line_count_ = share_;
  std::vector<double> all(4 * n * share_);  // [slab][entry][line]
  const auto gather = [&](const double* first, const double* last, std::size_t entry) {
    send_to_shares(first, last);
    for (std::size_t slab = 0; slab < n; ++slab)
      for (std::size_t half = 0; half < 2; ++half)
        std::copy_n(share_buffer_.data() + (2 * slab + half) * share_, share_,
                    all.data() + (4 * slab + entry + half) * share_);
  };
  gather(first_below, first_above, 0);
  gather(last_below, last_above, 2);
  factorise(all);
}

void ReducedInterfaces::factorise(const std::vector<double>& closures) {
  const std::size_t n = static_cast<std::size_t>(interfaces_) * line_count_;
  for (auto* matrices : {&factor_, &inverse_, &border_}) matrices->resize(n);
  lower_.assign(n, 0.0);
  upper_.assign(n, 0.0);
  for (std::size_t line = 0; line < line_count_; ++line) factorise_line(closures, line);
}

// Row block of interface t, of unknowns (low, high): lower couples low to the low of interface t - 1, upper couples
// high to the high of t + 1.
void ReducedInterfaces::factorise_line(const std::vector<double>& closures, std::size_t line) {
  const int slabs = ranks_.size();
  const auto coefficient = [&](std::size_t entry, int slab) {
    return closures[(4 * static_cast<std::size_t>(slab) + entry) * line_count_ + line];
  };
  const auto at = [&](int t) { return static_cast<std::size_t>(t) * line_count_ + line; };
  const auto put = [&](Matrices& m, int t, const Mat2& v) {
    m.a[at(t)] = v.a, m.b[at(t)] = v.b, m.c[at(t)] = v.c, m.d[at(t)] = v.d;
  };
  const auto get = [&](const Matrices& m, int t) { return Mat2{m.a[at(t)], m.b[at(t)], m.c[at(t)], m.d[at(t)]}; };
  const auto lower = [&](int t) { return Mat2{lower_[at(t)], 0, 0, 0}; };
  const auto upper = [&](int t) { return Mat2{0, 0, 0, upper_[at(t)]}; };
  const auto diagonal = [&](int t) { return Mat2{1, -coefficient(3, t), -coefficient(0, (t + 1) % slabs), 1}; };
  for (int t = 0; t < interfaces_; ++t) {
    lower_[at(t)] = -coefficient(2, t);
    upper_[at(t)] = -coefficient(1, (t + 1) % slabs);
  }
  if (periodic_ && interfaces_ == 1)
    return put(inverse_, 0, inverse(diagonal(0) - (Mat2{} - lower(0)) - (Mat2{} - upper(0))));
  const int count = periodic_ ? interfaces_ - 1 : interfaces_;
  for (int t = 0; t < count; ++t) {
    Mat2 border, pivot = diagonal(t);
    if (periodic_ && t == 0) border = lower(t);
    if (periodic_ && t + 1 == count) border = border - (Mat2{} - upper(t));
    if (t > 0) {
      const Mat2 factor = lower(t) * get(inverse_, t - 1);
      put(factor_, t, factor);
      pivot = pivot - factor * upper(t - 1);
      border = border - factor * get(border_, t - 1);
    }
    put(border_, t, border);
    put(inverse_, t, inverse(pivot));
  }
  for (int t = count - 1; t >= 0; --t) {
    Mat2 border = get(border_, t);
    if (t + 1 < count) border = border - upper(t) * get(border_, t + 1);
    put(border_, t, get(inverse_, t) * border);
  }
  if (!periodic_) return;
  put(inverse_, count,
      inverse(diagonal(count) - lower(count) * get(border_, count - 1) - upper(count) * get(border_, 0)));
}

ReducedInterfaces::Interface ReducedInterfaces::interface(int t) {
  const auto below = static_cast<std::size_t>(t), above = static_cast<std::size_t>((t + 1) % ranks_.size());
  return {share_buffer_.data() + (2 * below + 1) * share_, share_buffer_.data() + 2 * above * share_};
}

// `at` turns an interface and a line into the place of its coefficients.
template <class At>
void ReducedInterfaces::solve_share(At at) {
  const int n = static_cast<int>(share_);
  const int count = periodic_ && interfaces_ > 1 ? interfaces_ - 1 : interfaces_;
  const double *upper = upper_.data(), *lower = lower_.data();
  const auto multiply = [&](const Matrices& matrices, int t, auto result) {
    const double *a = matrices.a.data(), *b = matrices.b.data(), *c = matrices.c.data(), *d = matrices.d.data();
    const auto x = interface(t);
    for_each(n, [=](int i) {
      const std::size_t m = at(t, i);
      const double low = x.low[i], high = x.high[i];
      result(i, a[m] * low + b[m] * high, c[m] * low + d[m] * high);
    });
  };
  const auto into = [&](int t) {
    const auto x = interface(t);
    return [=](int i, double low, double high) { x.low[i] = low, x.high[i] = high; };
  };
  const auto off = [&](int t) {
    const auto x = interface(t);
    return [=](int i, double low, double high) { x.low[i] -= low, x.high[i] -= high; };
  };
  for (int t = 1; t < count; ++t) {
    const auto x = interface(t), before = interface(t - 1);
    const double *a = factor_.a.data(), *b = factor_.b.data(), *c = factor_.c.data(), *d = factor_.d.data();
    for_each(n, [=](int i) {
      const std::size_t m = at(t, i);
      x.low[i] -= a[m] * before.low[i] + b[m] * before.high[i];
      x.high[i] -= c[m] * before.low[i] + d[m] * before.high[i];
    });
  }
  for (int t = count - 1; t >= 0; --t) {
    if (t + 1 < count) {
      const auto x = interface(t), after = interface(t + 1);
      for_each(n, [=](int i) { x.high[i] -= upper[at(t, i)] * after.high[i]; });
    }
    multiply(inverse_, t, into(t));
  }
  if (periodic_ && interfaces_ > 1) {
    const auto x = interface(count), before = interface(count - 1), after = interface(0);
    for_each(n, [=](int i) {
      const std::size_t m = at(count, i);
      x.low[i] -= lower[m] * before.low[i];
      x.high[i] -= upper[m] * after.high[i];
    });
    multiply(inverse_, count, into(count));
    for (int t = 0; t < count; ++t) {
      const auto to = off(t);
      const double *a = border_.a.data(), *b = border_.b.data(), *c = border_.c.data(), *d = border_.d.data();
      for_each(n, [=](int i) {
        const std::size_t m = at(t, i);
        to(i, a[m] * x.low[i] + b[m] * x.high[i], c[m] * x.low[i] + d[m] * x.high[i]);
      });
    }
  }
  // What was the first of the slab above and the last of the one below becomes each one's neighbour.
  for (int t = 0; t < interfaces_; ++t) {
    const auto x = interface(t);
    std::swap_ranges(x.low, x.low + n, x.high);
  }
  if (periodic_) return;
  std::fill_n(share_buffer_.data(), n, 0.0);
  std::fill_n(share_buffer_.data() + share_buffer_.size() - share_, n, 0.0);
}

void ReducedInterfaces::exchange(const std::vector<int>& counts, const std::vector<int>& offsets,
                                 std::vector<double>& from, const std::vector<int>& receive_counts,
                                 const std::vector<int>& receive_offsets, std::vector<double>& to) const {
  for (int r = 0; r < ranks_.size(); ++r)
    if (r != ranks_.rank()) ranks_.count_message(static_cast<std::size_t>(counts[static_cast<std::size_t>(r)]));
  check_mpi(MPI_Alltoallv(from.data(), counts.data(), offsets.data(), MPI_DOUBLE, to.data(), receive_counts.data(),
                          receive_offsets.data(), MPI_DOUBLE, ranks_.handle()),
            "MPI_Alltoallv");
}

void ReducedInterfaces::send_to_shares(const double* y_first, const double* y_last) {
  for (std::size_t r = 0; r < counts_.size(); ++r) {
    const auto begin = static_cast<std::size_t>(offsets_[r]) / 2, n = static_cast<std::size_t>(counts_[r]) / 2;
    std::copy_n(y_first + begin, n, lines_buffer_.data() + 2 * begin);
    std::copy_n(y_last + begin, n, lines_buffer_.data() + 2 * begin + n);
  }
  exchange(counts_, offsets_, lines_buffer_, receive_counts_, receive_offsets_, share_buffer_);
}

void ReducedInterfaces::return_from_shares(double* y_first, double* y_last) {
  exchange(receive_counts_, receive_offsets_, share_buffer_, counts_, offsets_, lines_buffer_);
  for (std::size_t r = 0; r < counts_.size(); ++r) {
    const auto begin = static_cast<std::size_t>(offsets_[r]) / 2, n = static_cast<std::size_t>(counts_[r]) / 2;
    std::copy_n(lines_buffer_.data() + 2 * begin, n, y_first + begin);
    std::copy_n(lines_buffer_.data() + 2 * begin + n, n, y_last + begin);
  }
}

void ReducedInterfaces::solve(double* y_first, double* y_last) {
  if (!coupled_) return;
  send_to_shares(y_first, y_last);
  if (per_line_) {
    solve_share(
        [share = share_](int t, int i) { return static_cast<std::size_t>(t) * share + static_cast<std::size_t>(i); });
  } else {
    solve_share([](int t, int) { return static_cast<std::size_t>(t); });
  }
  return_from_shares(y_first, y_last);
}

std::size_t ReducedInterfaces::bytes() const {
  std::size_t doubles = lower_.size() + upper_.size() + lines_buffer_.size() + share_buffer_.size();
  for (const auto* m : {&factor_, &inverse_, &border_}) doubles += 4 * m->a.size();
  return doubles * sizeof(double);
}

}  // namespace pliant
