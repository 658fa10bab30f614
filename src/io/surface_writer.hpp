#pragma once
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/field_writer.hpp"
#include "io/xdmf_series.hpp"
#include "parallel/communicator.hpp"

namespace pliant {

enum class SurfaceCenter { vertex, face };

/// Numbers that belong to the vertices or faces of surfaces: `width` (1 or 3) each, copy after copy.
struct SurfaceValues {
  std::string name;
  SurfaceCenter center = SurfaceCenter::vertex;
  int width = 3;
  std::vector<double> values;
};

/// The copies of a surface that a rank holds, as they are at one moment. All ranks give the same sets in the same
/// order, the first being the positions of the vertices.
struct SurfaceBatch {
  std::vector<std::int32_t> copies;  ///< their numbers
  std::vector<SurfaceValues> sets;
};

/// Writes all copies of one surface as OUT/surfaces/<name>_<step>.h5, with OUT/<name>.xdmf listing the snapshots.
///
/// A file holds `triangles` [n_faces][3] (vertex indices from 0), `body` [n_faces] (the copy's number) and the sets,
/// each [n][width] in double precision, copies in the order of the ranks that hold them; and the attributes `time` and
/// `step`.
class SurfaceWriter {
 public:
  /// Nothing is written yet. `triangles` of one copy.
  SurfaceWriter(const std::filesystem::path& output, std::string name, std::vector<std::array<int, 3>> triangles,
                int n_vertices, const Communicator& ranks);

  /// Collective; every rank writes its own copies, into a temporary file that is renamed. Throws CollectiveError.
  void write(const SurfaceBatch& batch, Moment moment);

  XdmfSeries& series() { return series_; }
  const XdmfSeries& series() const { return series_; }

 private:
  struct Share {
    std::int64_t first = 0, mine = 0, all = 0;  // copies
  };
  void write_file(const std::filesystem::path& path, const SurfaceBatch& batch, const Share& share,
                  Moment moment) const;
  std::string describe(const SurfaceBatch& batch, const Share& share, const std::string& file) const;
  std::int64_t items(SurfaceCenter center) const;

  std::filesystem::path output_;
  std::string name_;
  std::vector<std::array<int, 3>> triangles_;
  int n_vertices_;
  Communicator ranks_;
  XdmfSeries series_;
};

}  // namespace pliant
