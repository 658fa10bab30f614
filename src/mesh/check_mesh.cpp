#include "mesh/check_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "mesh/geometry.hpp"

namespace pliant {
namespace {

/// Collects sentences about one source and counts those beyond the limit.
class ProblemList {
 public:
  ProblemList(const SurfaceData& data, std::size_t limit) : data_(data), limit_(limit) {}

  void at_face(std::size_t f, const std::string& what) { add(place(data_.face_lines, f, "face"), what); }
  void at_vertex(std::size_t v, const std::string& what) { add(place(data_.vertex_lines, v, "vertex"), what); }
  void at_source(const std::string& what) { add(data_.source, what); }
  bool empty() const { return count_ == 0; }

  std::string face_name(std::size_t f) const { return item_name(data_.face_lines, f, "face"); }
  std::string vertex_name(std::size_t v) const { return item_name(data_.vertex_lines, v, "vertex"); }

  std::vector<std::string> take() {
    if (count_ > limit_) problems_.push_back(fmt::format("{}: and {} more problems", data_.source, count_ - limit_));
    return std::move(problems_);
  }

 private:
  std::string place(const std::vector<long>& lines, std::size_t item, const char* kind) const {
    if (item < lines.size()) return fmt::format("{}:{}", data_.source, lines[item]);
    return fmt::format("{}, {} {}", data_.source, kind, number(item));
  }
  std::string item_name(const std::vector<long>& lines, std::size_t item, const char* kind) const {
    if (item < lines.size()) return fmt::format("the {} of line {}", kind, lines[item]);
    return fmt::format("{} {}", kind, number(item));
  }
  std::size_t number(std::size_t item) const { return item + static_cast<std::size_t>(data_.first_number); }
  void add(const std::string& where, const std::string& what) {
    if (++count_ <= limit_) problems_.push_back(where + ": " + what);
  }

  const SurfaceData& data_;
  std::size_t limit_, count_ = 0;
  std::vector<std::string> problems_;
};

void check_positions(const SurfaceData& data, ProblemList& problems) {
  for (std::size_t v = 0; v < data.positions.size(); ++v) {
    const Vec3 x = data.positions[v];
    if (!std::isfinite(x.x) || !std::isfinite(x.y) || !std::isfinite(x.z))
      problems.at_vertex(v, "a coordinate is not a finite number; give three finite numbers");
  }
}

void check_indices(const SurfaceData& data, ProblemList& problems) {
  const int n = static_cast<int>(data.positions.size());
  for (std::size_t f = 0; f < data.faces.size(); ++f) {
    const Face& face = data.faces[f];
    const auto bad = std::find_if(face.begin(), face.end(), [&](int v) { return v < 0 || v >= n; });
    if (bad != face.end())
      problems.at_face(f, fmt::format("the face names vertex {}, but there are {} vertices{}; correct the index",
                                      static_cast<long>(*bad) + data.first_number, n,
                                      data.first_number == 0 ? ", counted from 0" : ""));
    else if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0])
      problems.at_face(f, "degenerate face: it names a vertex twice; remove the face or correct its vertices");
  }
}

void check_areas(const SurfaceData& data, ProblemList& problems) {
  for (std::size_t f = 0; f < data.faces.size(); ++f) {
    const Face& face = data.faces[f];
    double longest_squared = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 side = data.positions[face[(k + 1) % 3]] - data.positions[face[k]];
      longest_squared = std::max(longest_squared, dot(side, side));
    }
    if (norm(face_vector(face, data.positions)) <= 1e-10 * longest_squared)
      problems.at_face(f, "degenerate face: its three vertices lie on a line, the area is 0; remove or remesh it");
  }
}

void check_duplicate_faces(const SurfaceData& data, ProblemList& problems) {
  const auto key = [&](int f) {
    Face sorted = data.faces[f];
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  };
  std::vector<int> order(data.faces.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key(order[i]) == key(order[i - 1]))
      problems.at_face(order[i], fmt::format("duplicate face: {} has the same vertices; remove one of them",
                                             problems.face_name(order[i - 1])));
}

void check_vertices(const SurfaceData& data, ProblemList& problems) {
  std::vector<char> used(data.positions.size(), 0);
  for (const Face& face : data.faces)
    for (int v : face) used[v] = 1;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (!used[v]) problems.at_vertex(v, "unused vertex: no face names it; remove it");

  const auto key = [&](int v) {
    const Vec3 x = data.positions[v];
    return std::array<double, 3>{x.x, x.y, x.z};
  };
  std::vector<int> order(data.positions.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key(order[i]) == key(order[i - 1]))
      problems.at_vertex(order[i], fmt::format("duplicate vertex: {} is at the same place; merge them",
                                               problems.vertex_name(order[i - 1])));
}

void check_edges(const SurfaceData& data, Closure closure, ProblemList& problems) {
  struct Side {
    int low, high, face;
    bool forward;
  };
  std::vector<Side> sides;
  sides.reserve(3 * data.faces.size());
  for (std::size_t f = 0; f < data.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = data.faces[f][k], b = data.faces[f][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(f), a < b});
    }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const Side& a, const Side& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });

  // A flipped face disagrees with each neighbour; name the face with the most disagreements, once.
  struct Clash {
    int first, second, low, high;
  };
  std::vector<Clash> clashes;
  std::vector<int> clash_count(data.faces.size(), 0);
  std::size_t borders = 0;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    const auto [low, high, face, forward] = sides[i];
    if (end - i > 2) {
      problems.at_face(
          sides[i + 2].face,
          fmt::format("non-manifold edge: the edge from {} to {} belongs to {} faces ({}, {} and this one); "
                      "an edge may have two",
                      problems.vertex_name(low), problems.vertex_name(high), end - i, problems.face_name(face),
                      problems.face_name(sides[i + 1].face)));
    } else if (end - i == 2) {
      if (forward == sides[i + 1].forward) {
        clashes.push_back({face, sides[i + 1].face, low, high});
        ++clash_count[face];
        ++clash_count[sides[i + 1].face];
      }
    } else {
      ++borders;
      if (closure == Closure::closed)
        problems.at_face(face,
                         fmt::format("hole: the edge from {} to {} has only this face, but the body must be closed; "
                                     "fill the hole, or say that the surface is open (surface.open = true)",
                                     problems.vertex_name(low), problems.vertex_name(high)));
    }
    i = end;
  }
  std::vector<char> named(data.faces.size(), 0);
  std::stable_sort(clashes.begin(), clashes.end(), [&](const Clash& a, const Clash& b) {
    return std::max(clash_count[a.first], clash_count[a.second]) >
           std::max(clash_count[b.first], clash_count[b.second]);
  });
  for (const Clash& clash : clashes) {
    if (named[clash.first] || named[clash.second]) continue;
    const bool second_is_worse = clash_count[clash.second] >= clash_count[clash.first];
    const int flipped = second_is_worse ? clash.second : clash.first;
    named[flipped] = 1;
    problems.at_face(flipped,
                     fmt::format("flipped face: it runs along the edge from {} to {} in the same direction as {}; "
                                 "reverse the order of its vertices (GTS: of its edges)",
                                 problems.vertex_name(clash.low), problems.vertex_name(clash.high),
                                 problems.face_name(second_is_worse ? clash.first : clash.second)));
  }
  if (closure == Closure::open && borders == 0)
    problems.at_source("the surface is closed, but an open one is asked for; cut it or use it as a closed body");
}

void check_orientation(const SurfaceData& data, ProblemList& problems) {
  double six_volumes = 0;
  for (const Face& face : data.faces)
    six_volumes += dot(data.positions[face[0]] - data.positions[0], face_vector(face, data.positions));
  if (six_volumes <= 0)
    problems.at_source(
        fmt::format("inward normals: the enclosed volume is {:.6g}; reverse the order of the vertices of "
                    "every face (GTS: of the edges)",
                    six_volumes / 6.0));
}

}  // namespace

std::vector<std::string> find_mesh_problems(const SurfaceData& data, Closure closure, std::size_t limit) {
  ProblemList problems(data, limit);
  if (data.positions.empty() || data.faces.empty()) {
    problems.at_source(fmt::format("the surface has {} vertices and {} faces; it needs at least three and one",
                                   data.positions.size(), data.faces.size()));
    return problems.take();
  }
  check_positions(data, problems);
  check_indices(data, problems);
  // The checks below follow the indices, so they only run once these are sound.
  if (!problems.empty()) return problems.take();
  check_areas(data, problems);
  check_duplicate_faces(data, problems);
  check_edges(data, closure, problems);
  check_vertices(data, problems);
  if (problems.empty() && closure == Closure::closed) check_orientation(data, problems);
  return problems.take();
}

Surface make_surface(SurfaceData data, Closure closure) {
  auto problems = find_mesh_problems(data, closure);
  if (!problems.empty()) throw InputError(std::move(problems));
  const int n_vertices = static_cast<int>(data.positions.size());
  return {TriangleMesh(n_vertices, std::move(data.faces)), std::move(data.positions), std::move(data.selections)};
}

}  // namespace pliant
