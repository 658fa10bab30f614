#include "config/patch_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {
namespace {
/// Edges are met to this part of a length: faces that lie on them by construction must not fall to either side by
/// rounding.
constexpr double tolerance = 1e-12;

std::array<double, 2> offset(const PatchConfig& patch, const PatchPlane& plane, std::array<double, 2> point) {
  std::array<double, 2> d{};
  for (std::size_t a = 0; a < 2; ++a) {
    d[a] = point[a] - patch.center[a];
    if (plane.periodic[a]) d[a] -= plane.size[a] * std::round(d[a] / plane.size[a]);
  }
  return d;
}

bool is_within(std::array<double, 2> d, double radius) { return std::hypot(d[0], d[1]) < radius * (1 - tolerance); }
}  // namespace

std::vector<PatchConfig>* patches_of(BoundarySpec& side) {
  if (auto* wall = std::get_if<WallSide>(&side)) return &wall->patches;
  if (auto* slip = std::get_if<FreeSlipSide>(&side)) return &slip->patches;
  return nullptr;
}

const std::vector<PatchConfig>* patches_of(const BoundarySpec& side) {
  if (const auto* wall = std::get_if<WallSide>(&side)) return &wall->patches;
  if (const auto* slip = std::get_if<FreeSlipSide>(&side)) return &slip->patches;
  return nullptr;
}

PatchPlane patch_plane(const BoxConfig& box, const BoundaryConfig& boundary) {
  PatchPlane plane;
  for (int d = 0; d < 2; ++d) {
    const auto a = static_cast<std::size_t>(d);
    plane.origin[a] = box.origin[d];
    plane.size[a] = box.size[d];
    plane.cells[a] = box.cells[a];
    plane.periodic[a] = std::holds_alternative<PeriodicSide>(boundary[2 * a]);
  }
  return plane;
}

bool is_in_shape(const PatchConfig& patch, const PatchPlane& plane, std::array<double, 2> point) {
  const auto d = offset(patch, plane, point);
  switch (patch.shape) {
    case PatchShape::disc:
      return is_within(d, patch.radius.value_or(0));
    case PatchShape::annulus:
      return is_within(d, patch.radius.value_or(0)) && !is_within(d, patch.inner_radius);
    case PatchShape::rectangle:
      for (std::size_t a = 0; a < 2; ++a) {
        const double half = 0.5 * patch.size[a], shift = tolerance * plane.size[a];
        if (plane.periodic[a] && patch.size[a] >= plane.size[a] * (1 - tolerance)) continue;
        if (d[a] < -half - shift || d[a] >= half - shift) return false;
      }
      return true;
    case PatchShape::outside:
      return !patch.radius || !is_within(d, *patch.radius);
  }
  return false;
}

std::vector<int> patch_of_faces(const std::vector<PatchConfig>& patches, const PatchPlane& plane) {
  std::vector<int> owners(static_cast<std::size_t>(plane.cells[0]) * static_cast<std::size_t>(plane.cells[1]), -1);
  const auto claim = [&](std::size_t p) {
    for (int j = 0; j < plane.cells[1]; ++j)
      for (int i = 0; i < plane.cells[0]; ++i) {
        int& owner = owners[static_cast<std::size_t>(i) +
                            static_cast<std::size_t>(j) * static_cast<std::size_t>(plane.cells[0])];
        if (owner < 0 && is_in_shape(patches[p], plane, plane.face_center(i, j))) owner = static_cast<int>(p);
      }
  };
  for (std::size_t p = 0; p < patches.size(); ++p)
    if (!is_rest(patches[p])) claim(p);
  for (std::size_t p = 0; p < patches.size(); ++p)
    if (is_rest(patches[p])) claim(p);
  return owners;
}

double profile_at(const PatchConfig& patch, const PatchPlane& plane, std::array<double, 2> point) {
  if (patch.profile == PatchProfile::uniform) return 1;
  const auto d = offset(patch, plane, point);
  const double outer = patch.radius.value_or(1), s = std::hypot(d[0], d[1]) / outer;
  switch (patch.shape) {
    case PatchShape::disc:
      return 1 - s * s;
    case PatchShape::annulus: {
      // Laminar flow between two pipes (e.g. White, Viscous Fluid Flow, section 3-3).
      const double ratio = patch.inner_radius / outer;
      return 1 - s * s - (1 - ratio * ratio) * std::log(s) / std::log(ratio);
    }
    case PatchShape::rectangle: {
      double shape = 1;
      for (std::size_t a = 0; a < 2; ++a) {
        // A patch from edge to edge of a periodic direction has no edges there.
        if (plane.periodic[a] && patch.size[a] >= plane.size[a] * (1 - tolerance)) continue;
        const double t = 2 * d[a] / patch.size[a];
        shape *= 1 - t * t;
      }
      return shape;
    }
    case PatchShape::outside:
      break;
  }
  return 1;
}

}  // namespace pliant
