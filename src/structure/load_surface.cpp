#include "structure/load_surface.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "mesh/describe.hpp"
#include "mesh/read_surface.hpp"
#include "mesh/shapes/box.hpp"
#include "mesh/shapes/cylinder.hpp"
#include "mesh/shapes/disc.hpp"
#include "mesh/shapes/ellipsoid.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "mesh/shapes/plate.hpp"
#include "mesh/shapes/red_cell.hpp"

namespace pliant {
namespace {
struct ShapeMaker {
  const std::filesystem::path& folder;

  Surface operator()(const SphereSurface& s) const { return make_icosphere(s.frequency, s.radius); }
  Surface operator()(const EllipsoidSurface& s) const { return make_ellipsoid(s.frequency, s.semi_axes); }
  Surface operator()(const RedCellSurface& s) const { return make_red_cell(s.frequency, s.radius); }
  Surface operator()(const PlateSurface& s) const { return make_plate(s.size[0], s.size[1], s.edge); }
  Surface operator()(const DiscSurface& s) const { return make_disc(s.radius, s.edge); }
  Surface operator()(const HalfDiscSurface& s) const { return make_half_disc(s.radius, s.edge); }
  Surface operator()(const CylinderSurface& s) const {
    return make_cylinder(s.radius, s.height, s.edge, s.ends == CylinderEnds::open ? Ends::open : Ends::capped);
  }
  Surface operator()(const BoxSurface& s) const { return make_box(s.size, s.edge); }
  Surface operator()(const FileSurface& s) const {
    const auto path = folder / s.file;
    Surface surface = read_surface(path, s.open ? Closure::open : Closure::closed);
    const int pieces = count_components(surface.mesh);
    if (!s.open && pieces > 1)
      throw InputError(
          fmt::format("{}: the surface consists of {} closed pieces that nothing connects; write each to a file of its "
                      "own and give it its own [[body]]",
                      path.string(), pieces));
    for (Vec3& x : surface.positions) x *= s.scale;
    return surface;
  }
};
}  // namespace

Surface load_shape(const BodyConfig& config, const std::filesystem::path& folder) {
  try {
    return std::visit(ShapeMaker{folder}, config.surface);
  } catch (const InputError& error) {
    std::vector<std::string> problems;
    for (const auto& problem : error.problems())
      problems.push_back(fmt::format("body.{}.surface: {}", config.name, problem));
    throw InputError(std::move(problems));
  }
}

}  // namespace pliant
