#include "diagnostics/inside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace pliant {
namespace {

/// Where a line along z passes a face; `winds` is +1 on the way in, -1 on the way out.
struct Crossing {
  int j, i;
  double z;
  int winds;
};

/// A face seen along z.
class SeenFace {
 public:
  SeenFace(const Face& face, std::span<const Vec3> positions) : face_(face) {
    for (std::size_t c = 0; c < 3; ++c) corners_[c] = positions[static_cast<std::size_t>(face[c])];
    normal_ = cross(corners_[1] - corners_[0], corners_[2] - corners_[0]);
  }

  double lower(int d) const { return std::min({corners_[0][d], corners_[1][d], corners_[2][d]}); }
  double upper(int d) const { return std::max({corners_[0][d], corners_[1][d], corners_[2][d]}); }

  /// +1 if the line at (x, y) passes upwards into the inside, -1 if out of it, 0 if it misses the face. Two faces ask
  /// the same question of the edge that they share, so that a line through it passes one of them.
  int passes(double x, double y) const {
    std::array<bool, 3> is_left{};
    for (std::size_t c = 0; c < 3; ++c) is_left[c] = left_of(c, (c + 1) % 3, x, y);
    if (is_left[0] != is_left[1] || is_left[1] != is_left[2]) return 0;
    return is_left[0] ? -1 : 1;
  }

  double height_at(double x, double y) const {
    const double low = lower(2), high = upper(2);
    const double z = corners_[0].z - (normal_.x * (x - corners_[0].x) + normal_.y * (y - corners_[0].y)) / normal_.z;
    return z >= low ? std::min(z, high) : low;  // an upright face has no slope
  }

 private:
  bool left_of(std::size_t from, std::size_t to, double x, double y) const {
    const bool is_turned = face_[from] > face_[to];
    const Vec3 a = corners_[is_turned ? to : from], b = corners_[is_turned ? from : to];
    const bool is_left = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) > 0;
    return is_left != is_turned;
  }

  Face face_;
  std::array<Vec3, 3> corners_;
  Vec3 normal_;
};

class Lines {
 public:
  Lines(const Grid& grid, std::span<const Face> faces, std::span<const Vec3> positions, int orientation)
      : grid_(grid), orientation_(orientation) {
    for (const Face& face : faces) faces_.emplace_back(face, positions);
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
