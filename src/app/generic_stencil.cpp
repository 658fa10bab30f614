// GCC 12 takes the undefined operands of its own AVX-512 intrinsics for uninitialised variables.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include "app/generic_stencil.hpp"

#include "app/generic_mls.hpp"

namespace pliant {
namespace {

void plain_values(const NodeSupport& support, GenericStencil& values) {
  values = GenericMls<double>(support.offsets, support.reach).value;
}

void plain_gradients(const NodeSupport& support, std::array<GenericStencil, 3>& gradients) {
  gradients = GenericMls<double>(support.offsets, support.reach).gradient;
}

/// Basis times weights, by node, and the moment matrix.
struct Moments {
  Eigen::Matrix<double, 4, 27> weighted;
  Eigen::Matrix4d matrix;

  explicit Moments(const NodeSupport& s) {
    Eigen::Matrix<double, 4, 27> basis;
    for (int n = 0; n < 27; ++n)
      basis.col(n) << 1, s.offsets[0][n % 3] / s.reach[0], s.offsets[1][n / 3 % 3] / s.reach[1],
          s.offsets[2][n / 9] / s.reach[2];
    const Eigen::Matrix<double, 1, 27> weights = (-basis.bottomRows<3>().colwise().squaredNorm()).array().exp();
    weighted = basis * weights.asDiagonal();
    matrix = weighted.lazyProduct(basis.transpose());
  }
};

void lean_values(const NodeSupport& support, GenericStencil& values) {
  const Moments moments(support);
  const Eigen::Vector4d coefficients = moments.matrix.ldlt().solve(Eigen::Vector4d::UnitX());
  Eigen::Map<Eigen::Matrix<double, 1, 27>>(values.data()) = coefficients.transpose() * moments.weighted;
}

void lean_gradients(const NodeSupport& support, std::array<GenericStencil, 3>& gradients) {
  const Moments moments(support);
  const Eigen::Matrix<double, 4, 3> wanted = Eigen::Matrix4d::Identity().rightCols<3>();
  const Eigen::Matrix<double, 4, 3> coefficients = moments.matrix.ldlt().solve(wanted);
  for (std::size_t d = 0; d < 3; ++d)
    Eigen::Map<Eigen::Matrix<double, 1, 27>>(gradients[d].data()) =
        coefficients.col(static_cast<int>(d)).transpose() / support.reach[d] * moments.weighted;
}

}  // namespace

const GenericMethod plain_method{plain_values, plain_gradients};
const GenericMethod lean_method{lean_values, lean_gradients};

}  // namespace pliant
