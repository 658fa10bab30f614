#include "solvers/reduced_interfaces.hpp"

#include <array>

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
struct Pair {
  double low = 0, high = 0;  // last unknown below an interface, first unknown above it
};
Pair operator*(const Mat2& m, Pair v) { return {m.a * v.low + m.b * v.high, m.c * v.low + m.d * v.high}; }
Pair operator-(Pair v, Pair w) { return {v.low - w.low, v.high - w.high}; }

// Row block of an interface: lower couples to the interface below, upper to the one above.
struct Row {
  Mat2 lower, diagonal, upper;
  Pair y;
};

}  // namespace

ReducedInterfaces::ReducedInterfaces(const Communicator& ranks, Ends ends, std::size_t lines)
    : ranks_(ranks), periodic_(ends == Ends::periodic), coupled_(periodic_ || ranks.size() > 1), lines_(lines) {
  const auto n = static_cast<std::size_t>(ranks.size());
  for (std::size_t r = 0; r < n; ++r) {
    offsets_.push_back(static_cast<int>(lines * r / n));
    counts_.push_back(static_cast<int>(lines * (r + 1) / n - lines * r / n));
  }
  share_ = static_cast<std::size_t>(counts_[static_cast<std::size_t>(ranks.rank())]);
  for (std::size_t r = 0; r < n; ++r) {
    receive_counts_.push_back(static_cast<int>(share_));
    receive_offsets_.push_back(static_cast<int>(share_ * r));
  }
  if (!coupled_) return;
  first_.resize(share_ * n);
  last_.resize(share_ * n);
}

void ReducedInterfaces::set_closure(const Closure& closure) {
  if (!coupled_) return;
  const auto n = static_cast<std::size_t>(ranks_.size());
  line_step_ = 0;
  coefficients_.resize(4 * n);
  const std::array<double, 4> mine{closure.first_below, closure.first_above, closure.last_below, closure.last_above};
  for (std::size_t entry = 0; entry < 4; ++entry)
    check_mpi(
        MPI_Allgather(&mine[entry], 1, MPI_DOUBLE, coefficients_.data() + entry * n, 1, MPI_DOUBLE, ranks_.handle()),
        "MPI_Allgather");
}

void ReducedInterfaces::set_closure(const double* first_below, const double* first_above, const double* last_below,
                                    const double* last_above) {
  if (!coupled_) return;
  const auto n = static_cast<std::size_t>(ranks_.size());
  line_step_ = 1;
  coefficients_.resize(4 * n * share_);
  const std::array<const double*, 4> mine{first_below, first_above, last_below, last_above};
  for (std::size_t entry = 0; entry < 4; ++entry)
    check_mpi(MPI_Alltoallv(mine[entry], counts_.data(), offsets_.data(), MPI_DOUBLE,
                            coefficients_.data() + entry * n * share_, receive_counts_.data(), receive_offsets_.data(),
                            MPI_DOUBLE, ranks_.handle()),
              "MPI_Alltoallv");
}

void ReducedInterfaces::solve(double* y_first, double* y_last) {
  if (!coupled_) return;
  const auto to_share = [&](const double* lines, std::vector<double>& share) {
    check_mpi(MPI_Alltoallv(lines, counts_.data(), offsets_.data(), MPI_DOUBLE, share.data(), receive_counts_.data(),
                            receive_offsets_.data(), MPI_DOUBLE, ranks_.handle()),
              "MPI_Alltoallv");
  };
  const auto from_share = [&](const std::vector<double>& share, double* lines) {
    check_mpi(MPI_Alltoallv(share.data(), receive_counts_.data(), receive_offsets_.data(), MPI_DOUBLE, lines,
                            counts_.data(), offsets_.data(), MPI_DOUBLE, ranks_.handle()),
              "MPI_Alltoallv");
  };
  to_share(y_first, first_);
  to_share(y_last, last_);
  solve_share();
  from_share(first_, y_first);
  from_share(last_, y_last);
}

// Block elimination over the interfaces of one line; a periodic line keeps its last interface as a border.
void ReducedInterfaces::solve_share() {
  const int slabs = ranks_.size();
  const int interfaces = periodic_ ? slabs : slabs - 1;
  const auto n = static_cast<std::size_t>(slabs);
  const std::size_t per_slab = line_step_ == 0 ? 1 : share_;
  const auto slab_below = [&](int t) { return static_cast<std::size_t>(t); };
  const auto slab_above = [&](int t) { return static_cast<std::size_t>((t + 1) % slabs); };
  std::vector<Row> rows(static_cast<std::size_t>(interfaces));
  std::vector<Mat2> inverses(rows.size()), borders(rows.size());
  std::vector<Pair> x(rows.size());

  for (std::size_t line = 0; line < share_; ++line) {
    const auto coefficient = [&](std::size_t entry, std::size_t slab) {
      return coefficients_[(entry * n + slab) * per_slab + line * line_step_];
    };
    for (int t = 0; t < interfaces; ++t) {
      const auto a = slab_below(t), b = slab_above(t);
      rows[static_cast<std::size_t>(t)] = {{-coefficient(2, a), 0, 0, 0},
                                           {1, -coefficient(3, a), -coefficient(0, b), 1},
                                           {0, 0, 0, -coefficient(1, b)},
                                           {last_[a * share_ + line], first_[b * share_ + line]}};
    }
    if (periodic_ && interfaces == 1) {
      const auto& row = rows[0];
      const Mat2 whole{row.diagonal.a + row.lower.a, row.diagonal.b, row.diagonal.c, row.diagonal.d + row.upper.d};
      x[0] = inverse(whole) * row.y;
    } else {
      const std::size_t count = static_cast<std::size_t>(periodic_ ? interfaces - 1 : interfaces);
      for (std::size_t t = 0; t < count; ++t) {
        borders[t] = {};
        if (periodic_ && t == 0) borders[t] = rows[t].lower;
        if (periodic_ && t + 1 == count) borders[t] = borders[t] - (Mat2{} - rows[t].upper);
        Mat2 diagonal = rows[t].diagonal;
        if (t > 0) {
          const Mat2 factor = rows[t].lower * inverses[t - 1];
          diagonal = diagonal - factor * rows[t - 1].upper;
          rows[t].y = rows[t].y - factor * rows[t - 1].y;
          borders[t] = borders[t] - factor * borders[t - 1];
        }
        inverses[t] = inverse(diagonal);
      }
      for (std::size_t t = count; t-- > 0;) {
        if (t + 1 < count) {
          rows[t].y = rows[t].y - rows[t].upper * x[t + 1];
          borders[t] = borders[t] - rows[t].upper * borders[t + 1];
        }
        x[t] = inverses[t] * rows[t].y;
        borders[t] = inverses[t] * borders[t];
      }
      if (periodic_) {
        const auto& row = rows[count];
        const Mat2 diagonal = row.diagonal - row.lower * borders[count - 1] - row.upper * borders[0];
        x[count] = inverse(diagonal) * (row.y - row.lower * x[count - 1] - row.upper * x[0]);
        for (std::size_t t = 0; t < count; ++t) x[t] = x[t] - borders[t] * x[count];
      }
    }
    // first_ becomes X_below, last_ becomes X_above of each slab.
    if (!periodic_) {
      first_[line] = 0;
      last_[(n - 1) * share_ + line] = 0;
    }
    for (int t = 0; t < interfaces; ++t) {
      first_[slab_above(t) * share_ + line] = x[static_cast<std::size_t>(t)].low;
      last_[slab_below(t) * share_ + line] = x[static_cast<std::size_t>(t)].high;
    }
  }
}

std::size_t ReducedInterfaces::bytes() const {
  return (coefficients_.size() + first_.size() + last_.size()) * sizeof(double);
}

}  // namespace pliant
