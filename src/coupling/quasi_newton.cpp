#include "coupling/quasi_newton.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {
namespace {

// A residual difference of which less than this is new says nothing but noise.
constexpr double least_new_part = 1e-3;
constexpr std::size_t most_columns = 40;

}  // namespace

QuasiNewton::QuasiNewton(Communicator ranks, double first_factor) : ranks_(ranks), first_factor_(first_factor) {}

void QuasiNewton::restart() {
  has_last_ = false;
  known_.clear();
}

double QuasiNewton::product(const Column& a, const Column& b) const {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return ranks_.sum(sum);
}

void QuasiNewton::relax(std::span<double> x, std::span<const double> image) {
  const std::size_t n = x.size();
  Column residual(n), now(image.begin(), image.end());
  for (std::size_t i = 0; i < n; ++i) residual[i] = image[i] - x[i];
  if (has_last_) {
    Known difference{Column(n), Column(n)};
    for (std::size_t i = 0; i < n; ++i) {
      difference.residual[i] = residual[i] - last_residual_[i];
      difference.image[i] = now[i] - last_image_[i];
    }
    known_.insert(known_.begin(), std::move(difference));
    if (known_.size() > most_columns) known_.pop_back();
  }
  last_residual_ = residual;
  last_image_ = now;
  has_last_ = true;
  if (known_.empty()) {
    for (std::size_t i = 0; i < n; ++i) x[i] += first_factor_ * residual[i];
    return;
  }
  // Gram-Schmidt, newest columns first; images are combined alike.
  std::vector<Column> basis, images;
  Column rest = residual, next = now;
  for (const Known& k : known_) {
    Column q = k.residual, w = k.image;
    const double whole = product(q, q);
    for (std::size_t b = 0; b < basis.size(); ++b) {
      const double part = product(basis[b], q);
      for (std::size_t i = 0; i < n; ++i) {
        q[i] -= part * basis[b][i];
        w[i] -= part * images[b][i];
      }
    }
    const double left = product(q, q);
    if (!(left > least_new_part * least_new_part * whole)) continue;
    const double scale = 1 / std::sqrt(left);
    for (std::size_t i = 0; i < n; ++i) {
      q[i] *= scale;
      w[i] *= scale;
    }
    const double share = product(q, rest);
    for (std::size_t i = 0; i < n; ++i) {
      rest[i] -= share * q[i];
      next[i] -= share * w[i];
    }
    basis.push_back(std::move(q));
    images.push_back(std::move(w));
  }
  std::copy(next.begin(), next.end(), x.begin());
}

}  // namespace pliant
