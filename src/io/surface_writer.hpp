#pragma once
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/vec3.hpp"
#include "io/field_writer.hpp"
#include "io/xdmf_series.hpp"
#include "parallel/communicator.hpp"

namespace pliant {

/// A surface as it is at one moment, one entry a vertex; velocities and forces may be empty.
struct SurfaceSnapshot {
  std::span<const Vec3> positions, velocities, forces;
};

/// Writes one body as OUT/surfaces/<name>_<step>.h5, with OUT/<name>.xdmf listing the snapshots.
///
/// A file holds `positions`, `velocity` and `force` [n_vertices][3], `triangles` [n_faces][3] (vertex indices from 0),
/// and the attributes `time` and `step`, all in double precision.
class SurfaceWriter {
 public:
  /// Nothing is written yet.
  SurfaceWriter(const std::filesystem::path& output, std::string name, std::vector<std::array<int, 3>> triangles,
                const Communicator& ranks);

  /// Collective; the root writes its copy of the body, through a temporary file. Throws RunError on all ranks.
  void write(const SurfaceSnapshot& snapshot, Moment moment);

  XdmfSeries& series() { return series_; }
  const XdmfSeries& series() const { return series_; }

 private:
  void write_file(const std::filesystem::path& path, const SurfaceSnapshot& snapshot, Moment moment) const;
  std::string describe(const SurfaceSnapshot& snapshot, const std::string& file) const;

  std::filesystem::path output_;
  std::string name_;
  std::vector<std::array<int, 3>> triangles_;
  Communicator ranks_;
  XdmfSeries series_;
};

}  // namespace pliant
