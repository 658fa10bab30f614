#include "mesh/formats/stl.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <istream>
#include <iterator>
#include <map>
#include <ostream>
#include <sstream>

#include "core/error.hpp"
#include "mesh/formats/text_lines.hpp"
#include "mesh/geometry.hpp"

namespace pliant {
namespace {

/// Gives equal corners the same vertex.
class Welder {
 public:
  explicit Welder(SurfaceData& data) : data_(data) {}
  int vertex(Vec3 x, long line) {
    const auto [entry, is_new] = known_.try_emplace({x.x, x.y, x.z}, static_cast<int>(data_.positions.size()));
    if (is_new) {
      data_.positions.push_back(x);
      if (line > 0) data_.vertex_lines.push_back(line);
    }
    return entry->second;
  }

 private:
  SurfaceData& data_;
  std::map<std::array<double, 3>, int> known_;
};

SurfaceData read_text(const std::string& bytes, const std::string& source) {
  SurfaceData data;
  data.source = source;
  Welder welder(data);
  std::vector<std::string> problems;
  std::istringstream input(bytes);
  LineReader lines(input, "");
  std::vector<int> corners;
  long first_line = 0;
  while (lines.next() && problems.size() < 20) {
    const auto& words = lines.words();
    if (words[0] == "facet") {
      corners.clear();
      first_line = lines.number();
    } else if (words[0] == "vertex") {
      Vec3 x;
      bool good = words.size() == 4;
      for (int d = 0; good && d < 3; ++d) good = parse_number(words[d + 1], x[d]);
      if (!good)
        problems.push_back(fmt::format("{}:{}: '{}' is no vertex; give 'vertex x y z'", source, lines.number(),
                                       printable(lines.line())));
      corners.push_back(good ? welder.vertex(x, lines.number()) : 0);
    } else if (words[0] == "endfacet") {
      if (corners.size() == 3) {
        data.faces.push_back({corners[0], corners[1], corners[2]});
        data.face_lines.push_back(first_line);
      } else {
        problems.push_back(
            fmt::format("{}:{}: the facet has {} vertices; it needs three", source, first_line, corners.size()));
      }
    } else if (words[0] != "outer" && words[0] != "endloop" && words[0] != "solid" && words[0] != "endsolid") {
      problems.push_back(fmt::format("{}:{}: '{}' is no line of an STL file; remove it", source, lines.number(),
                                     printable(lines.line())));
    }
  }
  if (problems.empty() && data.faces.empty()) problems.push_back(source + ": no facet was found; is this an STL file?");
  if (!problems.empty()) throw InputError(std::move(problems));
  return data;
}

constexpr std::size_t header_bytes = 84, facet_bytes = 50;

SurfaceData read_binary(const std::string& bytes, const std::string& source) {
  SurfaceData data;
  data.source = source;
  Welder welder(data);
  for (std::size_t at = header_bytes; at + facet_bytes <= bytes.size(); at += facet_bytes) {
    std::array<float, 12> values;  // normal, then three corners; little endian, as this machine is
    std::memcpy(values.data(), bytes.data() + at, sizeof values);
    Face face;
    for (int k = 0; k < 3; ++k) face[k] = welder.vertex({values[3 * k + 3], values[3 * k + 4], values[3 * k + 5]}, 0);
    data.faces.push_back(face);
  }
  return data;
}

}  // namespace

SurfaceData read_stl(std::istream& input, const std::string& source) {
  const std::string bytes{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  if (bytes.empty()) throw InputError(source + ": the file is empty; give an STL surface");
  if (bytes.size() >= header_bytes) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    // Some binary files begin with "solid" as well: the size decides.
    if (bytes.size() == header_bytes + facet_bytes * count) return read_binary(bytes, source);
  }
  if (bytes.compare(0, 5, "solid") != 0)
    throw InputError(source +
                     ": this is no STL file: it does not begin with 'solid', and its size fits no count of facets");
  return read_text(bytes, source);
}

void write_stl(std::ostream& output, const Surface& surface) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "solid surface\n");
  for (const Face& face : surface.mesh.vertices_of_face()) {
    const Vec3 n = normalized(face_vector(face, surface.positions));
    fmt::format_to(out, "facet normal {:.17g} {:.17g} {:.17g}\nouter loop\n", n.x, n.y, n.z);
    for (int v : face) {
      const Vec3 x = surface.positions[v];
      fmt::format_to(out, "vertex {:.17g} {:.17g} {:.17g}\n", x.x, x.y, x.z);
    }
    fmt::format_to(out, "endloop\nendfacet\n");
  }
  fmt::format_to(out, "endsolid surface\n");
  output.write(text.data(), static_cast<std::streamsize>(text.size()));
}

}  // namespace pliant
