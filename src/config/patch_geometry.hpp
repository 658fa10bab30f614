#pragma once
#include <array>
#include <vector>

#include "config/case_config.hpp"

namespace pliant {

/// A z side of the box as its patches see it; directions are x and y.
struct PatchPlane {
  std::array<double, 2> origin{}, size{};
  std::array<int, 2> cells{};
  std::array<bool, 2> periodic{};

  double spacing(std::size_t d) const { return size[d] / cells[d]; }
  std::array<double, 2> face_center(int i, int j) const {
    return {origin[0] + (i + 0.5) * spacing(0), origin[1] + (j + 0.5) * spacing(1)};
  }
};

PatchPlane patch_plane(const BoxConfig& box, const BoundaryConfig& boundary);

/// Whether a point of the side lies in the shape of a patch, which goes on across periodic edges. Lower edges belong to
/// a shape and upper ones do not, so that shapes that touch share no point. An outside without radius holds every
/// point.
bool is_in_shape(const PatchConfig& patch, const PatchPlane& plane, std::array<double, 2> point);

/// True for the patch that takes what the others leave.
inline bool is_rest(const PatchConfig& patch) { return patch.shape == PatchShape::outside && !patch.radius; }

/// The patch (index into `patches`) that holds the centre of each face (i, j) of the side, at i + j * cells[0]; -1:
/// none, the face is wall. Where shapes overlap the first one counts.
std::vector<int> patch_of_faces(const std::vector<PatchConfig>& patches, const PatchPlane& plane);

/// The velocity's shape over a patch, up to a factor, at one of its points.
double profile_at(const PatchConfig& patch, const PatchPlane& plane, std::array<double, 2> point);

}  // namespace pliant
