#include "structure/overlap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "config/validate.hpp"
#include "mesh/crossing.hpp"
#include "mesh/distance.hpp"
#include "mesh/geometry.hpp"

namespace pliant {
namespace {

/// One body or copy.
struct Copy {
  std::size_t body, index;
  Placement placement;
  BoundingSphere sphere;
};

// A hinged body begins at its angle.
Placement start_placement(const BodyConfig& config, const Placement& placement) {
  if (config.motion != MotionKind::hinge) return placement;
  const auto& hinge = config.hinge;
  const Mat3 turn = rotation_about(hinge.axis, hinge.angle);
  return {hinge.point + turn * (placement.center - hinge.point), product(turn, placement.rotation)};
}

/// Bodies at their place, for a close look.
struct Placed {
  const TriangleMesh& mesh;
  std::vector<Vec3> positions;
  double size;  ///< diameter of the bounding sphere

  SurfaceView view() const { return {mesh, positions}; }
};

class OverlapSearch {
 public:
  OverlapSearch(const CaseConfig& config, std::span<const PlacedBody> bodies, std::size_t limit, SurfaceData* picture)
      : config_(config), bodies_(bodies), limit_(limit), picture_(picture) {
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (std::size_t i = 0; i < bodies[b].placements.size(); ++i) {
        const auto placement = start_placement(config.bodies[b], bodies[b].placements[i]);
        copies_.push_back({b, i, placement, place(bodies[b].sphere, placement)});
      }
    for (int d = 0; d < 3; ++d) periodic_[d] = is_periodic(config.boundary, d);
  }

  std::vector<std::string> run() {
    for (std::size_t b = 0; b < bodies_.size(); ++b) check_self(b);
    bool counted_all = true;
    std::optional<Placed> first;  // pairs are sorted: it serves all partners of one copy
    std::size_t first_copy = copies_.size();
    for (const auto& [a, b] : close_pairs()) {
      counted_all = count_ < limit_ + most_counted;
      if (!counted_all) break;
      if (a != std::exchange(first_copy, a)) first.emplace(placed(a));
      check_pair(a, b, *first);
    }
    if (count_ > limit_)
      problems_.push_back(
          fmt::format("and {}{} more overlaps of bodies", counted_all ? "" : "at least ", count_ - limit_));
    return std::move(problems_);
  }

 private:
  std::string name_of(std::size_t copy) const {
    const auto& c = copies_[copy];
    return copy_name(config_.bodies[c.body], c.index, bodies_[c.body].placements.size());
  }
  /// Whether it is spelt out.
  bool complain(const std::string& what) {
    if (++count_ > limit_) return false;
    problems_.push_back(what);
    return true;
  }
  void draw(const SurfaceView& surface, std::span<const int> faces) {
    if (!picture_) return;
    std::vector<int> number(surface.positions.size(), -1);
    for (const int f : faces) {
      Face face = surface.mesh.vertices_of_face()[f];
      for (int& v : face) {
        auto& drawn = number[static_cast<std::size_t>(v)];
        if (drawn < 0) {
          drawn = static_cast<int>(picture_->positions.size());
          picture_->positions.push_back(surface.positions[v]);
        }
        v = drawn;
      }
      picture_->faces.push_back(face);
    }
  }
  void draw(const SurfaceView& surface) {
    std::vector<int> all(surface.mesh.vertices_of_face().size());
    std::iota(all.begin(), all.end(), 0);
    draw(surface, all);
  }
  static std::string text_of(Vec3 x) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", x.x, x.y, x.z); }

  /// Pairs (a < b) of copies whose bounding spheres meet, sorted; by a lattice of cells that spheres are listed in.
  std::vector<std::pair<std::size_t, std::size_t>> close_pairs() const {
    const Vec3 size = config_.box.size, origin = config_.box.origin;
    double mean = 0;
    for (const Copy& copy : copies_) mean += 2 * copy.sphere.radius / static_cast<double>(copies_.size());
    const double edge =
        std::max(mean, std::cbrt(size.x * size.y * size.z / std::max<double>(64, 4.0 * copies_.size())));
    std::array<int, 3> n{};
    for (int d = 0; d < 3; ++d) n[d] = static_cast<int>(std::clamp(size[d] / std::max(edge, size[d] / 1e3), 1.0, 1e3));
    std::vector<std::pair<std::size_t, std::size_t>> listed;  // cell, copy
    for (std::size_t c = 0; c < copies_.size(); ++c) {
      const auto& sphere = copies_[c].sphere;
      int first[3], number[3];
      for (int d = 0; d < 3; ++d) {
        const double step = size[d] / n[d];
        double low = std::floor((sphere.center[d] - sphere.radius - origin[d]) / step - 1e-9);
        double high = std::floor((sphere.center[d] + sphere.radius - origin[d]) / step + 1e-9);
        if (!periodic_[d]) {
          low = std::clamp(low, 0.0, n[d] - 1.0);
          high = std::clamp(high, 0.0, n[d] - 1.0);
        }
        number[d] = static_cast<int>(std::min<double>(high - low + 1, n[d]));
        first[d] = static_cast<int>(low - n[d] * std::floor(low / n[d]));
      }
      for (int k = 0; k < number[2]; ++k)
        for (int j = 0; j < number[1]; ++j)
          for (int i = 0; i < number[0]; ++i)
            listed.emplace_back(
                (static_cast<std::size_t>((first[2] + k) % n[2]) * n[1] + (first[1] + j) % n[1]) * n[0] +
                    (first[0] + i) % n[0],
                c);
    }
    std::sort(listed.begin(), listed.end());
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t begin = 0, end = 0; begin < listed.size(); begin = end) {
      while (end < listed.size() && listed[end].first == listed[begin].first) ++end;
      for (std::size_t p = begin; p < end; ++p)
        for (std::size_t q = p + 1; q < end; ++q)
          if (spheres_meet(listed[p].second, listed[q].second)) pairs.emplace_back(listed[p].second, listed[q].second);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

  bool spheres_meet(std::size_t a, std::size_t b) const {
    Vec3 to = copies_[b].sphere.center - copies_[a].sphere.center;
    for (int d = 0; d < 3; ++d)
      if (periodic_[d]) to[d] -= config_.box.size[d] * std::round(to[d] / config_.box.size[d]);
    return norm(to) < copies_[a].sphere.radius + copies_[b].sphere.radius;
  }

  Placed placed(std::size_t copy) const {
    const auto& c = copies_[copy];
    const PlacedBody& body = bodies_[c.body];
    return {body.shape.mesh, place(body.shape.positions, c.placement), 2 * c.sphere.radius};
  }

  void check_self(std::size_t b) {
    const auto& surface = config_.bodies[b].surface;
    const auto* file = std::get_if<FileSurface>(&surface);
    if (!file && !std::holds_alternative<NaturalValveSurface>(surface)) return;
    const auto& shape = bodies_[b].shape;
    const double depth = rounding * 2 * bodies_[b].sphere.radius;
    const auto at = find_self_crossing({shape.mesh, shape.positions}, depth);
    if (!at) return;
    const auto owner = place_of(config_, "body." + config_.bodies[b].name);
    const bool told =
        file ? complain(fmt::format("{} has a surface that crosses itself, at {} of its file; mend the mesh, for "
                                    "instance by `pliant mesh remesh`",
                                    owner, text_of(*at / file->scale)))
             : complain(fmt::format("{} has leaflets that cross, at {} of its surface; change their sizes", owner,
                                    text_of(*at)));
    if (!told || !picture_) return;
    const auto faces = find_self_crossing_faces({shape.mesh, shape.positions}, depth);
    const auto here = place(shape.positions, bodies_[b].placements.front());
    draw({shape.mesh, here}, faces);
  }

  void check_pair(std::size_t a, std::size_t b, const Placed& first) {
    Placed second = placed(b);
    const Vec3 to = copies_[b].sphere.center - copies_[a].sphere.center;
    Vec3 nearest;
    for (int d = 0; d < 3; ++d) nearest[d] = periodic_[d] ? -std::round(to[d] / config_.box.size[d]) : 0.0;
    const auto original = second.positions;
    // Large bodies may meet in an image that is not the nearest one.
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const int image[3] = {i, j, k};
          Vec3 shift;
          bool exists = true;
          for (int d = 0; d < 3; ++d) {
            exists = exists && (periodic_[d] || image[d] == 0);
            shift[d] = (nearest[d] + image[d]) * config_.box.size[d];
          }
          if (!exists || norm(to + shift) >= copies_[a].sphere.radius + copies_[b].sphere.radius) continue;
          for (std::size_t v = 0; v < original.size(); ++v) second.positions[v] = original[v] + shift;
          if (compare(a, b, first, second)) return;
        }
  }

  /// Whether the two overlap as they are placed; says so if they do.
  bool compare(std::size_t a, std::size_t b, const Placed& first, const Placed& second) {
    auto at = deep_crossing(first, second);
    const bool sheets = !first.mesh.is_closed() || !second.mesh.is_closed();
    if (!at && sheets)
      at = find_common_sheet(first.view(), second.view(), rounding * std::min(first.size, second.size));
    if (at) {
      if (complain(fmt::format("{} and {} overlap at the start: their surfaces meet at {}; move one of them{}",
                               full_name(a), full_name(b), text_of(in_box(*at)), advice(a, b))) &&
          picture_) {
        const auto faces =
            find_crossing_faces(first.view(), second.view(), rounding * std::min(first.size, second.size));
        const bool flat = faces.of_a.empty();  // sheets on each other: nothing passes through anything
        if (flat) draw(first.size < second.size ? first.view() : second.view());
        draw(first.view(), faces.of_a);
        draw(second.view(), faces.of_b);
      }
      return true;
    }
    const bool inside = is_inside(first, second), around = !inside && is_inside(second, first);
    if (!inside && !around) return false;
    const auto inner = inside ? a : b, outer = inside ? b : a;
    if (complain(fmt::format("{} lies inside {} at the start, around {}; move one of them{}", full_name(inner),
                             full_name(outer), text_of(in_box(copies_[inner].sphere.center)), advice(a, b))))
      draw(inside ? first.view() : second.view());
    return true;
  }

  /// Where the surfaces cross, and still do when either of them is a little smaller: those that only touch part then.
  static std::optional<Vec3> deep_crossing(const Placed& first, const Placed& second) {
    const double depth = rounding * std::min(first.size, second.size);
    if (!find_crossing(first.view(), second.view(), depth)) return std::nullopt;
    const Placed smaller_first = shrunk(first), smaller_second = shrunk(second);
    if (!find_crossing(smaller_first.view(), second.view(), depth)) return std::nullopt;
    return find_crossing(first.view(), smaller_second.view(), depth);
  }

  static Placed shrunk(const Placed& placed) {
    const Vec3 middle = mean_position(placed.positions);
    Placed smaller = placed;
    for (Vec3& x : smaller.positions) x -= touching * (x - middle);
    return smaller;
  }

  /// Whether `inner` lies inside `outer`, which it does not cross.
  static bool is_inside(const Placed& inner, const Placed& outer) {
    if (!outer.mesh.is_closed()) return false;
    // From just inside a closed body, so that two bodies in the same place are found, and two that touch are not.
    const Face& face = inner.mesh.vertices_of_face()[0];
    Vec3 probe = face_centroid(face, inner.positions);
    if (inner.mesh.is_closed()) probe -= touching * inner.size * normalized(face_vector(face, inner.positions));
    return winding_number(probe, outer.mesh, outer.positions) > 0.75;
  }

  std::string full_name(std::size_t copy) const {
    const auto key = "body." + config_.bodies[copies_[copy].body].name;
    const auto place = place_of(config_, key);
    return place.substr(0, place.size() - key.size()) + "body." + name_of(copy);
  }
  std::string advice(std::size_t a, std::size_t b) const {
    const auto is_listed = [&](std::size_t copy) {
      return config_.bodies[copies_[copy].body].placement.positions.has_value();
    };
    return is_listed(a) || is_listed(b) ? " in its file of positions, or make it smaller" : ", or make it smaller";
  }
  Vec3 in_box(Vec3 x) const {
    for (int d = 0; d < 3; ++d)
      if (periodic_[d]) x[d] -= config_.box.size[d] * std::floor((x[d] - config_.box.origin[d]) / config_.box.size[d]);
    return x;
  }

  static constexpr double rounding = 1e-9;  ///< as a fraction of a body's size
  static constexpr double touching = 1e-6;
  static constexpr std::size_t most_counted = 1000;
  const CaseConfig& config_;
  std::span<const PlacedBody> bodies_;
  std::size_t limit_, count_ = 0;
  SurfaceData* picture_;
  std::vector<Copy> copies_;
  std::array<bool, 3> periodic_{};
  std::vector<std::string> problems_;
};
}  // namespace

std::vector<std::string> find_overlaps(const CaseConfig& config, std::span<const PlacedBody> bodies, std::size_t limit,
                                       SurfaceData* picture) {
  return OverlapSearch(config, bodies, limit, picture).run();
}

}  // namespace pliant
