#include "structure/load_surface.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "mesh/describe.hpp"
#include "mesh/read_surface.hpp"
#include "mesh/shapes/box.hpp"
#include "mesh/shapes/channel.hpp"
#include "mesh/shapes/cylinder.hpp"
#include "mesh/shapes/disc.hpp"
#include "mesh/shapes/ellipsoid.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "mesh/shapes/mechanical_leaflet.hpp"
#include "mesh/shapes/natural_valve.hpp"
#include "mesh/shapes/plate.hpp"
#include "mesh/shapes/plate_with_holes.hpp"
#include "mesh/shapes/red_cell.hpp"
#include "mesh/shapes/ventricle.hpp"

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
  Surface operator()(const ChannelSurface& s) const { return make_channel(s.radius, s.height, s.edge); }
  Surface operator()(const PlateWithHolesSurface& s) const {
    PlateWithHolesSizes sizes{s.size, {}, s.edge, s.hole_edge};
    for (const auto& [x, y, radius] : s.holes) sizes.holes.push_back({x, y, radius});
    return make_plate_with_holes(sizes);
  }
  Surface operator()(const VentricleSurface& s) const {
    return make_ventricle({s.radius, s.height, s.edge, s.apex_edge});
  }
  Surface operator()(const MechanicalLeafletSurface& s) const {
    return make_mechanical_leaflet({s.radius, s.hinge_offset, s.clearance, s.closed_angle, s.edge});
  }
  Surface operator()(const NaturalValveSurface& s) const {
    const auto leaflets = s.leaflet == ValveLeaflet::both       ? LeafletsMade::both
                          : s.leaflet == ValveLeaflet::anterior ? LeafletsMade::anterior
                                                                : LeafletsMade::posterior;
    return make_natural_valve({s.radius, s.opening, s.free_edge, s.commissure, s.posterior_length, s.edge, leaflets});
  }
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
