#include "mesh/formats/obj.hpp"

#include <fmt/format.h>

#include <istream>
#include <ostream>

#include "core/error.hpp"
#include "mesh/formats/text_lines.hpp"

namespace pliant {

SurfaceData read_obj(std::istream& input, const std::string& source) {
  SurfaceData data;
  data.source = source;
  std::vector<std::string> problems;
  LineReader lines(input, "#");
  while (lines.next() && problems.size() < 20) {
    const auto& words = lines.words();
    if (words[0] == "v") {
      Vec3 x;
      bool good = words.size() >= 4;
      for (int d = 0; good && d < 3; ++d) good = parse_number(words[d + 1], x[d]);
      if (!good)
        problems.push_back(
            fmt::format("{}:{}: '{}' is no vertex; give 'v x y z'", source, lines.number(), printable(lines.line())));
      data.positions.push_back(x);
      data.vertex_lines.push_back(lines.number());
    } else if (words[0] == "f") {
      std::vector<int> corners;
      for (std::size_t k = 1; k < words.size(); ++k) {
        long index = 0;
        if (!parse_number(words[k].substr(0, words[k].find('/')), index) || index == 0) break;
        // Negative indices count back from the last vertex so far.
        corners.push_back(static_cast<int>(index > 0 ? index - 1 : static_cast<long>(data.positions.size()) + index));
      }
      if (corners.size() + 1 != words.size() || corners.size() < 3) {
        problems.push_back(fmt::format("{}:{}: '{}' is no face; give 'f' and at least three vertex indices from 1",
                                       source, lines.number(), printable(lines.line())));
        continue;
      }
      for (std::size_t k = 2; k < corners.size(); ++k) {
        data.faces.push_back({corners[0], corners[k - 1], corners[k]});
        data.face_lines.push_back(lines.number());
      }
    }
  }
  if (problems.empty() && data.faces.empty())
    problems.push_back(source + ": no face was found; is this a Wavefront OBJ file?");
  if (!problems.empty()) throw InputError(std::move(problems));
  return data;
}

void write_obj(std::ostream& output, const Surface& surface) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (const Vec3& x : surface.positions) fmt::format_to(out, "v {:.17g} {:.17g} {:.17g}\n", x.x, x.y, x.z);
  for (const auto& [a, b, c] : surface.mesh.vertices_of_face())
    fmt::format_to(out, "f {} {} {}\n", a + 1, b + 1, c + 1);
  output.write(text.data(), static_cast<std::streamsize>(text.size()));
}

}  // namespace pliant
