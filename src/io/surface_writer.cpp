#include "io/surface_writer.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/shared_file.hpp"
#include "parallel/agree.hpp"

namespace pliant {

SurfaceWriter::SurfaceWriter(const std::filesystem::path& output, std::string name,
                             std::vector<std::array<int, 3>> triangles, int n_vertices, const Communicator& ranks)
    : output_(output),
      name_(std::move(name)),
      triangles_(std::move(triangles)),
      n_vertices_(n_vertices),
      ranks_(ranks),
      series_(output / (name_ + ".xdmf"), name_) {}

std::int64_t SurfaceWriter::items(SurfaceCenter center) const {
  return center == SurfaceCenter::vertex ? n_vertices_ : static_cast<std::int64_t>(triangles_.size());
}

void SurfaceWriter::write(const SurfaceBatch& batch, Moment moment) {
  Share share;
  share.mine = static_cast<std::int64_t>(batch.copies.size());
  check_mpi(MPI_Exscan(&share.mine, &share.first, 1, MPI_INT64_T, MPI_SUM, ranks_.handle()), "MPI_Exscan");
  if (ranks_.is_root()) share.first = 0;
  share.all = ranks_.sum(static_cast<long>(share.mine));
  const auto name = fmt::format("surfaces/{}_{:06d}.h5", name_, moment.step);
  const auto temporary = temporary_name(output_ / name);
  do_on_root(ranks_, [&] { std::filesystem::create_directories(temporary.parent_path()); });
  try {
    write_file(temporary, batch, share, moment);
  } catch (const RunError&) {
    if (ranks_.is_root()) remove_quietly(temporary);
    throw;
  }
  do_on_root(ranks_, [&] {
    rename_into_place(temporary, output_ / name);
    series_.add(moment.time, describe(batch, share, name));
  });
}

void SurfaceWriter::write_file(const std::filesystem::path& path, const SurfaceBatch& batch, const Share& share,
                               Moment moment) const {
  const auto faces = items(SurfaceCenter::face);
  const auto shape = [&](std::int64_t per_copy, int width) {
    return Hdf5File::Shape{static_cast<hsize_t>(per_copy * share.all), static_cast<hsize_t>(width)};
  };
  // Where the data sets are: triangles, body, then the sets of the batch.
  std::vector<std::uint64_t> places(batch.sets.size() + 2);
  do_on_root(ranks_, [&] {
    std::uint64_t bytes = 65536;
    for (const auto& set : batch.sets)
      bytes += 8 * static_cast<std::uint64_t>(items(set.center) * share.all * set.width);
    set_space_aside(path, bytes + 16 * static_cast<std::uint64_t>(faces * share.all));
    Hdf5File file(path, Backing::disk);
    file.write_attribute("time", moment.time);
    file.write_attribute("step", static_cast<std::int64_t>(moment.step));
    file.write_attribute("name", name_);
    places[0] = file.reserve<std::int32_t>("triangles", shape(faces, 3));
    places[1] = file.reserve<std::int32_t>("body", {static_cast<hsize_t>(faces * share.all)});
    for (std::size_t s = 0; s < batch.sets.size(); ++s) {
      const auto& set = batch.sets[s];
      places[s + 2] = file.reserve<double>(
          set.name, set.width == 1 ? Hdf5File::Shape{static_cast<hsize_t>(items(set.center) * share.all)}
                                   : shape(items(set.center), set.width));
    }
    file.close();
    set_space_aside(path, std::filesystem::file_size(path));
  });
  check_mpi(MPI_Bcast(places.data(), static_cast<int>(places.size()), MPI_UINT64_T, 0, ranks_.handle()), "MPI_Bcast");

  std::vector<std::int32_t> triangles, bodies;
  for (std::int64_t c = 0; c < share.mine; ++c) {
    const auto offset = static_cast<std::int32_t>((share.first + c) * n_vertices_);
    for (const auto& t : triangles_) {
      for (int v : t) triangles.push_back(offset + v);
      bodies.push_back(batch.copies[static_cast<std::size_t>(c)]);
    }
  }
  SharedFile file(path, ranks_);
  const auto write = [&](std::uint64_t place, std::int64_t per_copy, auto values, std::size_t number_bytes, int width) {
    const auto row = number_bytes * static_cast<std::size_t>(per_copy * width);
    file.write(place + static_cast<std::uint64_t>(share.first) * row, values, row);
  };
  write(places[0], faces, std::span<const std::int32_t>(triangles), 4, 3);
  write(places[1], faces, std::span<const std::int32_t>(bodies), 4, 1);
  for (std::size_t s = 0; s < batch.sets.size(); ++s) {
    const auto& set = batch.sets[s];
    write(places[s + 2], items(set.center), std::span<const double>(set.values), 8, set.width);
  }
  file.close();
}

std::string SurfaceWriter::describe(const SurfaceBatch& batch, const Share& share, const std::string& file) const {
  const auto vertices = n_vertices_ * share.all, faces = items(SurfaceCenter::face) * share.all;
  std::string text = fmt::format("<Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\">\n", faces) +
                     xdmf_item(fmt::format("{} 3", faces), "Int", 4, file + ":/triangles") +
                     "</Topology>\n<Geometry GeometryType=\"XYZ\">\n" +
                     xdmf_item(fmt::format("{} 3", vertices), "Float", 8, file + ":/positions") + "</Geometry>\n";
  for (const auto& set : batch.sets) {
    if (set.name == "positions") continue;
    const auto n = items(set.center) * share.all;
    text += fmt::format("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">\n", set.name,
                        set.width == 3 ? "Vector" : "Scalar", set.center == SurfaceCenter::vertex ? "Node" : "Cell") +
            xdmf_item(set.width == 3 ? fmt::format("{} 3", n) : fmt::to_string(n), "Float", 8,
                      fmt::format("{}:/{}", file, set.name)) +
            "</Attribute>\n";
  }
  return text + "<Attribute Name=\"body\" AttributeType=\"Scalar\" Center=\"Cell\">\n" +
         xdmf_item(fmt::to_string(faces), "Int", 4, file + ":/body") + "</Attribute>\n";
}

}  // namespace pliant
