#include "app/triad.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

namespace pliant {

double triad_speed(const Communicator& ranks) {
  constexpr std::size_t n = std::size_t{1} << 24;
  constexpr int passes = 9;
  std::vector<double> a(n, 0.0), b(n, 1.0), c(n, 2.0);
  std::vector<double> seconds;
  for (int pass = 0; pass < passes; ++pass) {
    ranks.barrier();
    const auto start = std::chrono::steady_clock::now();
    double* __restrict to = a.data();
    const double* __restrict x = b.data();
    const double* __restrict y = c.data();
    const double s = 0.5 + pass;
    for (std::size_t i = 0; i < n; ++i) to[i] = x[i] + s * y[i];
    const double mine = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (a[n / 2] < 0) return 0;  // keeps the passes from being removed
    seconds.push_back(ranks.max(mine));
  }
  std::sort(seconds.begin(), seconds.end());
  return 24e-9 * static_cast<double>(n) * ranks.size() / seconds[passes / 2];
}

}  // namespace pliant
