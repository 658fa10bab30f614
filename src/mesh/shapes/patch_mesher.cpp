#include "mesh/shapes/patch_mesher.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <optional>

#include "core/error.hpp"

namespace pliant {
namespace {

/// Edges longer or shorter than these fractions of what is asked are cut or removed.
constexpr double longest = 1.48, shortest = 0.70;
/// Over which part of an edge derivatives are found, and how often all edges are gone through at most: a chart that
/// distorts too much might never come to an end.
constexpr double part_of_edge = 1e-3;
constexpr int most_passes = 200;
constexpr int rounds = 5, smoothings_a_round = 2, last_smoothings = 8, most_climbs = 60;
/// Smoothing does not make an angle smaller than the first; vertices whose faces all have larger angles than the second
/// are good enough.
const double good_angle = std::cos(33 * std::numbers::pi / 180), best_angle = std::cos(36 * std::numbers::pi / 180);

double chart_area(ChartPoint a, ChartPoint b, ChartPoint c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Squares of lengths in the chart's plane: ss ds^2 + 2 st ds dt + tt dt^2.
struct Metric {
  double ss = 0, st = 0, tt = 0;

  double squared(ChartPoint a, ChartPoint b) const {
    const double s = b[0] - a[0], t = b[1] - a[1];
    return ss * s * s + 2 * st * s * t + tt * t * t;
  }
};

/// The cosine of the smallest angle of a triangle with these squares of its sides: the larger, the worse.
double sharpness(double ab, double bc, double ca) {
  if (!(ab > 0 && bc > 0 && ca > 0)) return 1;
  // The smallest angle is opposite to the shortest side.
  if (ab <= bc && ab <= ca) return (bc + ca - ab) / (2 * std::sqrt(bc * ca));
  if (bc <= ca) return (ab + ca - bc) / (2 * std::sqrt(ab * ca));
  return (ab + bc - ca) / (2 * std::sqrt(ab * bc));
}
double sharpness(Vec3 a, Vec3 b, Vec3 c) { return sharpness(dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)); }
double sharpness(const Metric& m, ChartPoint a, ChartPoint b, ChartPoint c) {
  return sharpness(m.squared(a, b), m.squared(b, c), m.squared(c, a));
}

class PatchMesher {
 public:
  explicit PatchMesher(const Patch& patch) : patch_(patch) {
    start_from_fan();
    for (const auto& hole : patch.holes) insert_hole(hole);
    flip_from_all();
    cut_holes();
  }

  PatchMesh run() {
    refine();
    for (int round = 0; round < rounds; ++round) {
      thin_out();
      refine();
      for (int i = 0; i < smoothings_a_round; ++i) smooth();
    }
    for (int i = 0; i < last_smoothings; ++i) smooth();
    for (int i = 0; i < most_climbs && climb(); ++i) flip_from_all();
    return result();
  }

 private:
  /// Side k of a face, from its vertex k to the next.
  struct Side {
    int face = -1, k = 0;
  };
  static int next(int k) { return k == 2 ? 0 : k + 1; }

  // ---- what there is

  int add_vertex(ChartPoint chart, Vec3 place, bool fixed) {
    chart_.push_back(chart);
    place_.push_back(place);
    step_.push_back(0);
    slopes_.emplace_back();
    fixed_.push_back(fixed);
    face_of_.push_back(-1);
    return static_cast<int>(chart_.size()) - 1;
  }
  /// The derivatives of the surface, by differences.
  void find_slopes(int v) {
    const ChartPoint p = chart_[v];
    const double h = step_[v];
    slopes_[v] = {(patch_.surface({p[0] + h, p[1]}) - patch_.surface({p[0] - h, p[1]})) / (2 * h),
                  (patch_.surface({p[0], p[1] + h}) - patch_.surface({p[0], p[1] - h})) / (2 * h)};
  }
  /// Derivatives everywhere, by differences over a small part of the shortest edge in the chart.
  void find_all_slopes() {
    std::fill(step_.begin(), step_.end(), std::numeric_limits<double>::infinity());
    for (const Face& face : faces_)
      for (int k = 0; k < 3 && face[0] >= 0; ++k) {
        const int a = face[k], b = face[next(k)];
        const double step = part_of_edge * std::hypot(chart_[b][0] - chart_[a][0], chart_[b][1] - chart_[a][1]);
        step_[a] = std::min(step_[a], step);
        step_[b] = std::min(step_[b], step);
      }
    for (int v = 0; v < static_cast<int>(chart_.size()); ++v)
      if (std::isfinite(step_[v])) find_slopes(v);
  }
  void move(int v, ChartPoint p, Vec3 x) {
    chart_[v] = p;
    place_[v] = x;
    find_slopes(v);
  }
  /// The mean metric of some vertices.
  Metric metric_of(std::initializer_list<int> vertices) const {
    Metric sum;
    for (int v : vertices) {
      const auto& [s, t] = slopes_[v];
      sum.ss += dot(s, s) / static_cast<double>(vertices.size());
      sum.st += dot(s, t) / static_cast<double>(vertices.size());
      sum.tt += dot(t, t) / static_cast<double>(vertices.size());
    }
    return sum;
  }
  int add_face() {
    faces_.push_back({-1, -1, -1});
    across_.push_back({-1, -1, -1});
    return static_cast<int>(faces_.size()) - 1;
  }
  bool is_dead(int f) const { return faces_[f][0] < 0; }
  void set_face(int f, Face corners, std::array<int, 3> across) {
    faces_[f] = corners;
    across_[f] = across;
    for (int v : corners) face_of_[v] = f;
  }
  /// `of` has a new neighbour where `old` was.
  void replace_neighbour(int of, int old, int fresh) {
    if (of < 0) return;
    for (int& g : across_[of])
      if (g == old) {
        g = fresh;
        return;
      }
  }
  int corner_of(int f, int v) const { return faces_[f][0] == v ? 0 : faces_[f][1] == v ? 1 : 2; }
  int from(Side side) const { return faces_[side.face][side.k]; }
  int to(Side side) const { return faces_[side.face][next(side.k)]; }
  int opposite(Side side) const { return faces_[side.face][next(next(side.k))]; }
  int neighbour(Side side) const { return across_[side.face][side.k]; }
  /// The same edge as a side of the other face, which there must be.
  Side twin(Side side) const {
    const int g = neighbour(side);
    return {g, corner_of(g, to(side))};
  }
  double chart_area_of(int f) const {
    const auto& [a, b, c] = faces_[f];
    return chart_area(chart_[a], chart_[b], chart_[c]);
  }
  /// Length along the surface over what is asked at the middle.
  double relative_length(Side side) const {
    const int a = from(side), b = to(side);
    return std::sqrt(metric_of({a, b}).squared(chart_[a], chart_[b])) / patch_.edge(0.5 * (place_[a] + place_[b]));
  }

  // ---- changes of connectivity; each leaves an oriented triangulation of the chart

  /// Turns an edge to the other diagonal of its two faces (a, b, c) and (b, a, d); the first face keeps the side from
  /// c to a, the second the side from b to c.
  void flip(Side side) {
    const Side other = twin(side);
    const int f = side.face, g = other.face;
    const int a = from(side), b = to(side), c = opposite(side), d = opposite(other);
    const int bc = across_[f][next(side.k)], ca = across_[f][next(next(side.k))];
    const int ad = across_[g][next(other.k)], db = across_[g][next(next(other.k))];
    set_face(f, {c, a, d}, {ca, ad, g});
    set_face(g, {d, b, c}, {db, bc, f});
    replace_neighbour(ad, g, f);
    replace_neighbour(bc, f, g);
  }
  /// Whether both faces keep their orientation in the chart if the edge is turned.
  bool can_flip(Side side) const {
    if (neighbour(side) < 0) return false;
    const ChartPoint a = chart_[from(side)], b = chart_[to(side)], c = chart_[opposite(side)],
                     d = chart_[opposite(twin(side))];
    const double first = chart_area(c, a, d), second = chart_area(d, b, c);
    return std::min(first, second) > 1e-9 * (first + second);
  }
  /// Whether the smallest angle of the two faces would become larger, both laid out flat: in space long faces could cut
  /// through what the surface encloses.
  bool wants_flip(Side side) const {
    if (!can_flip(side)) return false;
    const int a = from(side), b = to(side), c = opposite(side), d = opposite(twin(side));
    const Metric flat = metric_of({a, b, c, d});
    const auto sharp = [&](int i, int j, int k) { return sharpness(flat, chart_[i], chart_[j], chart_[k]); };
    return std::max(sharp(c, a, d), sharp(d, b, c)) < std::max(sharp(a, b, c), sharp(b, a, d)) - 1e-9;
  }
  /// Flips on from the sides in `pending_` as long as angles become larger. On a plane that ends by itself; on a curved
  /// surface pairs of faces might disagree for ever on what is flat.
  void flip_pending() {
    for (std::size_t allowed = 1000 + 10 * pending_.size(); !pending_.empty();) {
      const Side side = pending_.back();
      pending_.pop_back();
      if (allowed == 0 || is_dead(side.face) || !wants_flip(side)) continue;
      --allowed;
      const int other = neighbour(side);
      flip(side);
      for (int k = 0; k < 3; ++k) {
        pending_.push_back({side.face, k});
        pending_.push_back({other, k});
      }
    }
  }
  void flip_from_all() {
    for (int f = static_cast<int>(faces_.size()) - 1; f >= 0; --f)
      if (!is_dead(f))
        for (int k = 0; k < 3; ++k) pending_.push_back({f, k});
    flip_pending();
  }

  /// A new vertex in the middle of a face becomes a corner of three.
  void put_in_face(int f, int v) {
    const auto [a, b, c] = faces_[f];
    const auto [ab, bc, ca] = across_[f];
    const int g = add_face(), h = add_face();
    set_face(f, {a, b, v}, {ab, g, h});
    set_face(g, {b, c, v}, {bc, h, f});
    set_face(h, {c, a, v}, {ca, f, g});
    replace_neighbour(bc, f, g);
    replace_neighbour(ca, f, h);
    for (int face : {f, g, h})
      for (int k = 0; k < 3; ++k) pending_.push_back({face, k});
  }
  /// A new vertex on an edge that has two faces.
  void put_on_edge(Side side, int v) {
    const Side other = twin(side);
    const int f = side.face, g = other.face;
    const int a = from(side), b = to(side), c = opposite(side), d = opposite(other);
    const int bc = across_[f][next(side.k)], ca = across_[f][next(next(side.k))];
    const int ad = across_[g][next(other.k)], db = across_[g][next(next(other.k))];
    const int h = add_face(), i = add_face();
    set_face(f, {a, v, c}, {i, h, ca});
    set_face(h, {v, b, c}, {g, bc, f});
    set_face(g, {b, v, d}, {h, i, db});
    set_face(i, {v, a, d}, {f, ad, g});
    replace_neighbour(bc, f, h);
    replace_neighbour(ad, g, i);
    for (int face : {f, g, h, i})
      for (int k = 0; k < 3; ++k) pending_.push_back({face, k});
  }
  /// Takes out a vertex that is not fixed, if flips can bring it down to three faces.
  bool take_out(int v) {
    for (;;) {
      ring_of(v);
      if (ring_.size() == 3) break;
      // The best of the edges from v that may be turned.
      std::optional<Side> best;
      double least = 2;
      for (const Side side : ring_) {
        if (!can_flip(side)) continue;
        const Vec3 b = place_[to(side)], c = place_[opposite(side)], d = place_[opposite(twin(side))];
        if (const double sharp = sharpness(d, b, c); sharp < least) least = sharp, best = side;
      }
      if (!best) {
        for (const Side side : ring_) pending_.push_back({side.face, next(side.k)});
        return false;
      }
      flip(*best);
    }
    // Faces (v, a, b), (v, b, c), (v, c, a) become (a, b, c).
    std::array<int, 3> corner{}, outer{}, face{};
    for (int i = 0; i < 3; ++i) {
      corner[i] = to(ring_[i]);
      outer[i] = across_[ring_[i].face][next(ring_[i].k)];
      face[i] = ring_[i].face;
    }
    set_face(face[0], corner, outer);
    for (int i : {1, 2}) {
      replace_neighbour(outer[i], face[i], face[0]);
      faces_[face[i]] = {-1, -1, -1};
    }
    face_of_[v] = -1;
    for (int k = 0; k < 3; ++k) pending_.push_back({face[0], k});
    return true;
  }
  /// The sides that leave a vertex off the border, counter-clockwise, in ring_.
  void ring_of(int v) {
    ring_.clear();
    const int first = face_of_[v];
    int f = first;
    do {
      const int k = corner_of(f, v);
      ring_.push_back({f, k});
      f = across_[f][next(next(k))];
    } while (f != first && f >= 0);
  }

  // ---- the start: the outline seen from the middle, then the holes

  void start_from_fan() {
    const int n = static_cast<int>(patch_.outline.size());
    for (const auto& vertex : patch_.outline) add_vertex(vertex.chart, vertex.place, true);
    n_given_ = n;
    for (const auto& hole : patch_.holes) n_given_ += static_cast<int>(hole.size());
    for (const auto& hole : patch_.holes)
      for (const auto& vertex : hole) add_vertex(vertex.chart, vertex.place, true);
    const int middle = add_vertex(patch_.middle, patch_.surface(patch_.middle), patch_.keeps_middle);
    for (int i = 0; i < n; ++i) add_face();
    for (int i = 0; i < n; ++i) set_face(i, {middle, i, (i + 1) % n}, {(i + n - 1) % n, -1, (i + 1) % n});
    find_all_slopes();
    flip_from_all();
  }

  void insert_hole(const std::vector<BorderVertex>& hole) {
    int v = static_cast<int>(patch_.outline.size());
    for (const auto& other : patch_.holes) {
      if (&other == &hole) break;
      v += static_cast<int>(other.size());
    }
    for (std::size_t i = 0; i < hole.size(); ++i, ++v) {
      const ChartPoint p = hole[i].chart, q = hole[(i + 1) % hole.size()].chart;
      step_[v] = part_of_edge * std::hypot(q[0] - p[0], q[1] - p[1]);
      find_slopes(v);
      insert(v);
      flip_pending();
    }
  }
  /// Puts a vertex where it lies in the chart.
  void insert(int v) {
    constexpr double rounding = 1e-10;
    for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
      if (is_dead(f)) continue;
      const double whole = chart_area_of(f);
      double least = 1;
      int at = 0;
      for (int k = 0; k < 3; ++k) {
        const double part = chart_area(chart_[faces_[f][k]], chart_[faces_[f][next(k)]], chart_[v]) / whole;
        if (part < least) least = part, at = k;
      }
      if (least < -rounding) continue;
      if (least > rounding) return put_in_face(f, v);
      if (across_[f][at] < 0) break;
      return put_on_edge({f, at}, v);
    }
    refuse_holes();
  }
  [[noreturn]] static void refuse_holes() {
    throw InputError("the holes reach over the border, or come too close to it or to each other");
  }

  /// A face with all corners on one hole lies in it.
  void cut_holes() {
    int first = static_cast<int>(patch_.outline.size());
    for (const auto& hole : patch_.holes) {
      const int end = first + static_cast<int>(hole.size());
      for (std::size_t f = 0; f < faces_.size(); ++f)
        if (!is_dead(static_cast<int>(f)) &&
            std::all_of(faces_[f].begin(), faces_[f].end(), [&](int v) { return v >= first && v < end; })) {
          for (int g : across_[f]) replace_neighbour(g, static_cast<int>(f), -1);
          faces_[f] = {-1, -1, -1};
        }
      // Every edge of the hole is a border now, or something stood in its way.
      std::size_t n_borders = 0;
      for (std::size_t f = 0; f < faces_.size(); ++f)
        for (int k = 0; k < 3 && !is_dead(static_cast<int>(f)); ++k) {
          const Side side{static_cast<int>(f), k};
          if (neighbour(side) >= 0 || to(side) < first || to(side) >= end) continue;
          const int expected = to(side) + 1 == end ? first : to(side) + 1;
          if (from(side) != expected) refuse_holes();
          ++n_borders;
        }
      if (n_borders != hole.size()) refuse_holes();
      first = end;
    }
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (int v : faces_[f])
        if (v >= 0) face_of_[v] = static_cast<int>(f);
  }

  // ---- evenness

  struct Candidate {
    double length;
    int a, b;
  };
  /// Edges inside for which `wanted(relative length)`, each once.
  template <class Wanted>
  std::vector<Candidate> edges_where(Wanted wanted) const {
    std::vector<Candidate> edges;
    for (int f = 0; f < static_cast<int>(faces_.size()); ++f)
      for (int k = 0; k < 3 && !is_dead(f); ++k) {
        const Side side{f, k};
        if (neighbour(side) < f) continue;
        if (const double length = relative_length(side); wanted(length))
          edges.push_back({length, from(side), to(side)});
      }
    return edges;
  }
  /// The side from a to b, if there is one.
  std::optional<Side> find_side(int a, int b) {
    const int start = face_of_[a];
    if (start < 0) return std::nullopt;
    // Around a, one way and, where a border stops that, the other way.
    int f = start;
    do {
      const int k = corner_of(f, a);
      if (faces_[f][next(k)] == b) return Side{f, k};
      f = across_[f][next(next(k))];
    } while (f >= 0 && f != start);
    if (f == start) return std::nullopt;
    for (f = across_[start][corner_of(start, a)]; f >= 0; f = across_[f][corner_of(f, a)])
      if (faces_[f][next(corner_of(f, a))] == b) return Side{f, corner_of(f, a)};
    return std::nullopt;
  }

  void refine() {
    for (int pass = 0; pass < most_passes; ++pass) {
      find_all_slopes();
      auto edges = edges_where([](double length) { return length > longest; });
      std::stable_sort(edges.begin(), edges.end(), [](auto& a, auto& b) { return a.length > b.length; });
      bool any = false;
      for (const auto& edge : edges) {
        const auto side = find_side(edge.a, edge.b);
        if (!side || neighbour(*side) < 0) continue;
        const ChartPoint a = chart_[edge.a], b = chart_[edge.b];
        const ChartPoint middle{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
        const int v = add_vertex(middle, patch_.surface(middle), false);
        step_[v] = 0.5 * part_of_edge * std::hypot(b[0] - a[0], b[1] - a[1]);
        find_slopes(v);
        put_on_edge(*side, v);
        flip_pending();
        any = true;
      }
      if (!any) return;
    }
  }

  void thin_out() {
    auto edges = edges_where([](double length) { return length < shortest; });
    std::stable_sort(edges.begin(), edges.end(), [](auto& a, auto& b) { return a.length < b.length; });
    for (const auto& edge : edges) {
      const auto side = find_side(edge.a, edge.b);
      if (!side || relative_length(*side) >= shortest) continue;
      const int v = fixed_[edge.b] ? edge.a : edge.b;
      if (fixed_[v]) continue;
      take_out(v);
      flip_pending();
    }
  }

  /// Where in the chart a vertex comes to if it moves by this along the surface.
  static ChartPoint moved(ChartPoint p, const std::array<Vec3, 2>& d, Vec3 by) {
    const double ss = dot(d[0], d[0]), st = dot(d[0], d[1]), tt = dot(d[1], d[1]);
    const double s = dot(d[0], by), t = dot(d[1], by), whole = ss * tt - st * st;
    return {p[0] + (tt * s - st * t) / whole, p[1] + (ss * t - st * s) / whole};
  }
  /// The worst of the faces in ring_ with their common vertex elsewhere; 2 if one would be turned over in the chart.
  double worst_around(ChartPoint p, Vec3 x) const {
    double worst = -1;
    for (const Side side : ring_) {
      const int b = to(side), c = opposite(side);
      if (!(chart_area(p, chart_[b], chart_[c]) > 0)) return 2;
      worst = std::max(worst, sharpness(x, place_[b], place_[c]));
    }
    return worst;
  }

  /// Moves vertices towards the middle of their faces, which weigh more where edges shall be short, and flips.
  void smooth() {
    for (int v = 0; v < static_cast<int>(chart_.size()); ++v) {
      if (fixed_[v] || face_of_[v] < 0) continue;
      ring_of(v);
      Vec3 sum;
      double weights = 0;
      const double here = patch_.edge(place_[v]);
      for (const Side side : ring_) {
        const Vec3 b = place_[to(side)], c = place_[opposite(side)];
        const Vec3 middle = (place_[v] + b + c) / 3.0;
        const double ratio = here / patch_.edge(middle);
        const double weight = norm(cross(b - place_[v], c - place_[v])) * ratio * ratio * ratio * ratio;
        sum += weight * middle;
        weights += weight;
      }
      Vec3 by = sum / weights - place_[v];
      const auto slopes = slopes_[v];
      const double before = worst_around(chart_[v], place_[v]);
      for (int attempt = 0; attempt < 3; ++attempt, by *= 0.5) {
        const ChartPoint p = moved(chart_[v], slopes, by);
        const Vec3 x = patch_.surface(p);
        if (worst_around(p, x) > std::max(before, good_angle)) continue;
        move(v, p, x);
        break;
      }
    }
    flip_from_all();
  }

  /// Moves vertices at the sharpest faces to where their worst angle is larger; whether any moved.
  bool climb() {
    constexpr int directions = 12;
    bool any = false;
    for (int v = 0; v < static_cast<int>(chart_.size()); ++v) {
      if (fixed_[v] || face_of_[v] < 0) continue;
      ring_of(v);
      double worst = worst_around(chart_[v], place_[v]);
      if (worst <= best_angle) continue;
      const auto slopes = slopes_[v];
      const Vec3 along = normalized(slopes[0]), beside = normalized(slopes[1] - dot(slopes[1], along) * along);
      double step = 0.2 * patch_.edge(place_[v]);
      for (int halving = 0; halving < 5; ++halving, step *= 0.5)
        for (int i = 0; i < directions; ++i) {
          const double angle = 2 * std::numbers::pi * i / directions;
          const ChartPoint p = moved(chart_[v], slopes, step * (std::cos(angle) * along + std::sin(angle) * beside));
          const Vec3 x = patch_.surface(p);
          const double now = worst_around(p, x);
          if (now >= worst - 1e-6) continue;
          worst = now;
          move(v, p, x);
          any = true;
        }
    }
    return any;
  }

  /// Faces in the order in which a walk over neighbours finds them, so that what is near is near in memory.
  PatchMesh result() const {
    const double least = std::cos(10 * std::numbers::pi / 180);
    for (const auto& [a, b, c] : faces_)
      if (a >= 0 && sharpness(place_[a], place_[b], place_[c]) > least)
        throw InputError(
            "no faces without very sharp angles were found for these sizes; give shorter edges, or sizes that "
            "are less unlike");
    PatchMesh mesh;
    std::vector<int> number(place_.size(), -1);
    const int n_kept = n_given_ + (patch_.keeps_middle ? 1 : 0);
    for (int v = 0; v < n_kept; ++v) {
      number[v] = v;
      mesh.positions.push_back(place_[v]);
    }
    std::vector<char> seen(faces_.size(), 0);
    std::vector<int> walk{face_of_[0]};
    seen[walk[0]] = 1;
    for (std::size_t i = 0; i < walk.size(); ++i) {
      Face face = faces_[walk[i]];
      for (int& v : face) {
        if (number[v] < 0) {
          number[v] = static_cast<int>(mesh.positions.size());
          mesh.positions.push_back(place_[v]);
        }
        v = number[v];
      }
      mesh.faces.push_back(face);
      for (int g : across_[walk[i]])
        if (g >= 0 && !seen[g]) {
          seen[g] = 1;
          walk.push_back(g);
        }
    }
    return mesh;
  }

  const Patch& patch_;
  int n_given_ = 0;
  std::vector<ChartPoint> chart_;
  std::vector<Vec3> place_;
  std::vector<double> step_;                 ///< of differences in the chart
  std::vector<std::array<Vec3, 2>> slopes_;  ///< derivatives of the surface at the vertices
  std::vector<char> fixed_;
  std::vector<int> face_of_;  ///< of each vertex; -1: it was taken out
  std::vector<Face> faces_;   ///< -1: it was taken out
  std::vector<std::array<int, 3>> across_;
  std::vector<Side> pending_, ring_;
};
}  // namespace

PatchMesh mesh_patch(const Patch& patch) { return PatchMesher(patch).run(); }

}  // namespace pliant
