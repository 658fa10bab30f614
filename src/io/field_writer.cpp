#include "io/field_writer.hpp"

#include <fmt/format.h>

#include <vector>

#include "core/error.hpp"
#include "io/agree.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"

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

template <class Real>
void write_file(const std::filesystem::path& path, const Grid& grid, const FlowState& state, double density,
                Moment moment) {
  const auto flow = center<Real>(grid, state, density);
  const auto nodes = nodes_of(grid);
  const auto& n = grid.cells();
  const std::vector<hsize_t> cells{static_cast<hsize_t>(n[2]), static_cast<hsize_t>(n[1]), static_cast<hsize_t>(n[0])};
  auto vectors = cells;
  vectors.push_back(3);
  const Hdf5Rows rows{static_cast<hsize_t>(grid.slab().begin), static_cast<hsize_t>(grid.nz())};
  auto file = Hdf5File::create_shared(path, grid.ranks());
  file.write_attribute("time", moment.time);
  file.write_attribute("step", static_cast<std::int64_t>(moment.step));
  file.write("x", nodes.x, {nodes.x.size()});
  file.write("y", nodes.y, {nodes.y.size()});
  file.write("z", nodes.z, {nodes.z.size()});
  file.write_rows("velocity", std::span<const Real>(flow.velocity), vectors, rows);
  file.write_rows("pressure", std::span<const Real>(flow.pressure), cells, rows);
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
