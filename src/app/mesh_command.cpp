#include <fmt/format.h>

#include <memory>

#include "app/command.hpp"
#include "core/error.hpp"
#include "mesh/describe.hpp"
#include "mesh/read_surface.hpp"
#include "mesh/shapes/icosphere.hpp"

namespace pliant {
namespace {
struct MeshArguments {
  int frequency = 8;
  double radius = 1.0;
  std::string input, output;
};

void write_and_tell(const std::string& path, const Surface& surface) {
  write_surface(path, surface);
  fmt::print("{}: {} vertices, {} edges, {} faces\n", path, surface.mesh.n_vertices(), surface.mesh.n_edges(),
             surface.mesh.n_faces());
}

/// Meshes are small: the root does the work, and the other ranks have nothing to do.
Action on_root(std::function<void()> work) {
  return [work = std::move(work)](const Communicator& ranks) -> int {
    if (ranks.is_root()) work();
    return exit_success;
  };
}
}  // namespace

void add_mesh_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<MeshArguments>();
  auto* command = app.add_subcommand("mesh", "Make, inspect and convert surfaces");
  command->require_subcommand(1);

  auto* sphere = command->add_subcommand("sphere", "A geodesic sphere of 10 f^2 + 2 vertices");
  sphere->add_option("--frequency", arguments->frequency, "Parts of each edge of the icosahedron")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  sphere->add_option("--radius", arguments->radius, "Of the sphere")->capture_default_str();
  sphere->add_option("-o,--output", arguments->output, "The file to write: .gts, .stl, .obj or .ply")->required();
  sphere->callback([arguments, &action] {
    action = on_root(
        [arguments] { write_and_tell(arguments->output, make_icosphere(arguments->frequency, arguments->radius)); });
  });

  auto* info = command->add_subcommand("info", "Counts, area, volume, edges, angles, and whether it is sound");
  info->add_option("FILE", arguments->input, "The surface")->required();
  info->callback([arguments, &action] {
    action = on_root([arguments] { fmt::print("{}", format(describe(read_surface(arguments->input)))); });
  });

  auto* convert = command->add_subcommand("convert", "Write a surface in another format");
  convert->add_option("FROM", arguments->input, "The surface to read")->required();
  convert->add_option("TO", arguments->output, "The file to write: .gts, .stl, .obj or .ply")->required();
  convert->callback([arguments, &action] {
    action = on_root([arguments] { write_and_tell(arguments->output, read_surface(arguments->input)); });
  });
}

}  // namespace pliant
