#include "io/field_writer.hpp"

#include <fmt/format.h>

#include <vector>

#include "core/error.hpp"
#include "parallel/agree.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/shared_file.hpp"

namespace pliant {
namespace {

template <class Real>
struct CenteredFlow {
  std::vector<Real> velocity, pressure;
};

// u_c(i) = (u(i-1) + u(i)) / 2, face i - 1 and face i being the two of cell i; so for v and w.
template <class Real>
CenteredFlow<Real> center(const Grid& grid, const FlowState& state, double density) {
  const auto u = state.u.view();
  const auto v = state.v.view();
  const auto w = state.w.view();
  const auto p = state.p.view();
  const auto cells =
      static_cast<std::size_t>(grid.nx()) * static_cast<std::size_t>(grid.ny()) * static_cast<std::size_t>(grid.nz());
  CenteredFlow<Real> flow;
  flow.velocity.reserve(3 * cells);
  flow.pressure.reserve(cells);
  for (int k = 0; k < grid.nz(); ++k)
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i) {
        flow.velocity.push_back(static_cast<Real>(0.5 * (u(i - 1, j, k) + u(i, j, k))));
        flow.velocity.push_back(static_cast<Real>(0.5 * (v(i, j - 1, k) + v(i, j, k))));
        flow.velocity.push_back(static_cast<Real>(0.5 * (w(i, j, k - 1) + w(i, j, k))));
        flow.pressure.push_back(static_cast<Real>(density * p(i, j, k)));
      }
  return flow;
}

struct Nodes {
  std::vector<double> x, y, z;
};

Nodes nodes_of(const Grid& grid) {
  Nodes nodes;
  for (int i = -1; i < grid.nx(); ++i) nodes.x.push_back(grid.x_face(i));
  for (int j = -1; j < grid.ny(); ++j) nodes.y.push_back(grid.y_face(j));
  for (int k = -1; k < grid.cells()[2]; ++k) nodes.z.push_back(grid.global_z_face()[k]);
  return nodes;
}

struct Places {
  std::uint64_t velocity = 0, pressure = 0;  // bytes from the start of the file
};

// The file with all but the contents of the two large data sets. By the root.
template <class Real>
Places write_frame(const std::filesystem::path& path, const Grid& grid, Moment moment) {
  const auto& n = grid.cells();
  const Hdf5File::Shape cells{static_cast<hsize_t>(n[2]), static_cast<hsize_t>(n[1]), static_cast<hsize_t>(n[0])};
  auto vectors = cells;
  vectors.push_back(3);
  const auto nodes = nodes_of(grid);
  const std::uint64_t overhead = 65536 + 8 * (nodes.x.size() + nodes.y.size() + nodes.z.size());
  const std::uint64_t bytes = overhead + 4 * sizeof(Real) * cells[0] * cells[1] * cells[2];
  set_space_aside(path, bytes);
  Hdf5File file(path, Backing::disk);
  file.write_attribute("time", moment.time);
  file.write_attribute("step", static_cast<std::int64_t>(moment.step));
  file.write("x", nodes.x, {nodes.x.size()});
  file.write("y", nodes.y, {nodes.y.size()});
  file.write("z", nodes.z, {nodes.z.size()});
  const Places places{file.reserve<Real>("velocity", vectors), file.reserve<Real>("pressure", cells)};
  file.close();
  // Creating the file anew has given the space back.
  set_space_aside(path, std::filesystem::file_size(path));
  return places;
}

template <class Real>
void write_file(const std::filesystem::path& path, const Grid& grid, const FlowState& state, double density,
                Moment moment) {
  Places places;
  do_on_root(grid.ranks(), [&] { places = write_frame<Real>(path, grid, moment); });
  check_mpi(MPI_Bcast(&places, sizeof places, MPI_BYTE, 0, grid.ranks().handle()), "MPI_Bcast");
  const auto flow = center<Real>(grid, state, density);
  const auto plane = sizeof(Real) * static_cast<std::size_t>(grid.nx()) * static_cast<std::size_t>(grid.ny());
  const auto first = static_cast<std::uint64_t>(grid.slab().begin);
  SharedFile file(path, grid.ranks());
  file.write(places.velocity + first * 3 * plane, std::span<const Real>(flow.velocity), 3 * plane);
  file.write(places.pressure + first * plane, std::span<const Real>(flow.pressure), plane);
  file.close();
}

std::string describe_grid(const Grid& grid, int bytes, const std::string& file) {
  const auto& n = grid.cells();
  const auto cells = fmt::format("{} {} {}", n[2], n[1], n[0]);
  const auto axis = [&](const char* name, int count) {
    return xdmf_item(fmt::to_string(count + 1), "Float", 8, file + ":/" + name);
  };
  return fmt::format("<Topology TopologyType=\"3DRectMesh\" Dimensions=\"{} {} {}\"/>\n", n[2] + 1, n[1] + 1,
                     n[0] + 1) +
         "<Geometry GeometryType=\"VXVYVZ\">\n" + axis("x", n[0]) + axis("y", n[1]) + axis("z", n[2]) +
         "</Geometry>\n<Attribute Name=\"velocity\" AttributeType=\"Vector\" Center=\"Cell\">\n" +
         xdmf_item(cells + " 3", "Float", bytes, file + ":/velocity") +
         "</Attribute>\n<Attribute Name=\"pressure\" AttributeType=\"Scalar\" Center=\"Cell\">\n" +
         xdmf_item(cells, "Float", bytes, file + ":/pressure") + "</Attribute>\n";
}

}  // namespace

FieldWriter::FieldWriter(const std::filesystem::path& output, const Grid& grid, Precision precision)
    : output_(output), grid_(grid), precision_(precision), series_(output / "fields.xdmf", "fields") {}

void FieldWriter::write(const FlowState& state, double density, Moment moment) {
  const auto name = fmt::format("fields/fields_{:06d}.h5", moment.step);
  const auto path = output_ / name;
  const auto temporary = temporary_name(path);
  do_on_root(grid_.ranks(), [&] { std::filesystem::create_directories(path.parent_path()); });
  try {
    if (precision_ == Precision::single) write_file<float>(temporary, grid_, state, density, moment);
    else write_file<double>(temporary, grid_, state, density, moment);
  } catch (const RunError&) {
    if (grid_.ranks().is_root()) remove_quietly(temporary);
    throw;
  }
  do_on_root(grid_.ranks(), [&] {
    rename_into_place(temporary, path);
    series_.add(moment.time, describe_grid(grid_, precision_ == Precision::single ? 4 : 8, name));
  });
}

}  // namespace pliant
