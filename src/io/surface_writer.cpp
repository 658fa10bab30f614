#include "io/surface_writer.hpp"

#include <fmt/format.h>

#include "parallel/agree.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"

namespace pliant {
namespace {

void write_vectors(Hdf5File& file, const char* name, std::span<const Vec3> vectors) {
  if (vectors.empty()) return;
  std::vector<double> flat;
  flat.reserve(3 * vectors.size());
  for (const auto& v : vectors) flat.insert(flat.end(), {v.x, v.y, v.z});
  file.write(name, flat, {vectors.size(), 3});
}

}  // namespace

SurfaceWriter::SurfaceWriter(const std::filesystem::path& output, std::string name,
                             std::vector<std::array<int, 3>> triangles, const Communicator& ranks)
    : output_(output),
      name_(std::move(name)),
      triangles_(std::move(triangles)),
      ranks_(ranks),
      series_(output / (name_ + ".xdmf"), name_) {}

void SurfaceWriter::write(const SurfaceSnapshot& snapshot, Moment moment) {
  const auto file = fmt::format("surfaces/{}_{:06d}.h5", name_, moment.step);
  do_on_root(ranks_, [&] {
    const auto temporary = temporary_name(output_ / file);
    std::filesystem::create_directories(temporary.parent_path());
    try {
      write_file(temporary, snapshot, moment);
      rename_into_place(temporary, output_ / file);
    } catch (...) {
      remove_quietly(temporary);
      throw;
    }
    series_.add(moment.time, describe(snapshot, file));
  });
}

void SurfaceWriter::write_file(const std::filesystem::path& path, const SurfaceSnapshot& snapshot,
                               Moment moment) const {
  Hdf5File file(path, Backing::memory);
  file.write_attribute("time", moment.time);
  file.write_attribute("step", static_cast<std::int64_t>(moment.step));
  file.write_attribute("name", name_);
  std::vector<std::int32_t> indices;
  indices.reserve(3 * triangles_.size());
  for (const auto& t : triangles_) indices.insert(indices.end(), t.begin(), t.end());
  file.write("triangles", indices, {triangles_.size(), 3});
  write_vectors(file, "positions", snapshot.positions);
  write_vectors(file, "velocity", snapshot.velocities);
  write_vectors(file, "force", snapshot.forces);
  file.close();
}

std::string SurfaceWriter::describe(const SurfaceSnapshot& snapshot, const std::string& file) const {
  const auto vertices = fmt::format("{} 3", snapshot.positions.size());
  std::string text = fmt::format("<Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\">\n", triangles_.size()) +
                     xdmf_item(fmt::format("{} 3", triangles_.size()), "Int", 4, file + ":/triangles") +
                     "</Topology>\n<Geometry GeometryType=\"XYZ\">\n" +
                     xdmf_item(vertices, "Float", 8, file + ":/positions") + "</Geometry>\n";
  const auto add_vector = [&](const char* name, std::span<const Vec3> values) {
    if (values.empty()) return;
    text += fmt::format("<Attribute Name=\"{}\" AttributeType=\"Vector\" Center=\"Node\">\n", name) +
            xdmf_item(vertices, "Float", 8, fmt::format("{}:/{}", file, name)) + "</Attribute>\n";
  };
  add_vector("velocity", snapshot.velocities);
  add_vector("force", snapshot.forces);
  return text;
}

}  // namespace pliant
