#include "diagnostics/inside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "mesh/seen_face.hpp"

namespace pliant {
namespace {

/// Where a line along z passes a face; `winds` is +1 on the way in, -1 on the way out.
struct Crossing {
  int j, i;
  double z;
  int winds;
};

class Lines {
 public:
  Lines(const Grid& grid, std::span<const Face> faces, std::span<const Vec3> positions, int orientation)
      : grid_(grid), orientation_(orientation) {
    for (const Face& face : faces) faces_.emplace_back(face, positions, 2);
  }

  std::vector<InsidePiece> find() {
    std::vector<Crossing> all;
    for (const auto& face : faces_) add_crossings(face, all);
    std::sort(all.begin(), all.end(), in_order);
    std::vector<InsidePiece> pieces;
    for (auto begin = all.begin(); begin != all.end();) {
      const auto end =
          std::find_if(begin, all.end(), [&](const Crossing& c) { return c.i != begin->i || c.j != begin->j; });
      if (is_whole({begin, end})) add_pieces({begin, end}, pieces);
      else add_pieces(find_anew(begin->i, begin->j), pieces);
      begin = end;
    }
    return pieces;
  }

 private:
  static bool in_order(const Crossing& a, const Crossing& b) {
    return std::tie(a.j, a.i, a.z) < std::tie(b.j, b.i, b.z);
  }
  static bool is_whole(std::span<const Crossing> line) {
    int winds = 0;
    for (const auto& crossing : line) winds += crossing.winds;
    return winds == 0;
  }

  // Vertices like to stand at round places, where lines stand too: a shift that shows nowhere keeps them apart.
  double x_of(int i, int attempt) const { return grid_.x_center(i) + (1 + attempt) * 0.6180339e-7 * grid_.dx(); }
  double y_of(int j, int attempt) const { return grid_.y_center(j) + (1 + attempt) * 0.4142136e-7 * grid_.dy(); }

  void add_crossing(const SeenFace& face, int i, int j, int attempt, std::vector<Crossing>& all) const {
    const double x = x_of(i, attempt), y = y_of(j, attempt);
    if (const int winds = face.passes(x, y)) all.push_back({j, i, face.height_at(x, y), orientation_ * winds});
  }

  void add_crossings(const SeenFace& face, std::vector<Crossing>& all) const {
    const auto range = [&](int d, double origin, double spacing) {
      const int first = static_cast<int>(std::floor((face.lower(d) - origin) / spacing - 0.5));
      const int last = static_cast<int>(std::ceil((face.upper(d) - origin) / spacing - 0.5));
      if (grid_.is_periodic(d)) return std::pair(first, last);
      return std::pair(std::max(first, 0), std::min(last, grid_.cells()[static_cast<std::size_t>(d)] - 1));
    };
    const auto [i_first, i_last] = range(0, grid_.origin().x, grid_.dx());
    const auto [j_first, j_last] = range(1, grid_.origin().y, grid_.dy());
    for (int j = j_first; j <= j_last; ++j)
      for (int i = i_first; i <= i_last; ++i) add_crossing(face, i, j, 0, all);
  }

  // Rounding has opened the surface for this line: it goes beside.
  std::vector<Crossing> find_anew(int i, int j) const {
    std::vector<Crossing> line;
    for (int attempt = 1; attempt < 10; ++attempt) {
      line.clear();
      for (const auto& face : faces_) add_crossing(face, i, j, attempt, line);
      if (is_whole(line)) break;
    }
    std::sort(line.begin(), line.end(), in_order);
    return line;
  }

  static void add_pieces(std::span<const Crossing> line, std::vector<InsidePiece>& pieces) {
    int winding = 0;
    for (std::size_t n = 0; n + 1 < line.size(); ++n) {
      winding += line[n].winds;
      if (winding < 1 || line[n].z == line[n + 1].z) continue;
      const bool goes_on = !pieces.empty() && pieces.back().i == line[n].i && pieces.back().j == line[n].j &&
                           pieces.back().to == line[n].z;
      if (goes_on) pieces.back().to = line[n + 1].z;
      else pieces.push_back({line[n].i, line[n].j, line[n].z, line[n + 1].z});
    }
  }

  const Grid& grid_;
  int orientation_;
  std::vector<SeenFace> faces_;
};

}  // namespace

std::vector<InsidePiece> find_inside(const Grid& grid, std::span<const Face> faces, std::span<const Vec3> positions,
                                     double orientation) {
  return Lines(grid, faces, positions, orientation < 0 ? -1 : 1).find();
}

}  // namespace pliant
