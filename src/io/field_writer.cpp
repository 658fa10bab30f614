#include "io/field_writer.hpp"

#include <fmt/format.h>

#include <vector>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/shared_file.hpp"
#include "parallel/agree.hpp"

namespace pliant {
namespace {

/// This rank's cells of a quantity.
template <class Real>
std::vector<Real> values_of(const CellQuantity& quantity, const Grid& grid) {
  const auto width = static_cast<std::size_t>(quantity.width);
  std::vector<Real> values;
  values.reserve(width * static_cast<std::size_t>(grid.nx()) * static_cast<std::size_t>(grid.ny()) *
                 static_cast<std::size_t>(grid.nz()));
  double here[3];
  for (int k = 0; k < grid.nz(); ++k)
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i) {
        quantity.at(i, j, k, here);
        for (std::size_t c = 0; c < width; ++c) values.push_back(static_cast<Real>(here[c]));
      }
  return values;
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

// The file with all but the contents of the large data sets, whose places it returns: bytes from the start. By the
// root.
template <class Real>
std::vector<std::uint64_t> write_frame(const std::filesystem::path& path, const Grid& grid,
                                       const std::vector<CellQuantity>& quantities, Moment moment) {
  const auto& n = grid.cells();
  const Hdf5File::Shape cells{static_cast<hsize_t>(n[2]), static_cast<hsize_t>(n[1]), static_cast<hsize_t>(n[0])};
  std::uint64_t width = 0;
  for (const auto& quantity : quantities) width += static_cast<std::uint64_t>(quantity.width);
  const auto nodes = nodes_of(grid);
  const std::uint64_t overhead = 65536 + 8 * (nodes.x.size() + nodes.y.size() + nodes.z.size());
  const std::uint64_t bytes = overhead + width * sizeof(Real) * cells[0] * cells[1] * cells[2];
  set_space_aside(path, bytes);
  Hdf5File file(path, Backing::disk);
  file.write_attribute("time", moment.time);
  file.write_attribute("step", static_cast<std::int64_t>(moment.step));
  file.write("x", nodes.x, {nodes.x.size()});
  file.write("y", nodes.y, {nodes.y.size()});
  file.write("z", nodes.z, {nodes.z.size()});
  std::vector<std::uint64_t> places;
  for (const auto& quantity : quantities) {
    auto shape = cells;
    if (quantity.width > 1) shape.push_back(static_cast<hsize_t>(quantity.width));
    places.push_back(file.reserve<Real>(quantity.name, shape));
  }
  file.close();
  // Creating the file anew has given the space back.
  set_space_aside(path, std::filesystem::file_size(path));
  return places;
}

template <class Real>
void write_file(const std::filesystem::path& path, const Grid& grid, const std::vector<CellQuantity>& quantities,
                Moment moment) {
  std::vector<std::uint64_t> places(quantities.size());
  do_on_root(grid.ranks(), [&] { places = write_frame<Real>(path, grid, quantities, moment); });
  check_mpi(MPI_Bcast(places.data(), static_cast<int>(places.size()), MPI_UINT64_T, 0, grid.ranks().handle()),
            "MPI_Bcast");
  const auto first = static_cast<std::uint64_t>(grid.slab().begin);
  SharedFile file(path, grid.ranks());
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const auto values = values_of<Real>(quantities[q], grid);
    const auto plane = static_cast<std::size_t>(quantities[q].width) * sizeof(Real) *
                       static_cast<std::size_t>(grid.nx()) * static_cast<std::size_t>(grid.ny());
    file.write(places[q] + first * plane, std::span<const Real>(values), plane);
  }
  file.close();
}

std::string describe_grid(const Grid& grid, const std::vector<CellQuantity>& quantities, int bytes,
                          const std::string& file) {
  const auto& n = grid.cells();
  const auto cells = fmt::format("{} {} {}", n[2], n[1], n[0]);
  const auto axis = [&](const char* name, int count) {
    return xdmf_item(fmt::to_string(count + 1), "Float", 8, file + ":/" + name);
  };
  auto text =
      fmt::format("<Topology TopologyType=\"3DRectMesh\" Dimensions=\"{} {} {}\"/>\n", n[2] + 1, n[1] + 1, n[0] + 1) +
      "<Geometry GeometryType=\"VXVYVZ\">\n" + axis("x", n[0]) + axis("y", n[1]) + axis("z", n[2]) + "</Geometry>\n";
  for (const auto& quantity : quantities)
    text += fmt::format("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Cell\">\n", quantity.name,
                        quantity.width == 3 ? "Vector" : "Scalar") +
            xdmf_item(quantity.width == 3 ? cells + " 3" : cells, "Float", bytes, file + ":/" + quantity.name) +
            "</Attribute>\n";
  return text;
}

}  // namespace

std::vector<CellQuantity> flow_quantities(const FlowState& state, double density,
                                          std::shared_ptr<const CenteredFlow> centered, bool with_vorticity) {
  const auto put = [](Vec3 v, double* out) {
    for (int d = 0; d < 3; ++d) out[d] = v[d];
  };
  std::vector<CellQuantity> quantities;
  quantities.push_back({"velocity", 3, [&state, centered, put](int i, int j, int k, double* out) {
                          put(centered->velocity(state, i, j, k), out);
                        }});
  quantities.push_back({"pressure", 1, [p = state.p.view(), density](int i, int j, int k, double* out) {
                          *out = density * p(i, j, k);
                        }});
  if (with_vorticity)
    quantities.push_back({"vorticity", 3, [&state, centered, put](int i, int j, int k, double* out) {
                            put(centered->vorticity(state, i, j, k), out);
                          }});
  return quantities;
}

FieldWriter::FieldWriter(const std::filesystem::path& output, std::string folder, std::string name, const Grid& grid,
                         Precision precision)
    : output_(output),
      folder_(std::move(folder)),
      name_(std::move(name)),
      grid_(grid),
      precision_(precision),
      series_(output / (name_ + ".xdmf"), name_) {}

void FieldWriter::write(const std::vector<CellQuantity>& quantities, Moment moment) {
  const auto name = fmt::format("{}/{}_{:06d}.h5", folder_, name_, moment.step);
  const auto path = output_ / name;
  const auto temporary = temporary_name(path);
  do_on_root(grid_.ranks(), [&] { std::filesystem::create_directories(path.parent_path()); });
  try {
    if (precision_ == Precision::single) write_file<float>(temporary, grid_, quantities, moment);
    else write_file<double>(temporary, grid_, quantities, moment);
  } catch (const RunError&) {
    if (grid_.ranks().is_root()) remove_quietly(temporary);
    throw;
  }
  do_on_root(grid_.ranks(), [&] {
    rename_into_place(temporary, path);
    series_.add(moment.time, describe_grid(grid_, quantities, precision_ == Precision::single ? 4 : 8, name));
  });
}

}  // namespace pliant
