#include "mesh/formats/gts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <istream>
#include <optional>
#include <ostream>

#include "core/error.hpp"
#include "mesh/formats/text_lines.hpp"

namespace pliant {
namespace {

constexpr std::size_t most_problems = 20;
// More than that is no surface but garbage that happens to begin with three numbers.
constexpr long most_items = 500'000'000;

class GtsReader {
 public:
  GtsReader(std::istream& input, const std::string& source) : lines_(input, "#!"), source_(source) {
    lines_.on_comment([this] { read_selection(); });
  }

  SurfaceData read() {
    SurfaceData data;
    data.source = source_;
    if (!lines_.next())
      throw InputError(source_ + ": the file is empty; a GTS file begins with 'vertices edges faces'");
    const auto counts = read_header();
    for (long v = 0; v < counts[0] && need("vertex", v, counts[0]); ++v) {
      data.positions.push_back(read_vertex());
      data.vertex_lines.push_back(lines_.number());
    }
    for (long e = 0; e < counts[1] && need("edge", e, counts[1]); ++e) {
      edges_.push_back(read_indices<2>("edge", "vertex", counts[0]));
      edge_lines_.push_back(lines_.number());
    }
    for (long f = 0; f < counts[2] && need("face", f, counts[2]); ++f)
      if (const auto face = read_face(counts[1])) {
        data.faces.push_back(*face);
        data.face_lines.push_back(lines_.number());
      }
    if (!cut_short_ && lines_.next())
      problem("a line is left over after the last face; correct the counts in the first line or remove it");
    take_selections(counts[0], data);
    if (count_ > most_problems)
      problems_.push_back(fmt::format("{}: and {} more problems", source_, count_ - most_problems));
    if (!problems_.empty()) throw InputError(std::move(problems_));
    return data;
  }

 private:
  void problem(const std::string& what) {
    if (++count_ <= most_problems) problems_.push_back(fmt::format("{}:{}: {}", source_, lines_.number(), what));
  }

  std::array<long, 3> read_header() {
    std::array<long, 3> counts{};
    const auto& words = lines_.words();
    bool good = words.size() >= 3;
    for (int i = 0; good && i < 3; ++i)
      good = parse_number(words[i], counts[i]) && counts[i] >= 0 && counts[i] <= most_items;
    if (!good) {
      problem(fmt::format("'{}' is no GTS header; it is 'vertices edges faces', three counts such as '162 480 320'",
                          printable(lines_.line())));
      throw InputError(std::move(problems_));
    }
    return counts;
  }

  /// Steps to the next line; the end of the file is an error that stops the reading.
  bool need(const char* kind, long done, long wanted) {
    if (cut_short_) return false;
    if (lines_.next()) return true;
    problem(
        fmt::format("the file ends after {} of {} {} lines; correct the counts in the first line or restore the rest",
                    done, wanted, kind));
    cut_short_ = true;
    return false;
  }

  Vec3 read_vertex() {
    Vec3 x;
    const auto& words = lines_.words();
    for (int d = 0; d < 3; ++d)
      if (words.size() < 3 || !parse_number(words[d], x[d])) {
        problem(fmt::format("'{}' is no vertex; give three numbers x y z", printable(lines_.line())));
        return {};
      }
    return x;
  }

  /// N indices from 1 to `limit`, returned from 0; all -1 if the line is wrong.
  template <std::size_t N>
  std::array<int, N> read_indices(const char* kind, const char* of, long limit) {
    std::array<int, N> indices;
    const auto& words = lines_.words();
    for (std::size_t k = 0; k < N; ++k) {
      long index = 0;
      const bool is_number = words.size() >= N && parse_number(words[k], index);
      if (!is_number || index < 1 || index > limit) {
        problem(is_number ? fmt::format("the {} names {} {}, out of range: there are {}; correct the index", kind, of,
                                        index, limit)
                          : fmt::format("'{}' is no {}; give {} indices from 1", printable(lines_.line()), kind, N));
        indices.fill(-1);
        return indices;
      }
      indices[k] = static_cast<int>(index - 1);
    }
    return indices;
  }

  std::optional<Face> read_face(long n_edges) {
    const auto sides = read_indices<3>("face", "edge", n_edges);
    if (sides[0] < 0 || edges_[sides[0]][0] < 0 || edges_[sides[1]][0] < 0 || edges_[sides[2]][0] < 0)
      return std::nullopt;
    const auto [a0, a1] = edges_[sides[0]];
    const auto [b0, b1] = edges_[sides[1]];
    const auto [c0, c1] = edges_[sides[2]];
    // The face runs along its first edge to where that meets the second.
    for (const auto& [start, corner] : {std::pair{a0, a1}, std::pair{a1, a0}}) {
      if (corner != b0 && corner != b1) continue;
      const int last = corner == b0 ? b1 : b0;
      if ((c0 == last && c1 == start) || (c1 == last && c0 == start)) {
        if (start == corner || corner == last || last == start) break;
        return Face{start, corner, last};
      }
    }
    problem(fmt::format(
        "degenerate face: its edges {}, {} and {} (lines {}, {} and {}) do not join three vertices; correct "
        "the edges",
        sides[0] + 1, sides[1] + 1, sides[2] + 1, edge_lines_[sides[0]], edge_lines_[sides[1]], edge_lines_[sides[2]]));
    return std::nullopt;
  }

  /// A comment "# selection NAME v v v ..." names vertices; several of one name make one selection. Any other comment
  /// is passed over, one that only begins like that as well.
  void read_selection() {
    const auto& words = lines_.words();
    if (words.size() < 4 || words[0] != "#" || words[1] != "selection") return;
    Selected selected{std::string(words[2]), {}, lines_.number()};
    for (std::size_t i = 3; i < words.size(); ++i)
      if (!parse_number(words[i], selected.vertices.emplace_back())) return;
    selected_.push_back(std::move(selected));
  }
  void take_selections(long n_vertices, SurfaceData& data) {
    for (const auto& selected : selected_) {
      auto& all = data.selections;
      auto at = std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == selected.name; });
      if (at == all.end()) at = all.insert(all.end(), {selected.name, {}});
      for (const long v : selected.vertices) {
        if (v >= 1 && v <= n_vertices) at->vertices.push_back(static_cast<int>(v - 1));
        else if (++count_ <= most_problems)
          problems_.push_back(fmt::format(
              "{}:{}: the selection '{}' names vertex {}, out of range: there are {}, counted from 1; correct it",
              source_, selected.line, printable(selected.name), v, n_vertices));
      }
    }
    for (auto& selection : data.selections) {
      auto& vertices = selection.vertices;
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    }
  }

  struct Selected {
    std::string name;
    std::vector<long> vertices;
    long line;
  };
  std::vector<Selected> selected_;
  LineReader lines_;
  const std::string& source_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<long> edge_lines_;
  std::vector<std::string> problems_;
  std::size_t count_ = 0;
  bool cut_short_ = false;
};

}  // namespace

SurfaceData read_gts(std::istream& input, const std::string& source) { return GtsReader(input, source).read(); }

void write_gts(std::ostream& output, const Surface& surface) {
  const TriangleMesh& mesh = surface.mesh;
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{} {} {} GtsSurface GtsFace GtsEdge GtsVertex\n", mesh.n_vertices(), mesh.n_edges(),
                 mesh.n_faces());
  for (const Vec3& x : surface.positions) fmt::format_to(out, "{:.17g} {:.17g} {:.17g}\n", x.x, x.y, x.z);
  for (const auto& [a, b] : mesh.vertices_of_edge()) fmt::format_to(out, "{} {}\n", a + 1, b + 1);
  for (const auto& [a, b, c] : mesh.edges_of_face()) fmt::format_to(out, "{} {} {}\n", a + 1, b + 1, c + 1);
  constexpr std::size_t in_a_line = 20;
  for (const auto& [name, vertices] : surface.selections)
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (i % in_a_line == 0) fmt::format_to(out, "# selection {}", name);
      fmt::format_to(out, " {}{}", vertices[i] + 1, i + 1 == vertices.size() || (i + 1) % in_a_line == 0 ? "\n" : "");
    }
  output.write(text.data(), static_cast<std::streamsize>(text.size()));
}

}  // namespace pliant
