#include "solvers/row_helmholtz.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

// Packs pass between functions of this file alone, so how other compilers would pass them does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace pliant {
namespace {

typedef double Pack __attribute__((vector_size(64)));
typedef long long Lanes __attribute__((vector_size(64)));
constexpr int width = 8;

inline Pack load(const double* p) {
  Pack v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void store(double* p, Pack v) { std::memcpy(p, &v, sizeof v); }
inline Pack splat(double v) { return Pack{v, v, v, v, v, v, v, v}; }

}  // namespace

RowHelmholtz::RowHelmholtz(int n, double a, LineEnds ends, double low, double high) : n_(n) {
  // a (1/r + r) = 1 + 2a; this form of the smaller root keeps its digits at small a.
  const double root = 1 + 2 * a + std::sqrt(1 + 4 * a);
  r_ = 2 * a / root;
  gain_ = 2 / root;  // r / a
  power_.resize(static_cast<std::size_t>(n) + 1);
  double p = 1;
  reach_ = 0;
  for (int i = 0; i < n; ++i) {
    p *= r_;
    if (p < 1e-30) p = 0;
    power_[static_cast<std::size_t>(i)] = p;
    if (p > 1e-18) reach_ = i + 1;
  }
  power_[static_cast<std::size_t>(n)] = p * r_;
  // x = free + c0 r^(i+1) + c1 r^(n-i); rows: m c = s with s linear in free_0 and free_{n-1}.
  const double rn = power_[static_cast<std::size_t>(n) - 1], rn1 = power_[static_cast<std::size_t>(n)];
  double m[2][2], s[2][2];
  if (ends == LineEnds::periodic) {
    m[0][0] = 1 - rn, m[0][1] = rn1 - r_, s[0][0] = -r_, s[0][1] = 1;
    m[1][0] = rn1 - r_, m[1][1] = 1 - rn, s[1][0] = 1, s[1][1] = 0;
  } else {
    m[0][0] = 1 - low * r_, m[0][1] = rn1 - low * rn, s[0][0] = low - r_, s[0][1] = 0;
    m[1][0] = rn1 - high * rn, m[1][1] = 1 - high * r_, s[1][0] = 0, s[1][1] = high;
  }
  const double det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  for (int column = 0; column < 2; ++column) {
    c_[0][column] = (m[1][1] * s[0][column] - m[0][1] * s[1][column]) / det;
    c_[1][column] = (m[0][0] * s[1][column] - m[1][0] * s[0][column]) / det;
  }
}

void RowHelmholtz::solve(double* row) const {
  const double r = r_;
  if (r == 0) return;
  const Pack zero = {};
  const Pack r1 = splat(r), r2 = splat(r * r), r4 = splat(r * r * r * r), gain = splat(gain_);
  Pack up, down;
  double p = 1;
  for (int lane = 0; lane < width; ++lane) {
    p *= r;
    up[lane] = p;
    down[width - 1 - lane] = p;
  }
  const int whole = n_ / width * width;

  double carry = 0;  // y_i = gain d_i + r y_{i-1}
  for (int i = 0; i < whole; i += width) {
    Pack y = gain * load(row + i);
    y += r1 * __builtin_shuffle(y, zero, Lanes{8, 0, 1, 2, 3, 4, 5, 6});
    y += r2 * __builtin_shuffle(y, zero, Lanes{8, 8, 0, 1, 2, 3, 4, 5});
    y += r4 * __builtin_shuffle(y, zero, Lanes{8, 8, 8, 8, 0, 1, 2, 3});
    const double last = y[width - 1];
    store(row + i, y + up * splat(carry));
    carry = last + up[width - 1] * carry;  // packs wait for each other here alone
  }
  for (int i = whole; i < n_; ++i) row[i] = carry = gain_ * row[i] + r * carry;

  carry = 0;  // x_i = y_i + r x_{i+1}
  for (int i = n_ - 1; i >= whole; --i) row[i] = carry = row[i] + r * carry;
  for (int i = whole - width; i >= 0; i -= width) {
    Pack x = load(row + i);
    x += r1 * __builtin_shuffle(x, zero, Lanes{1, 2, 3, 4, 5, 6, 7, 8});
    x += r2 * __builtin_shuffle(x, zero, Lanes{2, 3, 4, 5, 6, 7, 8, 8});
    x += r4 * __builtin_shuffle(x, zero, Lanes{4, 5, 6, 7, 8, 8, 8, 8});
    const double first_of_pack = x[0];
    store(row + i, x + down * splat(carry));
    carry = first_of_pack + down[0] * carry;
  }

  const double first = row[0], last = row[n_ - 1];
  const double c0 = c_[0][0] * first + c_[0][1] * last, c1 = c_[1][0] * first + c_[1][1] * last;
  const double* power = power_.data();
  for (int i = 0; i < reach_; ++i) row[i] += c0 * power[i];
  double* end = row + n_ - 1;
  for (int i = 0; i < reach_; ++i) end[-i] += c1 * power[i];
}

}  // namespace pliant
