#include "coupling/quasi_newton.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {
namespace {

// A residual difference of which less than this is new says nothing but noise.
constexpr double least_new_part = 1e-3;

double local_product(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

QuasiNewton::QuasiNewton(Communicator ranks, double first_factor, int reuse)
    : ranks_(ranks), first_factor_(first_factor), reuse_(reuse) {}

void QuasiNewton::restart(std::vector<Secant> kept) {
  has_last_ = false;
  known_ = std::move(kept);
  const std::size_t n = known_.size();
  std::vector<double> all(n * n);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b <= a; ++b)
      all[n * a + b] = all[n * b + a] = local_product(known_[a].residual, known_[b].residual);
  ranks_.sum(all);
  products_.clear();
  for (std::size_t a = 0; a < n; ++a)
    products_.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(n * a),
                           all.begin() + static_cast<std::ptrdiff_t>(n * (a + 1)));
}

std::vector<double> QuasiNewton::products_with(std::span<const double> residual) const {
  std::vector<double> products;
  for (const Secant& secant : known_) products.push_back(local_product(secant.residual, residual));
  ranks_.sum(products);
  return products;
}

void QuasiNewton::learn(std::span<const double> residual, std::span<const double> image) {
  const std::size_t n = residual.size();
  Secant secant{std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    secant.residual[i] = residual[i] - last_residual_[i];
    secant.image[i] = image[i] - last_image_[i];
  }
  if (known_.size() == most_secants) {
    known_.pop_back();
    products_.pop_back();
    for (auto& row : products_) row.pop_back();
  }
  known_.insert(known_.begin(), std::move(secant));
  auto row = products_with(known_[0].residual);
  for (std::size_t a = 0; a < products_.size(); ++a) products_[a].insert(products_[a].begin(), row[a + 1]);
  products_.insert(products_.begin(), std::move(row));
}

// Cholesky's factors of the products, newest secants first: what is left of a diagonal is the square of what a secant
// has that newer ones have not. Of those that say nothing new the coefficient is zero.
std::vector<double> QuasiNewton::solve(std::vector<double> of_residual) const {
  const std::size_t n = known_.size();
  std::vector<std::vector<double>> lower(n);
  std::vector<bool> counts(n);
  for (std::size_t a = 0; a < n; ++a) {
    lower[a].assign(a + 1, 0.0);
    double left = products_[a][a];
    for (std::size_t b = 0; b < a; ++b) {
      if (!counts[b]) continue;
      double value = products_[a][b];
      for (std::size_t k = 0; k < b; ++k) value -= lower[a][k] * lower[b][k];
      lower[a][b] = value / lower[b][b];
      left -= lower[a][b] * lower[a][b];
    }
    counts[a] = left > least_new_part * least_new_part * products_[a][a];
    if (counts[a]) lower[a][a] = std::sqrt(left);
    else lower[a].assign(a + 1, 0.0);
  }
  auto& c = of_residual;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < a; ++b) c[a] -= lower[a][b] * c[b];
    c[a] = counts[a] ? c[a] / lower[a][a] : 0.0;
  }
  for (std::size_t a = n; a-- > 0;) {
    for (std::size_t b = a + 1; b < n; ++b) c[a] -= lower[b][a] * c[b];
    c[a] = counts[a] ? c[a] / lower[a][a] : 0.0;
  }
  return c;
}

void QuasiNewton::relax(std::span<double> x, std::span<const double> image) {
  const std::size_t n = x.size();
  std::vector<double> residual(n);
  for (std::size_t i = 0; i < n; ++i) residual[i] = image[i] - x[i];
  if (has_last_) learn(residual, image);
  last_residual_ = residual;
  last_image_.assign(image.begin(), image.end());
  has_last_ = true;
  const double w = first_factor_;
  const auto c = solve(products_with(residual));
  for (std::size_t i = 0; i < n; ++i) x[i] += w * residual[i];
  for (std::size_t a = 0; a < known_.size(); ++a) {
    if (c[a] == 0) continue;
    for (std::size_t i = 0; i < n; ++i) x[i] -= c[a] * (known_[a].image[i] - (1 - w) * known_[a].residual[i]);
  }
}

std::vector<Secant> QuasiNewton::secants_to_keep() const {
  std::vector<Secant> kept;
  for (const Secant& secant : known_) {
    if (secant.age >= reuse_) break;
    kept.push_back(secant);
    ++kept.back().age;
  }
  return kept;
}

}  // namespace pliant
