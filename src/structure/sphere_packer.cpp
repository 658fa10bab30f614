#include "structure/sphere_packer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/validate.hpp"

namespace pliant {
namespace {
constexpr int most_tries = 1'000'000;
constexpr double most_cells = 4e6;

double volume(Vec3 size) { return size.x * size.y * size.z; }
}  // namespace

SpherePacker::SpherePacker(const CaseConfig& config, const PlacementConfig& placement, const PackedSpheres& spheres)
    : origin_(config.box.origin), size_(config.box.size), packed_(spheres) {
  const double r = spheres.radius;
  for (int d = 0; d < 3; ++d) {
    const double begin = origin_[d], end = origin_[d] + size_[d];
    const auto& [from, to] = std::pair(placement.region_lower, placement.region_upper);
    periodic_[d] = is_periodic(config.boundary, d);
    const double first = from ? (*from)[d] : begin, last = to ? (*to)[d] : end;
    // A region as long as a periodic box has no ends.
    const bool whole = periodic_[d] && last - first >= size_[d] * (1 - 1e-12);
    lower_[d] = whole ? begin : first + r;
    upper_[d] = whole ? end : last - r;
    if (periodic_[d]) continue;
    lower_[d] = std::max(lower_[d], begin + r + spheres.gap);
    upper_[d] = std::min(upper_[d], end - r - spheres.gap);
  }
  const Vec3 room = upper_ - lower_;
  const double share = std::clamp(volume(room) / volume(size_), 1e-6, 1.0);
  const double wanted = std::clamp(4.0 * spheres.count / share, 64.0, most_cells);
  const double edge = std::max(2 * r + spheres.gap, std::cbrt(volume(size_) / wanted));
  for (int d = 0; d < 3; ++d) {
    n_[d] = static_cast<int>(std::clamp(size_[d] / edge, 1.0, most_cells));
    step_[d] = size_[d] / n_[d];
  }
  // Flat and long boxes have fewer cells across, so more of them fit along: thin them out where they are most.
  while (static_cast<double>(n_[0]) * n_[1] * n_[2] > most_cells) {
    const auto d = std::max_element(n_.begin(), n_.end()) - n_.begin();
    n_[d] = (n_[d] + 1) / 2;
    step_[static_cast<int>(d)] = size_[static_cast<int>(d)] / n_[d];
  }
  cells_.resize(static_cast<std::size_t>(n_[0]) * n_[1] * n_[2]);
}

std::vector<int> SpherePacker::tight_directions() const {
  std::vector<int> tight;
  for (int d = 0; d < 3; ++d) {
    const bool meets_itself = periodic_[d] && 2 * packed_.radius + packed_.gap > size_[d];
    if (lower_[d] > upper_[d] || meets_itself) tight.push_back(d);
  }
  return tight;
}

double SpherePacker::volume_fraction(std::size_t n_spheres) const {
  const double r = packed_.radius + packed_.gap / 2;
  Vec3 region = upper_ - lower_;
  for (int d = 0; d < 3; ++d)
    if (region[d] < size_[d] || !periodic_[d]) region[d] += 2 * packed_.radius;
  return static_cast<double>(n_spheres) * 4.0 / 3.0 * std::numbers::pi * r * r * r / volume(region);
}

template <class Add>
void SpherePacker::for_cells(Vec3 lower, Vec3 upper, Add add_to) {
  int first[3], count[3];
  for (int d = 0; d < 3; ++d) {
    // One part in 1e9 wider: cells at the rim are not lost to rounding.
    const double slack = 1e-9 * step_[d];
    double low = std::floor((lower[d] - origin_[d] - slack) / step_[d]);
    double high = std::floor((upper[d] - origin_[d] + slack) / step_[d]);
    if (!periodic_[d]) {
      low = std::max(low, 0.0);
      high = std::min(high, n_[d] - 1.0);
    }
    if (high < low) return;
    count[d] = static_cast<int>(std::min<double>(high - low + 1, n_[d]));
    first[d] = static_cast<int>(low - n_[d] * std::floor(low / n_[d]));
  }
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) {
        const int at[3] = {(first[0] + i) % n_[0], (first[1] + j) % n_[1], (first[2] + k) % n_[2]};
        add_to(cells_[(static_cast<std::size_t>(at[2]) * n_[1] + at[1]) * n_[0] + at[0]]);
      }
}

SpherePacker::Cell& SpherePacker::cell_at(Vec3 x) {
  int at[3];
  for (int d = 0; d < 3; ++d) at[d] = std::clamp(static_cast<int>((x[d] - origin_[d]) / step_[d]), 0, n_[d] - 1);
  return cells_[(static_cast<std::size_t>(at[2]) * n_[1] + at[1]) * n_[0] + at[0]];
}

void SpherePacker::add_obstacle(const BoundingSphere& sphere) {
  const double away = sphere.radius + packed_.radius + packed_.gap;
  const int number = static_cast<int>(spheres_.size());
  spheres_.push_back({sphere.center, away});
  const Vec3 reach{away, away, away};
  for_cells(sphere.center - reach, sphere.center + reach, [&](Cell& cell) { cell.spheres.push_back(number); });
}

void SpherePacker::add_obstacle(const Surface& surface) {
  Vec3 lower = surface.positions[0], upper = lower;
  for (const Vec3 x : surface.positions)
    for (int d = 0; d < 3; ++d) {
      lower[d] = std::min(lower[d], x[d]);
      upper[d] = std::max(upper[d], x[d]);
    }
  const double away = packed_.radius + packed_.gap;
  // Every periodic image that comes near the box is an obstacle of its own.
  int first[3], last[3];
  for (int d = 0; d < 3; ++d) {
    first[d] = periodic_[d] ? static_cast<int>(std::ceil((origin_[d] - upper[d] - away) / size_[d])) : 0;
    last[d] = periodic_[d] ? static_cast<int>(std::floor((origin_[d] + size_[d] - lower[d] + away) / size_[d])) : 0;
  }
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) {
        const Vec3 shift{i * size_.x, j * size_.y, k * size_.z};
        if (surface.mesh.is_closed()) solids_.push_back({&surface, shift, lower + shift, upper + shift});
        for (const Face& face : surface.mesh.vertices_of_face()) {
          Triangle triangle;
          for (int c = 0; c < 3; ++c) triangle[c] = surface.positions[face[c]] + shift;
          Vec3 low = triangle[0], high = low;
          for (int d = 0; d < 3; ++d) {
            low[d] = std::max(origin_[d], std::min({low[d], triangle[1][d], triangle[2][d]}) - away);
            high[d] = std::min(origin_[d] + size_[d], std::max({high[d], triangle[1][d], triangle[2][d]}) + away);
          }
          if (low.x > high.x || low.y > high.y || low.z > high.z) continue;
          const int number = static_cast<int>(triangles_.size());
          triangles_.push_back(triangle);
          for_cells(low, high, [&](Cell& cell) { cell.triangles.push_back(number); });
        }
      }
}

bool SpherePacker::is_inside_a_solid(Vec3 x) const {
  for (const Solid& solid : solids_) {
    bool may_be = true;
    for (int d = 0; d < 3; ++d) may_be = may_be && x[d] > solid.lower[d] && x[d] < solid.upper[d];
    if (may_be && winding_number(x - solid.shift, solid.surface->mesh, solid.surface->positions) > 0.5) return true;
  }
  return false;
}

bool SpherePacker::is_free(Vec3 x) {
  Cell& cell = cell_at(x);
  for (const int s : cell.spheres) {
    Vec3 to = spheres_[s].center - x;
    for (int d = 0; d < 3; ++d)
      if (periodic_[d]) to[d] -= size_[d] * std::round(to[d] / size_[d]);
    if (dot(to, to) < spheres_[s].radius * spheres_[s].radius) return false;
  }
  const double away = packed_.radius + packed_.gap;
  for (const int t : cell.triangles) {
    const Vec3 to = nearest_point(x, triangles_[t]) - x;
    if (dot(to, to) < away * away) return false;
  }
  if (solids_.empty()) return true;
  // A cell that no triangle is near lies inside or outside as a whole.
  if (!cell.triangles.empty()) return !is_inside_a_solid(x);
  if (cell.inside < 0) cell.inside = is_inside_a_solid(x) ? 1 : 0;
  return cell.inside == 0;
}

std::optional<Vec3> SpherePacker::add(RandomReals& random) {
  for (int attempt = 0; attempt < most_tries; ++attempt) {
    Vec3 x;
    for (int d = 0; d < 3; ++d) {
      x[d] = lower_[d] + random.next() * (upper_[d] - lower_[d]);
      if (periodic_[d]) x[d] -= size_[d] * std::floor((x[d] - origin_[d]) / size_[d]);
    }
    if (!is_free(x)) continue;
    add_obstacle(BoundingSphere{x, packed_.radius});
    return x;
  }
  return std::nullopt;
}

}  // namespace pliant
