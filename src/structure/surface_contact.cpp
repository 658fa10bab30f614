#include "structure/surface_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "mesh/box_cells.hpp"
#include "mesh/distance.hpp"
#include "mesh/geometry.hpp"

namespace pliant {
namespace {

/// Vertices of either surface bear half of the pressure each. Edges are there for what vertices do not see, the
/// crossing of two edges, and only where that is near: their range is half of the shorter one. Where two even surfaces
/// face each other, 2/pi * 3.46^2 = 7.64 pairs of edges cross in an area of the product of their lengths; they add a
/// quarter.
constexpr double point_share = 0.5;
constexpr double edge_share = 0.25 / 7.64;
constexpr double edge_range = 0.5;
/// Pairs of one surface are not to come nearer than this part of what they are apart at rest, if that is less than the
/// range.
constexpr double rest_fraction = 1.0 / 3.0;
constexpr double own_skin = 0.5;        // of the range
constexpr double floor_fraction = 0.2;  // the same
/// Of two faces that a vertex touches in about one direction the nearer one counts: cosine of 60 degrees.
constexpr double same_direction = 0.5;

Triangle triangle_of(const Face& face, std::span<const Vec3> x) { return {x[face[0]], x[face[1]], x[face[2]]}; }

double point_face_distance(Vec3 x, const Face& face, std::span<const Vec3> positions) {
  return norm(x - nearest_point(x, triangle_of(face, positions)));
}

double edge_edge_distance(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1) {
  const auto [s, t] = nearest_along(a0, a1, b0, b1);
  return norm(a0 + s * (a1 - a0) - b0 - t * (b1 - b0));
}

template <class Elements>
std::vector<Box> boxes_of(const Elements& elements, std::span<const Vec3> positions) {
  std::vector<Box> boxes;
  boxes.reserve(elements.size());
  for (const auto& corners : elements) boxes.push_back(box_around(corners, positions));
  return boxes;
}

bool share_a_vertex(const auto& a, const auto& b) {
  for (const int v : a)
    if (std::find(b.begin(), b.end(), v) != b.end()) return true;
  return false;
}

double largest_norm(std::span<const Vec3> vectors, Vec3 about = {}) {
  double largest = 0;
  for (const Vec3& v : vectors) {
    const Vec3 d = v - about;
    largest = std::max(largest, dot(d, d));
  }
  return std::sqrt(largest);
}

/// The positive root of r = free + c (room / r - 1).
double settled_room(double free, double c, double room) {
  const double b = free - c, root = std::sqrt(b * b + 4 * c * room);
  return b > 0 ? 0.5 * (b + root) : 2 * c * room / (root - b);
}

}  // namespace

struct SurfaceContact::Nodes {
  int n_own;
  std::span<const Vec3> own, mirrored, obstacles;  // positions
  std::span<const Vec3> own_velocities, mirrored_velocities, obstacle_velocities;
  double step;

  Vec3 position(int node, Partner partner) const {
    if (node >= n_own) return obstacles[static_cast<std::size_t>(node - n_own)];
    return (partner == Partner::yielding ? mirrored : own)[static_cast<std::size_t>(node)];
  }
  Vec3 velocity(int node, Partner partner) const {
    if (node >= n_own) return obstacle_velocities[static_cast<std::size_t>(node - n_own)];
    return (partner == Partner::yielding ? mirrored_velocities : own_velocities)[static_cast<std::size_t>(node)];
  }
};

void SurfaceContact::begin(const DeformableBody& body, Obstacles obstacles, double span) {
  const std::size_t n = body.positions.size();
  if (reference_.empty()) {
    mesh_ = body.mesh;
    reference_ = body.reference;
    masses_ = body.masses;
  }
  areas_ = vertex_areas(body.mesh, body.positions);
  start_ = body.positions;
  start_velocities_ = body.velocities;
  span_ = span;
  obstacles_ = std::move(obstacles);
  own_impulses_.assign(n, {});
  obstacle_impulses_.assign(obstacles_.positions.size(), {});
  resistances_.assign(n, 0.0);
  deviation_listed_.clear();
  for (auto* pairs : {&own_points_, &own_edges_})
    for (Pair& pair : *pairs) pair.floor = -1;

  part_of_vertex_.clear(), part_of_face_.clear(), part_of_edge_.clear(), obstacle_edges_.clear();
  std::size_t face = 0;
  for (std::size_t p = 0; p < obstacles_.parts.size(); ++p) {
    const auto& part = obstacles_.parts[p];
    part_of_vertex_.resize(static_cast<std::size_t>(part.vertices_end), static_cast<int>(p));
    part_of_face_.resize(static_cast<std::size_t>(part.faces_end), static_cast<int>(p));
    const auto first_edge = static_cast<std::ptrdiff_t>(obstacle_edges_.size());
    for (; face < static_cast<std::size_t>(part.faces_end); ++face)
      for (std::size_t k = 0; k < 3; ++k) {
        const int a = obstacles_.faces[face][k], b = obstacles_.faces[face][(k + 1) % 3];
        obstacle_edges_.push_back({std::min(a, b), std::max(a, b)});
      }
    std::sort(obstacle_edges_.begin() + first_edge, obstacle_edges_.end());
    obstacle_edges_.erase(std::unique(obstacle_edges_.begin() + first_edge, obstacle_edges_.end()),
                          obstacle_edges_.end());
    part_of_edge_.resize(obstacle_edges_.size(), static_cast<int>(p));
  }
}

SurfaceContact::Nodes SurfaceContact::nodes_of(const ContactMotion& motion) {
  const std::size_t n = motion.positions.size();
  mirrored_.resize(n), mirrored_velocities_.resize(n);
  for (std::size_t v = 0; v < n; ++v) {
    mirrored_[v] = 2.0 * motion.positions[v] - start_[v] - motion.elapsed * start_velocities_[v];
    mirrored_velocities_[v] = 2.0 * motion.velocities[v] - start_velocities_[v];
  }
  moved_obstacles_.resize(obstacles_.positions.size());
  for (std::size_t o = 0; o < moved_obstacles_.size(); ++o)
    moved_obstacles_[o] = obstacles_.positions[o] + motion.elapsed * obstacles_.velocities[o];
  return {static_cast<int>(n),  motion.positions,      mirrored_,  moved_obstacles_, motion.velocities,
          mirrored_velocities_, obstacles_.velocities, motion.step};
}

/// Vertices near which the surface is bent or pressed together so much that it might touch itself close by: a hinge
/// beyond 45 degrees, or an edge below 0.6 of its length at rest, up to three edges away. By Schur's theorem the ends
/// of an arc of length s and curvature 45 degrees an edge are no nearer than 0.63 s up to s = 3.5 edges, and 0.6 * 0.63
/// is more than rest_fraction.
std::vector<char> SurfaceContact::find_bent(std::span<const Vec3> positions) const {
  constexpr double bent = 0.7071, pressed = 0.6;
  std::vector<char> marks(positions.size(), 0);
  const auto normals = face_normals(mesh_, positions);
  for (int e = 0; e < mesh_.n_edges(); ++e) {
    const auto [a, b] = mesh_.vertices_of_edge()[static_cast<std::size_t>(e)];
    const auto [f, g] = mesh_.faces_of_edge()[static_cast<std::size_t>(e)];
    const bool folds =
        g >= 0 && !(dot(normals[static_cast<std::size_t>(f)], normals[static_cast<std::size_t>(g)]) > bent);
    if (folds || norm(positions[a] - positions[b]) < pressed * norm(reference_[a] - reference_[b]))
      marks[static_cast<std::size_t>(a)] = marks[static_cast<std::size_t>(b)] = 1;
  }
  if (std::find(marks.begin(), marks.end(), 1) == marks.end()) return marks;
  for (int ring = 0; ring < 3; ++ring) {
    const auto before = marks;
    for (const auto& [a, b] : mesh_.vertices_of_edge()) {
      if (before[static_cast<std::size_t>(a)]) marks[static_cast<std::size_t>(b)] = 1;
      if (before[static_cast<std::size_t>(b)]) marks[static_cast<std::size_t>(a)] = 1;
    }
  }
  return marks;
}

void SurfaceContact::find_own_pairs(std::span<const Vec3> positions) {
  listed_at_.assign(positions.begin(), positions.end());
  own_points_.clear(), own_edges_.clear();
  const double skin = own_skin * law_.range, reach = law_.range + skin;
  const auto faces = mesh_.vertices_of_face();
  const auto edges = mesh_.vertices_of_edge();
  const auto marks = find_bent(positions);
  double longest = 0, mean_at_rest = 0;
  for (const auto& [a, b] : edges) {
    longest = std::max(longest, norm(positions[a] - positions[b]));
    mean_at_rest += norm(reference_[a] - reference_[b]) / static_cast<double>(edges.size());
  }
  // What is this near at rest does not touch where the surface is smooth.
  const double local = std::min(reach + mean_at_rest, 3.5 * mean_at_rest);
  const auto is_local = [&](int a, int b) {
    const Vec3 d = reference_[static_cast<std::size_t>(a)] - reference_[static_cast<std::size_t>(b)];
    return !marks[static_cast<std::size_t>(a)] && dot(d, d) < local * local;
  };

  // No point of a face is further than 0.58 of its longest edge from a corner, none of an edge further than half of it
  // from an end: where no vertices are near each other, nothing is.
  const double to_corner = 0.58 * longest, between_ends = (1 + edge_range) * longest + skin;
  bool has_near_edges = false;
  std::vector<int> near_faces;
  {
    std::vector<std::array<int, 1>> vertices;
    for (int v = 0; v < mesh_.n_vertices(); ++v) vertices.push_back({v});
    const double far = std::max(reach + to_corner, between_ends);
    const BoxCells cells(boxes_of(vertices, positions), 2 * far);
    for (int v = 0; v < mesh_.n_vertices(); ++v) {
      const Vec3 x = positions[static_cast<std::size_t>(v)], at_rest = reference_[static_cast<std::size_t>(v)];
      bool is_near = false;
      cells.for_each_meeting(Box{x, x}.inflated(far), [&](int w) {
        if (is_local(v, w) || v == w) return;
        const double distance = norm(x - positions[static_cast<std::size_t>(w)]);
        has_near_edges |= distance <= between_ends;
        const double range =
            std::min(law_.range, rest_fraction * norm(at_rest - reference_[static_cast<std::size_t>(w)]));
        is_near |= distance <= range + skin + to_corner;
      });
      if (is_near) near_faces.push_back(v);
    }
  }
  if (!near_faces.empty()) {
    const BoxCells cells(boxes_of(faces, positions), 2 * reach);
    for (const int v : near_faces) {
      const Vec3 x = positions[static_cast<std::size_t>(v)], at_rest = reference_[static_cast<std::size_t>(v)];
      cells.for_each_meeting(Box{x, x}.inflated(reach), [&](int f) {
        const Face& face = faces[static_cast<std::size_t>(f)];
        if ((is_local(v, face[0]) && is_local(v, face[1]) && is_local(v, face[2])) ||
            share_a_vertex(std::array{v}, face))
          return;
        const double distance = point_face_distance(x, face, positions);
        if (distance > reach) return;
        const double range = std::min(law_.range, rest_fraction * point_face_distance(at_rest, face, reference_));
        if (range > 0 && distance <= range + skin)
          own_points_.push_back({{v, face[0], face[1], face[2]},
                                 -1,
                                 Partner::itself,
                                 point_share * law_.strength * areas_[static_cast<std::size_t>(v)],
                                 range,
                                 {}});
      });
    }
  }
  if (has_near_edges) {
    auto boxes = boxes_of(edges, positions);
    const BoxCells cells(boxes);
    for (int e = 0; e < mesh_.n_edges(); ++e) {
      const auto& a = edges[static_cast<std::size_t>(e)];
      const Vec3 a0 = positions[a[0]], a1 = positions[a[1]], rest0 = reference_[a[0]], rest1 = reference_[a[1]];
      const double most = std::min(law_.range, edge_range * norm(a1 - a0));
      cells.for_each_meeting(boxes[static_cast<std::size_t>(e)].inflated(most + skin), [&](int other) {
        if (other <= e) return;
        const auto& b = edges[static_cast<std::size_t>(other)];
        if ((is_local(a[0], b[0]) && is_local(a[1], b[1])) || share_a_vertex(a, b)) return;
        const Vec3 b0 = positions[b[0]], b1 = positions[b[1]];
        const double distance = edge_edge_distance(a0, a1, b0, b1);
        if (distance > most + skin) return;
        const double rest = edge_edge_distance(rest0, rest1, reference_[b[0]], reference_[b[1]]);
        const double range = std::min({most, edge_range * norm(b1 - b0), rest_fraction * rest});
        if (range > 0 && distance <= range + skin)
          own_edges_.push_back({{a[0], a[1], b[0], b[1]}, -1, Partner::itself, edge_share * law_.strength, range, {}});
      });
    }
  }
  const auto by_nodes = [](const Pair& a, const Pair& b) { return a.nodes < b.nodes; };
  std::sort(own_points_.begin(), own_points_.end(), by_nodes);
  std::sort(own_edges_.begin(), own_edges_.end(), by_nodes);
}

void SurfaceContact::find_foreign_pairs(const Nodes& nodes, double remaining) {
  foreign_points_.clear(), foreign_edges_.clear();
  const auto n_own = nodes.n_own;
  const auto faces = mesh_.vertices_of_face();
  const auto edges = mesh_.vertices_of_edge();
  Vec3 drift;
  for (const Vec3& v : obstacles_.velocities) drift += v / static_cast<double>(obstacles_.velocities.size());
  const double near = law_.range + skin(law_.range) + remaining * largest_norm(obstacles_.velocities, drift);
  const auto speed = [&](int own) { return norm(start_velocities_[static_cast<std::size_t>(own)] - drift); };
  const auto partner_of = [&](int part) {
    return obstacles_.parts[static_cast<std::size_t>(part)].yields ? Partner::yielding : Partner::posed;
  };
  const auto both_places = [&](const auto& corners) {
    Box box = box_around(corners, nodes.own);
    for (const int v : corners) box.widen(nodes.mirrored[static_cast<std::size_t>(v)]);
    return box;
  };
  const auto corner = [&](const Face& face, Partner partner) {
    return Triangle{nodes.position(face[0], partner), nodes.position(face[1], partner),
                    nodes.position(face[2], partner)};
  };

  const BoxCells obstacle_faces(boxes_of(obstacles_.faces, nodes.obstacles), 2 * near);
  for (int v = 0; v < n_own; ++v) {
    const double reach = near + remaining * speed(v);
    obstacle_faces.for_each_meeting(both_places(std::array{v}).inflated(reach), [&](int f) {
      const int part = part_of_face_[static_cast<std::size_t>(f)];
      const Vec3 x = nodes.position(v, partner_of(part));
      const Face& face = obstacles_.faces[static_cast<std::size_t>(f)];
      if (point_face_distance(x, face, nodes.obstacles) > reach) return;
      foreign_points_.push_back({{v, n_own + face[0], n_own + face[1], n_own + face[2]},
                                 part,
                                 partner_of(part),
                                 point_share * law_.strength * areas_[static_cast<std::size_t>(v)],
                                 law_.range,
                                 {}});
    });
  }

  std::vector<std::array<int, 1>> points;
  for (int o = 0; o < static_cast<int>(obstacles_.positions.size()); ++o) points.push_back({o});
  const BoxCells obstacle_points(boxes_of(points, nodes.obstacles), 2 * near);
  for (const Face& face : faces) {
    const double reach = near + remaining * std::max({speed(face[0]), speed(face[1]), speed(face[2])});
    obstacle_points.for_each_meeting(both_places(face).inflated(reach), [&](int o) {
      const int part = part_of_vertex_[static_cast<std::size_t>(o)];
      const Vec3 x = nodes.obstacles[static_cast<std::size_t>(o)];
      if (norm(x - nearest_point(x, corner(face, partner_of(part)))) > reach) return;
      foreign_points_.push_back({{n_own + o, face[0], face[1], face[2]},
                                 part,
                                 partner_of(part),
                                 point_share * law_.strength * obstacles_.areas[static_cast<std::size_t>(o)],
                                 law_.range,
                                 {}});
    });
  }

  const BoxCells obstacle_edges(boxes_of(obstacle_edges_, nodes.obstacles), 2 * near);
  for (const auto& edge : edges) {
    const double length = norm(start_[static_cast<std::size_t>(edge[1])] - start_[static_cast<std::size_t>(edge[0])]);
    const double most = std::min(law_.range, edge_range * length);
    const double reach = most - law_.range + near + remaining * std::max(speed(edge[0]), speed(edge[1]));
    obstacle_edges.for_each_meeting(both_places(edge).inflated(reach), [&](int e) {
      const int part = part_of_edge_[static_cast<std::size_t>(e)];
      const auto& other = obstacle_edges_[static_cast<std::size_t>(e)];
      const auto partner = partner_of(part);
      const Vec3 b0 = nodes.obstacles[static_cast<std::size_t>(other[0])],
                 b1 = nodes.obstacles[static_cast<std::size_t>(other[1])];
      if (edge_edge_distance(nodes.position(edge[0], partner), nodes.position(edge[1], partner), b0, b1) > reach)
        return;
      const double range = std::min(most, edge_range * norm(obstacles_.positions[static_cast<std::size_t>(other[1])] -
                                                            obstacles_.positions[static_cast<std::size_t>(other[0])]));
      foreign_edges_.push_back({{edge[0], edge[1], n_own + other[0], n_own + other[1]},
                                part,
                                partner,
                                edge_share * law_.strength,
                                range,
                                {}});
    });
  }
  const auto by_nodes = [](const Pair& a, const Pair& b) {
    return std::tie(a.nodes[0], a.part, a.nodes) < std::tie(b.nodes[0], b.part, b.nodes);
  };
  std::sort(foreign_points_.begin(), foreign_points_.end(), by_nodes);
  std::sort(foreign_edges_.begin(), foreign_edges_.end(), by_nodes);
}

void SurfaceContact::renew_pairs(const Nodes& nodes, double elapsed) {
  const std::size_t n = nodes.own.size();
  if (law_.with_itself) {
    bool old = listed_at_.empty();
    if (!old) {
      Vec3 mean;
      for (std::size_t v = 0; v < n; ++v) mean += nodes.own[v] - listed_at_[v];
      mean = mean / static_cast<double>(n);
      const double most = 0.5 * own_skin * law_.range;
      for (std::size_t v = 0; v < n && !old; ++v) {
        const Vec3 d = nodes.own[v] - listed_at_[v] - mean;
        old = dot(d, d) > most * most;
      }
    }
    if (old) find_own_pairs(nodes.own);
  }
  if (obstacles_.positions.empty()) {
    foreign_points_.clear(), foreign_edges_.clear();
    return;
  }
  // A mirrored position is off by twice the deviation.
  const double most = 0.25 * skin(law_.range);
  bool old = deviation_listed_.empty();
  for (std::size_t v = 0; v < n && !old; ++v) {
    const Vec3 d = nodes.mirrored[v] - nodes.own[v] - deviation_listed_[v];
    old = dot(d, d) > most * most;
  }
  if (!old) return;
  deviation_listed_.resize(n);
  for (std::size_t v = 0; v < n; ++v) deviation_listed_[v] = nodes.mirrored[v] - nodes.own[v];
  find_foreign_pairs(nodes, std::max(0.0, span_ - elapsed));
}

bool SurfaceContact::look(const Nodes& nodes, Pair& pair, bool edges, Touch& touch) const {
  std::array<Vec3, 4> x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = nodes.position(pair.nodes[k], pair.partner);
  double share = pair.share;
  bool inside;
  if (edges) {
    const auto [s, t] = nearest_along(x[0], x[1], x[2], x[3]);
    touch.weights = {1 - s, s, t - 1, -t};
    inside = s > 0 && s < 1 && t > 0 && t < 1;
    // Ends of edges are vertices, which touch faces.
    share *= 36 * s * (1 - s) * t * (1 - t) * norm(x[1] - x[0]) * norm(x[3] - x[2]);
  } else {
    const auto b = nearest_weights(x[0], {x[1], x[2], x[3]});
    touch.weights = {1, -b[0], -b[1], -b[2]};
    inside = b[0] > 0 && b[1] > 0 && b[2] > 0;
  }
  Vec3 apart, approach;
  for (std::size_t k = 0; k < 4; ++k) apart += touch.weights[k] * x[k];
  double gap = norm(apart);
  if (gap >= pair.range) {
    pair.direction = {};  // nothing passes through a whole range in a substep
    if (pair.floor < 0) pair.floor = floor_fraction * pair.range;
    if (gap >= 2 * pair.range) return false;
  }
  Vec3 normal = gap > 0 ? apart / gap : pair.direction;
  if (inside && dot(normal, pair.direction) < 0) gap = -gap, normal = -normal;
  if (gap < pair.range) pair.direction = normal;
  if (pair.floor < 0) pair.floor = std::clamp(0.5 * gap, 0.0, floor_fraction * pair.range);
  for (std::size_t k = 0; k < 4; ++k) approach += touch.weights[k] * nodes.velocity(pair.nodes[k], pair.partner);
  touch.nodes = pair.nodes;
  touch.normal = normal;
  touch.gap = gap;
  touch.free_room = gap - pair.floor + nodes.step * dot(normal, approach);
  touch.share = share;
  touch.room = pair.range - pair.floor;
  touch.partner = pair.partner;
  // Others may push what has not yet come within the range.
  return std::min(touch.free_room, gap - pair.floor - 0.25 * pair.range) < touch.room && share > 0;
}

void SurfaceContact::touch_points(const Nodes& nodes, std::vector<Pair>& pairs) {
  for (std::size_t first = 0, last; first < pairs.size(); first = last) {
    group_.clear();
    for (last = first;
         last < pairs.size() && pairs[last].nodes[0] == pairs[first].nodes[0] && pairs[last].part == pairs[first].part;
         ++last) {
      Touch touch;
      if (look(nodes, pairs[last], false, touch)) group_.push_back(touch);
    }
    if (group_.size() > 1)
      std::stable_sort(group_.begin(), group_.end(), [](const Touch& a, const Touch& b) { return a.gap < b.gap; });
    const std::size_t kept = touches_.size();
    for (const Touch& touch : group_) {
      const bool is_seen = std::any_of(touches_.begin() + static_cast<std::ptrdiff_t>(kept), touches_.end(),
                                       [&](const Touch& t) { return dot(t.normal, touch.normal) > same_direction; });
      if (!is_seen) touches_.push_back(touch);
    }
  }
}

void SurfaceContact::touch_edges(const Nodes& nodes, std::vector<Pair>& pairs) {
  Touch touch;
  for (Pair& pair : pairs)
    if (look(nodes, pair, true, touch)) touches_.push_back(touch);
}

void SurfaceContact::touch_walls(const Nodes& nodes) {
  for (int side = 0; side < 6; ++side) {
    if (walls_.sides[static_cast<std::size_t>(side)] != RepulsionSide::wall) continue;
    const int d = side / 2;
    Vec3 normal;
    normal[d] = side % 2 == 0 ? 1.0 : -1.0;
    const double wall = walls_.origin[d] + (side % 2 == 0 ? 0.0 : walls_.size[d]);
    for (int v = 0; v < nodes.n_own; ++v) {
      const auto at = static_cast<std::size_t>(v);
      const double gap = normal[d] * (nodes.own[at][d] - wall);
      const double free_gap = gap + nodes.step * normal[d] * nodes.own_velocities[at][d];
      if (std::min(free_gap, gap - 0.25 * law_.range) < law_.range)
        touches_.push_back({{v, v, v, v},
                            {1, 0, 0, 0},
                            normal,
                            gap,
                            free_gap,
                            law_.range,
                            law_.strength * areas_[at],
                            Partner::itself,
                            0.0});
    }
  }
}

/// The force of one touch, the others being what they are; returns by how much the gap's end moves.
double SurfaceContact::settle(Touch& touch, const ContactMotion& motion) {
  const auto n_own = static_cast<int>(motion.positions.size());
  const double mirrored = touch.partner == Partner::yielding ? 2.0 : 1.0;
  double opening = 0;  // velocity of the gap by a unit of force
  Vec3 change;         // of the gap's velocity by what has been settled
  for (std::size_t k = 0; k < 4; ++k) {
    if (touch.nodes[k] >= n_own || touch.weights[k] == 0) continue;
    const auto node = static_cast<std::size_t>(touch.nodes[k]);
    opening += mirrored * touch.weights[k] * touch.weights[k] * motion.mobilities[node];
    change += mirrored * touch.weights[k] * (settled_[node] - motion.velocities[node]);
  }
  const double by_itself = motion.step * opening * touch.force;
  const double free = touch.free_room + motion.step * dot(touch.normal, change) - by_itself;
  double force = 0;
  if (free < touch.room)
    force = touch.share * (touch.room / settled_room(free, motion.step * opening * touch.share, touch.room) - 1);
  const Vec3 step = (force - touch.force) * touch.normal;
  touch.force = force;
  for (std::size_t k = 0; k < 4; ++k) {
    if (touch.nodes[k] >= n_own || touch.weights[k] == 0) continue;
    const auto node = static_cast<std::size_t>(touch.nodes[k]);
    settled_[node] += motion.mobilities[node] * touch.weights[k] * step;
  }
  return std::abs(motion.step * opening * force - by_itself);
}

void SurfaceContact::add_touch(const Touch& touch, double step, int n_own, std::span<Vec3> forces) {
  for (std::size_t k = 0; k < 4; ++k) {
    if (touch.weights[k] == 0) continue;
    const Vec3 on_node = touch.weights[k] * touch.force * touch.normal;
    if (touch.nodes[k] >= n_own) {
      obstacle_impulses_[static_cast<std::size_t>(touch.nodes[k] - n_own)] += step * on_node;
      continue;
    }
    const auto node = static_cast<std::size_t>(touch.nodes[k]);
    forces[node] += on_node;
    if (touch.partner == Partner::yielding) own_impulses_[node] += step * on_node;
  }
}

void SurfaceContact::add_forces(const ContactMotion& motion, std::span<Vec3> forces) {
  constexpr int most_turns = 50;
  constexpr double tolerance = 1e-3;  // of the range
  const Nodes nodes = nodes_of(motion);
  renew_pairs(nodes, motion.elapsed);
  if (!motion.masses.empty()) masses_.assign(motion.masses.begin(), motion.masses.end());
  for (std::size_t v = 0; v < resistances_.size(); ++v)
    if (motion.step > 0 && motion.mobilities[v] > 0)
      resistances_[v] = std::max(0.0, 1.0 / motion.mobilities[v] - masses_[v] / motion.step);
  touches_.clear();
  if (law_.with_itself) {
    touch_points(nodes, own_points_);
    touch_edges(nodes, own_edges_);
  }
  touch_points(nodes, foreign_points_);
  touch_edges(nodes, foreign_edges_);
  touch_walls(nodes);

  least_gap_ = std::numeric_limits<double>::infinity();
  for (const Touch& touch : touches_) least_gap_ = std::min(least_gap_, touch.gap);
  if (touches_.empty()) return;
  settled_.assign(motion.velocities.begin(), motion.velocities.end());
  double change = 1;
  for (int turn = 0; turn < most_turns && change > tolerance; ++turn) {
    change = 0;
    for (Touch& touch : touches_) change = std::max(change, settle(touch, motion) / touch.room);
  }
  for (const Touch& touch : touches_) add_touch(touch, motion.step, nodes.n_own, forces);
}

}  // namespace pliant
