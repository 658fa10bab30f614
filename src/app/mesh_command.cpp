#include <fmt/format.h>

#include <memory>

#include "app/command.hpp"
#include "app/moduli_command.hpp"
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
#include "remesh/remesh.hpp"

namespace pliant {
namespace {
struct MeshArguments {
  int frequency = 8;
  double radius = 1.0, height = 1.0, edge = 0.1;
  std::vector<double> semi_axes{1, 1, 1}, plate{1, 1}, box{1, 1, 1};
  std::string ends = "capped";
  double apex_edge = 0, hole_edge = 0;
  std::vector<std::array<double, 3>> holes;
  MechanicalLeafletSizes mechanical;
  double angle = 0;
  NaturalValveSizes natural;
  std::string leaflet = "both";
  RemeshOptions remesh;
  std::string input, output;
};

void write_and_tell(const std::string& path, const Surface& surface) {
  write_surface(path, surface);
  fmt::print("{}: {} vertices, {} edges, {} faces\n", path, surface.mesh.n_vertices(), surface.mesh.n_edges(),
             surface.mesh.n_faces());
  if (surface.selections.empty()) return;
  std::string names;
  for (const auto& [name, vertices] : surface.selections)
    names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", name, vertices.size());
  const bool kept = std::filesystem::path(path).extension() == ".gts";
  fmt::print("selections: {}{}\n", names, kept ? "" : "; this format has no place for them, .gts has");
}

MechanicalLeafletSizes mechanical_sizes(const MeshArguments& a) {
  auto sizes = a.mechanical;
  sizes.radius = a.radius;
  sizes.edge = a.edge;
  return sizes;
}
NaturalValveSizes natural_sizes(const MeshArguments& a) {
  auto sizes = a.natural;
  sizes.radius = a.radius;
  sizes.edge = a.edge;
  sizes.leaflet = a.leaflet == "anterior"    ? LeafletsMade::anterior
                  : a.leaflet == "posterior" ? LeafletsMade::posterior
                                             : LeafletsMade::both;
  return sizes;
}

/// Meshes are small: the root does the work, and the other ranks have nothing to do.
Action on_root(std::function<void()> work) {
  return [work = std::move(work)](const Communicator& ranks) -> int {
    if (ranks.is_root()) work();
    return exit_success;
  };
}

using Arguments = std::shared_ptr<MeshArguments>;

/// A subcommand that makes a shape and writes it; the caller adds the options that are its sizes.
CLI::App* add_shape(CLI::App& mesh, Action& action, const Arguments& arguments, const std::string& name,
                    const std::string& text, std::function<Surface(const MeshArguments&)> make) {
  auto* shape = mesh.add_subcommand(name, text);
  shape->add_option("-o,--output", arguments->output, "The file to write: .gts, .stl, .obj or .ply")->required();
  shape->callback([arguments, &action, make = std::move(make)] {
    action = on_root([arguments, make] { write_and_tell(arguments->output, make(*arguments)); });
  });
  return shape;
}

void add_frequency(CLI::App& shape, const Arguments& arguments) {
  shape.add_option("--frequency", arguments->frequency, "Parts of each edge of the icosahedron")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}
void add_radius(CLI::App& shape, const Arguments& arguments) {
  shape.add_option("--radius", arguments->radius, "Of the " + shape.get_name())->capture_default_str();
}
void add_edge(CLI::App& shape, const Arguments& arguments) {
  shape.add_option("--edge", arguments->edge, "About how long the edges of the faces are")->capture_default_str();
}

void add_shapes(CLI::App& mesh, Action& action, const Arguments& arguments) {
  auto* sphere = add_shape(mesh, action, arguments, "sphere", "A geodesic sphere of 10 f^2 + 2 vertices",
                           [](const auto& a) { return make_icosphere(a.frequency, a.radius); });
  add_frequency(*sphere, arguments);
  add_radius(*sphere, arguments);

  auto* ellipsoid =
      add_shape(mesh, action, arguments, "ellipsoid", "A geodesic sphere scaled along x, y and z", [](const auto& a) {
        return make_ellipsoid(a.frequency, {a.semi_axes[0], a.semi_axes[1], a.semi_axes[2]});
      });
  add_frequency(*ellipsoid, arguments);
  ellipsoid->add_option("--semi-axes", arguments->semi_axes, "Along x, y and z")->expected(3)->capture_default_str();

  auto* red_cell = add_shape(mesh, action, arguments, "red-cell", "A red blood cell at rest, its axis along z",
                             [](const auto& a) { return make_red_cell(a.frequency, a.radius); });
  add_frequency(*red_cell, arguments);
  add_radius(*red_cell, arguments);

  auto* plate = add_shape(mesh, action, arguments, "plate", "An open rectangle in the x-y plane",
                          [](const auto& a) { return make_plate(a.plate[0], a.plate[1], a.edge); });
  plate->add_option("--size", arguments->plate, "Along x and y")->expected(2)->capture_default_str();
  add_edge(*plate, arguments);

  auto* disc = add_shape(mesh, action, arguments, "disc", "An open disc in the x-y plane",
                         [](const auto& a) { return make_disc(a.radius, a.edge); });
  auto* half = add_shape(mesh, action, arguments, "half-disc", "The half of a disc at x >= 0, open",
                         [](const auto& a) { return make_half_disc(a.radius, a.edge); });
  auto* cylinder = add_shape(
      mesh, action, arguments, "cylinder", "A cylinder along z, closed by caps or an open tube", [](const auto& a) {
        return make_cylinder(a.radius, a.height, a.edge, a.ends == "open" ? Ends::open : Ends::capped);
      });
  for (auto* shape : {disc, half, cylinder}) {
    add_radius(*shape, arguments);
    add_edge(*shape, arguments);
  }
  cylinder->add_option("--height", arguments->height, "Along z")->capture_default_str();
  cylinder->add_option("--ends", arguments->ends, "How it is closed")->check(CLI::IsMember({"capped", "open"}));

  auto* box = add_shape(mesh, action, arguments, "box", "A box with its edges along x, y and z", [](const auto& a) {
    return make_box({a.box[0], a.box[1], a.box[2]}, a.edge);
  });
  box->add_option("--size", arguments->box, "Along x, y and z")->expected(3)->capture_default_str();
  add_edge(*box, arguments);
}

void add_mechanical_options(CLI::App& shape, const Arguments& arguments) {
  auto& sizes = arguments->mechanical;
  shape.add_option("--hinge-offset", sizes.hinge_offset, "Of the hinge axis from the channel's, in diameters")
      ->capture_default_str();
  shape.add_option("--clearance", sizes.clearance, "To the channel's wall at all angles, in diameters")
      ->capture_default_str();
  shape
      .add_option("--closed-angle", sizes.closed_angle,
                  "Degrees from the annulus's plane at which it fills its half of the channel")
      ->capture_default_str();
}

/// The parts of a heart. Options have the names of the keys of a case.
void add_heart_shapes(CLI::App& mesh, Action& action, const Arguments& arguments) {
  auto* channel = add_shape(mesh, action, arguments, "channel", "An open tube along z from z = 0",
                            [](const auto& a) { return make_channel(a.radius, a.height, a.edge); });
  channel->add_option("--height", arguments->height, "Along z")->capture_default_str();

  auto* plate = add_shape(mesh, action, arguments, "plate-with-holes", "A rectangle in the x-y plane with round holes",
                          [](const auto& a) {
                            PlateWithHolesSizes sizes{{a.plate[0], a.plate[1]}, {}, a.edge, a.hole_edge};
                            for (const auto& [x, y, radius] : a.holes) sizes.holes.push_back({x, y, radius});
                            return make_plate_with_holes(sizes);
                          });
  plate->add_option("--size", arguments->plate, "Along x and y")->expected(2)->capture_default_str();
  plate->add_option("--holes", arguments->holes, "X Y RADIUS, as often as there are holes");
  plate->add_option("--hole-edge", arguments->hole_edge, "Of the edges at the holes; 0: as --edge")
      ->capture_default_str();
  add_edge(*plate, arguments);

  auto* ventricle = add_shape(mesh, action, arguments, "ventricle",
                              "The lower half of a spheroid, open at its rim in z = 0", [](const auto& a) {
                                return make_ventricle({a.radius, a.height, a.edge, a.apex_edge});
                              });
  ventricle->add_option("--height", arguments->height, "Of the rim over the apex")->capture_default_str();
  ventricle->add_option("--apex-edge", arguments->apex_edge, "Of the edges at the apex; 0: as --edge")
      ->capture_default_str();

  auto* leaflet =
      add_shape(mesh, action, arguments, "mechanical-leaflet", "A leaflet in the x-y plane, its hinge the y axis",
                [](const auto& a) { return make_mechanical_leaflet(mechanical_sizes(a)); });
  auto* bileaflet = add_shape(mesh, action, arguments, "valve-bileaflet", "Two such leaflets about the channel's axis",
                              [](const auto& a) { return make_bileaflet_valve(mechanical_sizes(a), a.angle); });
  for (auto* shape : {leaflet, bileaflet}) add_mechanical_options(*shape, arguments);
  bileaflet->add_option("--angle", arguments->angle, "Degrees of both leaflets from the annulus's plane")
      ->capture_default_str();

  auto* natural = add_shape(mesh, action, arguments, "natural-valve", "The two leaflets of a mitral valve, half open",
                            [](const auto& a) { return make_natural_valve(natural_sizes(a)); });
  natural->alias("valve-natural");
  auto& sizes = arguments->natural;
  natural->add_option("--leaflet", arguments->leaflet, "Which of them")
      ->check(CLI::IsMember({"both", "anterior", "posterior"}))
      ->capture_default_str();
  natural->add_option("--opening", sizes.opening, "Between the free edges' middles along x, in diameters")
      ->capture_default_str();
  natural->add_option("--free-edge", sizes.free_edge, "Length of both free edges together, in diameters")
      ->capture_default_str();
  natural->add_option("--commissure", sizes.commissure, "How far down the leaflets part, in diameters")
      ->capture_default_str();
  natural->add_option("--posterior-length", sizes.posterior_length, "Of that leaflet in its middle, in diameters")
      ->capture_default_str();

  for (auto* shape : {channel, ventricle, leaflet, bileaflet, natural}) {
    add_radius(*shape, arguments);
    add_edge(*shape, arguments);
  }
}
}  // namespace

void add_mesh_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<MeshArguments>();
  auto* command = app.add_subcommand("mesh", "Make, inspect and convert surfaces");
  command->require_subcommand(1);

  add_shapes(*command, action, arguments);
  add_heart_shapes(*command, action, arguments);
  add_moduli_command(*command, action);

  auto* info = command->add_subcommand("info", "Counts, area, volume, edges, angles, and whether it is sound");
  info->add_option("FILE", arguments->input, "The surface")->required();
  info->callback([arguments, &action] {
    action = on_root([arguments] { fmt::print("{}", format(describe(read_surface(arguments->input)))); });
  });

  auto* evened = command->add_subcommand("remesh", "Mend a surface, such as a raw scan, and mesh it evenly");
  evened->add_option("FROM", arguments->input, "The surface to read")->required();
  evened->add_option("TO", arguments->output, "The file to write: .gts, .stl, .obj or .ply")->required();
  evened->add_option("--edge", arguments->remesh.edge, "About how long the edges of the faces are")->required();
  evened->add_option("--fill-holes", arguments->remesh.fill_holes, "Fill holes whose borders are no longer than this");
  evened->add_option("--sharp-angle", arguments->remesh.sharp_angle, "Degrees from which an edge between faces is kept")
      ->capture_default_str();
  evened->callback([arguments, &action] {
    action = on_root([arguments] {
      const auto [surface, mended] = remesh(read_surface_data(arguments->input), arguments->remesh);
      for (const auto& what : mended) fmt::print("{}\n", what);
      if (mended.empty()) fmt::print("nothing had to be mended\n");
      write_and_tell(arguments->output, surface);
      const auto report = describe(surface);
      fmt::print("edges {:.4g} to {:.4g}, mean {:.4g}; angles from {:.1f} to {:.1f} degrees\n", report.edge_min,
                 report.edge_max, report.edge_mean, report.angle_min, report.angle_max);
      constexpr double sharp = 15;
      if (report.angle_min < sharp)
        fmt::print(
            "warning: angles are below {} degrees; edges that are kept as sharp (--sharp-angle, now {}) may force "
            "them, where crossings were mended above all\n",
            sharp, arguments->remesh.sharp_angle);
    });
  });

  auto* convert = command->add_subcommand("convert", "Write a surface in another format");
  convert->add_option("FROM", arguments->input, "The surface to read")->required();
  convert->add_option("TO", arguments->output, "The file to write: .gts, .stl, .obj or .ply")->required();
  convert->callback([arguments, &action] {
    action = on_root([arguments] { write_and_tell(arguments->output, read_surface(arguments->input)); });
  });
}

}  // namespace pliant
