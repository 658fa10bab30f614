#pragma once
#include <Eigen/Dense>
#include <array>
#include <cmath>

namespace pliant {

/// Moving least squares as the textbooks have it, for any weight function, by a 4 x 4 solve: the reference for the
/// closed form of MlsShape in the tests, and what its speed is compared with.
/// Coordinates are counted from the point and scaled by `reach`; in extended precision the conditioning of the moment
/// matrix, bad where the point is outside its nodes, does not show.
template <class Real>
struct GenericMls {
  std::array<double, 27> value{};                    ///< node a + 3 b + 9 c
  std::array<std::array<double, 27>, 3> gradient{};  ///< the fitted gradient's weights

  /// offsets[d][k]: node minus point; reach[d]: width alpha r of the Gaussian weights.
  GenericMls(const double (&offsets)[3][3], const std::array<double, 3>& reach) {
    using Vector = Eigen::Matrix<Real, 4, 1>;
    using Matrix = Eigen::Matrix<Real, 4, 4>;
    Matrix moments = Matrix::Zero();
    std::array<Vector, 27> weighted;
    for (int n = 0; n < 27; ++n) {
      const int at[3] = {n % 3, n / 3 % 3, n / 9};
      Vector basis(Real(1), Real(0), Real(0), Real(0));
      Real exponent = 0;
      for (int d = 0; d < 3; ++d) {
        const auto e = static_cast<std::size_t>(d);
        basis[d + 1] = Real(offsets[d][at[d]]) / Real(reach[e]);
        exponent += basis[d + 1] * basis[d + 1];
      }
      const Vector column = std::exp(-exponent) * basis;
      moments += column * basis.transpose();
      weighted[static_cast<std::size_t>(n)] = column;
    }
    const Matrix inverse = moments.inverse();
    for (std::size_t n = 0; n < 27; ++n) {
      const Vector coefficients = inverse * weighted[n];
      value[n] = static_cast<double>(coefficients[0]);
      for (std::size_t d = 0; d < 3; ++d)
        gradient[d][n] = static_cast<double>(coefficients[static_cast<int>(d) + 1]) / reach[d];
    }
  }
};

}  // namespace pliant
