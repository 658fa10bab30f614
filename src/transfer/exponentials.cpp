// GCC 12 takes the undefined operands of its own AVX-512 intrinsics for uninitialised variables.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include "transfer/exponentials.hpp"

#include <Eigen/Core>

namespace pliant {

void exponentials(double* x, int n) {
  for (int begin = 0; begin < n; begin += 8) {
    Eigen::Map<Eigen::Array<double, 8, 1>, Eigen::Aligned64> values(x + begin);
    values = values.exp();
  }
}

}  // namespace pliant
