#include "mesh/shapes/natural_valve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "mesh/shapes/patch_mesher.hpp"
#include "mesh/shapes/shape_parts.hpp"

namespace pliant {
namespace {
constexpr double pi = std::numbers::pi;
/// The annulus from one commissure to the other is a third of the circle.
constexpr double commissure_angle = pi / 3;

/// Half the angle of a circular arc of this length over its chord.
double half_angle_of_arc(double length_over_chord) {
  double low = 0, high = pi;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (middle / std::sin(middle) < length_over_chord ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Where everything is: lengths in those of the case, tilts in radians below the plane of the annulus.
struct Layout {
  double radius, depth, half_chord, chord_x, half_angle, arc_radius, sag;
  double anterior_tilt = 0, posterior_tilt = 0;

  explicit Layout(const NaturalValveSizes& sizes)
      : radius(sizes.radius),
        depth(2 * sizes.radius * sizes.commissure),
        half_chord(sizes.radius * std::sin(commissure_angle)),
        chord_x(sizes.radius * std::cos(commissure_angle)),
        half_angle(half_angle_of_arc(sizes.free_edge * sizes.radius / (2 * half_chord))),
        arc_radius(half_chord / std::sin(half_angle)),
        sag(arc_radius * (1 - std::cos(half_angle))) {
    // The posterior arc's middle, at `sag` from that of the chord, has its wanted distance from the annulus.
    const double length = 2 * radius * sizes.posterior_length, across = radius + chord_x;
    const double distance = std::hypot(across, depth);
    const double turn = (distance * distance + sag * sag - length * length) / (2 * distance * sag);
    if (!(std::abs(turn) < 1))
      throw InputError(fmt::format(
          "natural-valve: posterior_length = {} does not reach from the annulus to its free edge; "
          "give {:.3g} to {:.3g}",
          sizes.posterior_length, std::abs(distance - sag) / (2 * radius), (distance + sag) / (2 * radius)));
    posterior_tilt = std::acos(turn) - std::atan2(depth, across);
    const double reach = std::cos(posterior_tilt) - 2 * radius * sizes.opening / sag;
    if (!(reach > -0.9 && posterior_tilt < 1.4))
      throw InputError(
          fmt::format("natural-valve: with opening = {} and posterior_length = {} the free edges do not fit "
                      "below the annulus; give less",
                      sizes.opening, sizes.posterior_length));
    anterior_tilt = std::acos(reach);
  }

  /// A point of a free edge, u from -1 to 1 along it towards larger y.
  Vec3 on_free_edge(double tilt, double u) const {
    const double angle = u * half_angle, down = arc_radius * (std::cos(angle) - std::cos(half_angle));
    return {chord_x - down * std::cos(tilt), arc_radius * std::sin(angle), -depth - down * std::sin(tilt)};
  }
};

Vec3 between(Vec3 a, Vec3 b, double t) { return (1 - t) * a + t * b; }

/// The vertices that both leaflets share, or that one has by itself, and how its border goes along them.
class Valve {
 public:
  explicit Valve(const NaturalValveSizes& sizes)
      : layout_(sizes),
        edge_(sizes.edge),
        m_(parts_of_circle(sizes.radius, sizes.edge)),
        n_edge_(parts_of(sizes.radius * sizes.free_edge, sizes.edge)),
        n_commissure_(parts_of(layout_.depth, sizes.edge)) {
    for (int j = 0; j < m_; ++j) annulus_.push_back(parts_.add_vertex(circle_vertex(sizes.radius, m_, j)));
    for (int side = 0; side < 2; ++side) {
      // From the annulus down.
      const int top = annulus_[side == 0 ? m_ - m_ / 6 : m_ / 6];
      auto& line = commissure_[side];
      line.push_back(top);
      const Vec3 from = parts_.positions[top], to = from - Vec3{0, 0, layout_.depth};
      for (int i = 1; i <= n_commissure_; ++i)
        line.push_back(parts_.add_vertex(between(from, to, static_cast<double>(i) / n_commissure_)));
    }
  }

  void add_anterior() {
    const auto edge = add_free_edge(layout_.anterior_tilt);
    std::vector<int> top;
    for (int j = -m_ / 6; j <= m_ / 6; ++j) top.push_back(annulus_[(j + m_) % m_]);
    select("anterior-edge", edge);
    add_leaflet(edge, commissure_[1], top, commissure_[0], [this](double u, double t) {
      return between(on_circle(u * commissure_angle), layout_.on_free_edge(layout_.anterior_tilt, u), t);
    });
  }
  void add_posterior() {
    auto edge = add_free_edge(layout_.posterior_tilt);
    std::reverse(edge.begin(), edge.end());
    std::vector<int> top;
    for (int j = m_ / 6; j <= m_ - m_ / 6; ++j) top.push_back(annulus_[j]);
    select("posterior-edge", edge);
    add_leaflet(edge, commissure_[0], top, commissure_[1], [this](double u, double t) {
      return between(on_circle(pi + u * (pi - commissure_angle)), layout_.on_free_edge(layout_.posterior_tilt, -u), t);
    });
  }
  Surface finish() {
    std::vector<int> commissures = commissure_[0];
    commissures.insert(commissures.end(), commissure_[1].begin(), commissure_[1].end());
    select("commissure", commissures);
    return finish_shape(parts_);
  }

 private:
  Vec3 on_circle(double angle) const { return {layout_.radius * std::cos(angle), layout_.radius * std::sin(angle), 0}; }
  /// From the commissure at negative y to the other one.
  std::vector<int> add_free_edge(double tilt) {
    std::vector<int> edge{commissure_[0].back()};
    for (int i = 1; i < n_edge_; ++i)
      edge.push_back(parts_.add_vertex(layout_.on_free_edge(tilt, 2.0 * i / n_edge_ - 1)));
    edge.push_back(commissure_[1].back());
    return edge;
  }
  void select(const std::string& name, const std::vector<int>& vertices) {
    auto& all = parts_.selections;
    auto at = std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == name; });
    if (at == all.end()) at = all.insert(all.end(), {name, {}});
    for (int v : vertices)
      if (std::find(at->vertices.begin(), at->vertices.end(), v) == at->vertices.end()) at->vertices.push_back(v);
  }

  /// `below` from u = -1 to 1, `right` and `left` at u = 1 and -1 from the annulus down, `above` on the annulus from -1
  /// to 1; surface(u, t) has t = 0 at the annulus. In the chart t runs downwards.
  template <class Ruled>
  void add_leaflet(const std::vector<int>& below, const std::vector<int>& right, const std::vector<int>& above,
                   const std::vector<int>& left, Ruled ruled) {
    select("annulus", above);
    select("free-edge", below);
    Patch patch;
    patch.surface = [&](ChartPoint p) { return ruled(p[0], -p[1]); };
    patch.edge = [this](Vec3) { return edge_; };
    patch.middle = {0, -0.5};
    std::vector<int> loop;
    const auto add = [&](int v, double u, double t) {
      patch.outline.push_back({{u, -t}, parts_.positions[v]});
      loop.push_back(v);
    };
    const auto part = [](int i, const std::vector<int>& of) { return i / (static_cast<double>(of.size()) - 1); };
    for (int i = 0; i + 1 < static_cast<int>(below.size()); ++i) add(below[i], 2 * part(i, below) - 1, 1);
    for (int i = static_cast<int>(right.size()) - 1; i > 0; --i) add(right[i], 1, part(i, right));
    for (int i = static_cast<int>(above.size()) - 1; i > 0; --i) add(above[i], 2 * part(i, above) - 1, 0);
    for (int i = 0; i + 1 < static_cast<int>(left.size()); ++i) add(left[i], -1, part(i, left));
    const PatchMesh mesh = mesh_patch(patch);
    for (std::size_t v = loop.size(); v < mesh.positions.size(); ++v)
      loop.push_back(parts_.add_vertex(mesh.positions[v]));
    for (const Face& face : mesh.faces) parts_.faces.push_back({loop[face[0]], loop[face[1]], loop[face[2]]});
  }

  Layout layout_;
  double edge_;
  int m_, n_edge_, n_commissure_;
  ShapeParts parts_;
  std::vector<int> annulus_, commissure_[2];  ///< commissures at negative and at positive y
};
}  // namespace

Surface make_natural_valve(const NaturalValveSizes& sizes) {
  ShapeChecks checks("natural-valve");
  checks.positive("radius", sizes.radius);
  checks.positive("commissure", sizes.commissure);
  checks.positive("posterior_length", sizes.posterior_length);
  checks.edge(sizes.edge, sizes.radius, 2 * pi * sizes.radius * sizes.radius);
  checks.finish();
  const double chord = std::sin(commissure_angle);
  if (!(sizes.free_edge >= 2.1 * chord && sizes.free_edge <= pi))
    throw InputError(
        fmt::format("natural-valve: free_edge = {} must be from {:.3g} (straight between the commissures) to "
                    "{:.3g} (as long as the annulus)",
                    sizes.free_edge, 2.1 * chord, pi));
  if (!(sizes.opening >= 0))
    throw InputError(fmt::format("natural-valve: opening = {} must not be negative", sizes.opening));
  // Shorter edges of its own would not fit the circles that others of this radius and edge have.
  if (const double depth = 2 * sizes.radius * sizes.commissure; sizes.edge > depth)
    throw InputError(
        fmt::format("natural-valve: edge = {} is longer than the commissures, {:.4g}; give a shorter edge, or "
                    "a larger commissure",
                    sizes.edge, depth));
  Valve valve(sizes);
  if (sizes.leaflet != LeafletsMade::posterior) valve.add_anterior();
  if (sizes.leaflet != LeafletsMade::anterior) valve.add_posterior();
  return valve.finish();
}

}  // namespace pliant
