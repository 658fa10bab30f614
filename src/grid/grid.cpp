#include "grid/grid.hpp"

#include <algorithm>
#include <cmath>

#include "grid/stretching.hpp"

namespace pliant {

Grid::Grid(const BoxConfig& box, const BoundaryConfig& boundary, const Communicator& ranks)
    : cells_(box.cells), origin_(box.origin), size_(box.size), ranks_(ranks) {
  for (std::size_t d = 0; d < 3; ++d) periodic_[d] = std::holds_alternative<PeriodicSide>(boundary[2 * d]);
  dx_ = size_.x / cells_[0];
  dy_ = size_.y / cells_[1];
  slab_ = slab_of_rank(cells_[2], ranks.size(), ranks.rank());

  const int n = cells_[2];
  const auto faces = stretched_faces(box.stretching_z, n, origin_.z, size_.z);  // n + 1 values, face -1 first
  auto metrics = std::make_shared<Metrics>();
  const auto size = static_cast<std::size_t>(n) + 2;
  metrics->z_c.resize(size);
  metrics->z_f.resize(size + 1);
  metrics->dz_c.resize(size);
  metrics->dz_f.resize(size);
  const auto at = [](int k) { return static_cast<std::size_t>(k + 1); };
  for (int k = -1; k < n; ++k) metrics->z_f[at(k)] = faces[at(k)];
  for (int k = 0; k < n; ++k) {
    metrics->dz_c[at(k)] = faces[at(k)] - faces[at(k) - 1];
    metrics->z_c[at(k)] = 0.5 * (faces[at(k)] + faces[at(k) - 1]);
  }
  // Ghost cells repeat the box when z is periodic and mirror it otherwise.
  metrics->dz_c[at(-1)] = metrics->dz_c[at(periodic_[2] ? n - 1 : 0)];
  metrics->dz_c[at(n)] = metrics->dz_c[at(periodic_[2] ? 0 : n - 1)];
  metrics->z_c[at(-1)] = faces.front() - 0.5 * metrics->dz_c[at(-1)];
  metrics->z_c[at(n)] = faces.back() + 0.5 * metrics->dz_c[at(n)];
  metrics->z_f[at(n)] = faces.back() + metrics->dz_c[at(n)];
  for (int k = -1; k < n; ++k) metrics->dz_f[at(k)] = 0.5 * (metrics->dz_c[at(k)] + metrics->dz_c[at(k + 1)]);
  metrics->dz_f[at(n)] = periodic_[2] ? metrics->dz_f[at(0)] : metrics->dz_c[at(n)];
  metrics_ = std::move(metrics);
}

double Grid::smallest_dz() const {
  const auto& dz = metrics_->dz_c;
  return *std::min_element(dz.begin() + 1, dz.end() - 1);
}

double Grid::smallest_spacing() const { return std::min({dx_, dy_, smallest_dz()}); }

double Grid::convective_rate(Vec3 velocity) const {
  return std::abs(velocity.x) / dx_ + std::abs(velocity.y) / dy_ + std::abs(velocity.z) / smallest_dz();
}

int Grid::plane_of_height(double z) const {
  const auto first = metrics_->z_f.begin();  // face -1
  const auto last = first + cells_[2] + 1;
  const auto above = std::upper_bound(first, last, z);
  return std::clamp(static_cast<int>(above - first) - 1, 0, cells_[2] - 1);
}

}  // namespace pliant
