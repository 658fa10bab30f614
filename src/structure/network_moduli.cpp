#include "structure/network_moduli.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mesh/geometry.hpp"
#include "potentials/moduli.hpp"
#include "structure/make_body.hpp"

namespace pliant {
namespace {

using Field = std::vector<Vec3>;

double product(const Field& a, const Field& b) {
  double sum = 0;
  for (std::size_t v = 0; v < a.size(); ++v) sum += dot(a[v], b[v]);
  return sum;
}

double largest(const Field& field) {
  double most = 0;
  for (const Vec3& v : field) most = std::max(most, norm(v));
  return most;
}

/// The second derivative of energies at the reference as a linear map, by differences of forces.
class Hessian {
 public:
  Hessian(const PotentialSet& set, const Surface& surface)
      : set_(set), reference_(surface.positions), shape_(surface.mesh), moved_(reference_.size()) {
    const auto lengths = edge_lengths(surface.mesh, surface.positions);
    for (double length : lengths) mean_edge_ += length / static_cast<double>(lengths.size());
  }

  /// Minus the forces that a displacement makes.
  Field operator*(const Field& displacement) {
    Field ahead(moved_.size()), behind(moved_.size());
    const double size = largest(displacement);
    if (size == 0) return ahead;
    const double step = 1e-4 * mean_edge_ / size;
    forces_at(displacement, step, ahead);
    forces_at(displacement, -step, behind);
    for (std::size_t v = 0; v < ahead.size(); ++v) ahead[v] = 0.5 / step * (behind[v] - ahead[v]);
    return ahead;
  }

  double mean_edge() const { return mean_edge_; }

 private:
  void forces_at(const Field& displacement, double step, Field& forces) {
    for (std::size_t v = 0; v < moved_.size(); ++v) moved_[v] = reference_[v] + step * displacement[v];
    shape_.update(moved_);
    set_.add_forces(shape_, forces);
  }

  const PotentialSet& set_;
  const Field& reference_;
  ShapeState shape_;
  Field moved_;
  double mean_edge_ = 0;
};

/// Adds to `displacement` what brings the components that `free` has (1 or 0) into balance with `load`: conjugate
/// gradients.
void relax(Hessian& hessian, const Field& free, const Field& load, Field& displacement) {
  constexpr double tolerance = 1e-9;
  const auto keep_free = [&](Field& field) {
    for (std::size_t v = 0; v < field.size(); ++v)
      field[v] = {field[v].x * free[v].x, field[v].y * free[v].y, field[v].z * free[v].z};
  };
  Field rest = hessian * displacement;
  const double all = product(rest, rest) + product(load, load);
  for (std::size_t v = 0; v < rest.size(); ++v) rest[v] = load[v] - rest[v];
  keep_free(rest);
  Field along = rest;
  double square = product(rest, rest);
  const double goal = tolerance * tolerance * all;
  const std::size_t most = 20 * rest.size() + 100;
  for (std::size_t n = 0; n < most && square > goal; ++n) {
    Field image = hessian * along;
    keep_free(image);
    const double step = square / product(along, image);
    for (std::size_t v = 0; v < rest.size(); ++v) {
      displacement[v] += step * along[v];
      rest[v] -= step * image[v];
    }
    const double before = square;
    square = product(rest, rest);
    for (std::size_t v = 0; v < rest.size(); ++v) along[v] = rest[v] + square / before * along[v];
  }
  if (square > goal)
    throw RunError("the balance of the sheet's vertices was not found: its stiffnesses differ by too much");
}

template <class... Wanted>
PotentialSet only(const PotentialSet& all) {
  PotentialSet set;
  for (const Potential& potential : all.potentials())
    if ((std::holds_alternative<Wanted>(potential) || ...)) set.add(potential);
  return set;
}

BodyConfig laid_out(const BodyConfig& body, const FlatPatch& patch) {
  BodyConfig flat = body;
  flat.potentials.volume.reset();
  flat.potentials.pressure.reset();
  flat.material.fibre = patch.fibre;
  return flat;
}

PotentialSet plane_potentials(const BodyConfig& body, const FlatPatch& patch) {
  return only<EdgeSprings, Membrane, FaceAreaPenalty>(
      make_potentials(laid_out(body, patch), patch.surface.mesh, patch.surface.positions));
}
PotentialSet bending_potentials(const BodyConfig& body, const FlatPatch& patch) {
  return only<Bending>(make_potentials(laid_out(body, patch), patch.surface.mesh, patch.surface.positions));
}

std::vector<char> border_of(const TriangleMesh& mesh) {
  std::vector<char> at_border(static_cast<std::size_t>(mesh.n_vertices()), 0);
  for (int e = 0; e < mesh.n_edges(); ++e)
    if (mesh.faces_of_edge()[e][1] < 0)
      for (int v : mesh.vertices_of_edge()[e]) at_border[v] = 1;
  return at_border;
}

std::vector<char> with_neighbours(const TriangleMesh& mesh, const std::vector<char>& given) {
  auto grown = given;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (given[v])
      for (int w : mesh.neighbours_of_vertex(v)) grown[w] = 1;
  return grown;
}

/// The quadratic form of three states, each given by its displacements; those that are not held find their balance.
SheetStiffness stiffness_of(const PotentialSet& set, const Surface& surface, const std::array<Field, 3>& states,
                            const Field& free, double area) {
  Hessian hessian(set, surface);
  std::array<Field, 3> relaxed = states, forces;
  const Field no_load(free.size());
  for (std::size_t i = 0; i < 3; ++i) {
    relax(hessian, free, no_load, relaxed[i]);
    forces[i] = hessian * relaxed[i];
  }
  const auto entry = [&](std::size_t i, std::size_t j) { return product(relaxed[i], forces[j]) / area; };
  return {entry(0, 0), entry(1, 1), entry(0, 1), entry(2, 2), entry(0, 2), entry(1, 2)};
}

struct Frame {
  Vec3 first, second, normal;
};
Frame frame_of(Vec3 normal, const std::optional<Vec3>& fibre) {
  Frame frame;
  frame.normal = normal;
  const auto in_plane = [&](Vec3 v) { return v - dot(v, normal) * normal; };
  Vec3 first = fibre ? in_plane(normalized(*fibre)) : Vec3{};
  if (norm(first) < 0.1) first = in_plane(std::abs(normal.x) < 0.8 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  frame.first = normalized(first);
  frame.second = cross(normal, frame.first);
  return frame;
}

std::vector<Vec3> vertex_normals(const Surface& surface) {
  std::vector<Vec3> normals(surface.positions.size());
  for (const Face& face : surface.mesh.vertices_of_face())
    for (int v : face) normals[v] += face_vector(face, surface.positions);
  for (Vec3& n : normals) n = normalized(n);
  return normals;
}

/// The faces between the vertices that are kept, with positions given by `at`.
template <class At>
Surface cut_out(const TriangleMesh& mesh, const std::vector<char>& kept, At at) {
  std::vector<int> number(kept.size(), -1);
  std::vector<Face> faces;
  Field positions;
  for (const Face& face : mesh.vertices_of_face()) {
    if (!kept[face[0]] || !kept[face[1]] || !kept[face[2]]) continue;
    Face renumbered{};
    for (std::size_t k = 0; k < 3; ++k) {
      int& n = number[face[k]];
      if (n < 0) {
        n = static_cast<int>(positions.size());
        positions.push_back(at(face[k]));
      }
      renumbered[k] = n;
    }
    faces.push_back(renumbered);
  }
  return {TriangleMesh(static_cast<int>(positions.size()), std::move(faces)), std::move(positions)};
}

bool is_flat(const Surface& surface, const std::vector<Vec3>& normals) {
  return std::all_of(normals.begin(), normals.end(), [&](Vec3 n) { return dot(n, normals[0]) > 1 - 1e-9; }) &&
         surface.mesh.n_border_edges() > 0;
}

/// Rings of vertices around one, as long as their normals are within 30 degrees and they do not touch a border.
struct Rings {
  std::vector<char> kept;
  int count = 0;
};
Rings grow(const TriangleMesh& mesh, const std::vector<Vec3>& normals, const std::vector<char>& at_border, int seed) {
  constexpr int most_rings = 14;
  const double least_cosine = std::cos(std::acos(-1.0) / 6);
  Rings rings;
  rings.kept.assign(normals.size(), 0);
  rings.kept[seed] = 1;
  while (rings.count < most_rings) {
    auto grown = with_neighbours(mesh, rings.kept);
    for (std::size_t v = 0; v < grown.size(); ++v)
      if (grown[v] && (at_border[v] || dot(normals[v], normals[seed]) < least_cosine)) return rings;
    rings.kept = std::move(grown);
    ++rings.count;
  }
  return rings;
}

}  // namespace

std::vector<FlatPatch> flat_patches(const BodyConfig& body, const Surface& surface) {
  const auto normals = vertex_normals(surface);
  const auto& fibre = body.material.fibre;
  const auto lay_out = [&](const std::vector<char>& kept, Vec3 origin, Vec3 normal, bool keep_distance) {
    const Frame frame = frame_of(normal, fibre);
    FlatPatch patch;
    patch.surface = cut_out(surface.mesh, kept, [&](int v) {
      const Vec3 from = surface.positions[v] - origin;
      const Vec3 flat{dot(from, frame.first), dot(from, frame.second), 0};
      return keep_distance && norm(flat) > 0 ? norm(from) / norm(flat) * flat : flat;
    });
    if (fibre) patch.fibre = Vec3{1, 0, 0};
    return patch;
  };
  if (is_flat(surface, normals))
    return {lay_out(std::vector<char>(normals.size(), 1), surface.positions[0], normals[0], false)};

  constexpr std::size_t most_patches = 6;
  constexpr int least_rings = 3;
  const auto at_border = border_of(surface.mesh);
  std::vector<FlatPatch> patches;
  int widest = 0;
  for (std::size_t k = 0; k < most_patches; ++k) {
    const auto seed = (2 * k + 1) * normals.size() / (2 * most_patches);
    const auto rings = grow(surface.mesh, normals, at_border, static_cast<int>(seed));
    widest = std::max(widest, rings.count);
    if (rings.count >= least_rings)
      patches.push_back(lay_out(rings.kept, surface.positions[seed], normals[seed], true));
  }
  if (patches.empty())
    throw InputError(fmt::format(
        "body.{}: the faces are too large for the curvature of the surface: {} rings of vertices lie within "
        "30 degrees of each other, where a nearly flat patch takes {}; refine the surface",
        body.name, widest, least_rings));
  return patches;
}

SheetStiffness plane_stiffness(const BodyConfig& body, const FlatPatch& patch) {
  const auto& surface = patch.surface;
  const auto held = border_of(surface.mesh);
  Field free(held.size());
  std::array<Field, 3> states;
  for (std::size_t v = 0; v < held.size(); ++v) {
    const Vec3 x = surface.positions[v];
    free[v] = held[v] ? Vec3{} : Vec3{1, 1, 0};
    states[0].push_back({x.x, 0, 0});
    states[1].push_back({0, x.y, 0});
    states[2].push_back({0.5 * x.y, 0.5 * x.x, 0});
  }
  return stiffness_of(plane_potentials(body, patch), surface, states, free,
                      total_area(surface.mesh, surface.positions));
}

SheetStiffness bending_stiffness(const BodyConfig& body, const FlatPatch& patch) {
  const auto& surface = patch.surface;
  const auto& mesh = surface.mesh;
  const auto held = with_neighbours(mesh, border_of(mesh));
  Field free(held.size());
  std::array<Field, 3> states;
  for (std::size_t v = 0; v < held.size(); ++v) {
    const Vec3 x = surface.positions[v];
    free[v] = held[v] ? Vec3{} : Vec3{0, 0, 1};
    states[0].push_back({0, 0, 0.5 * x.x * x.x});
    states[1].push_back({0, 0, 0.5 * x.y * x.y});
    states[2].push_back({0, 0, 0.5 * x.x * x.y});
  }
  // A face has a third of its area at each of its hinges; borders have none.
  const auto areas = face_areas(mesh, surface.positions);
  double area = 0;
  for (const auto& [first, second] : mesh.faces_of_edge())
    if (second >= 0) area += (areas[first] + areas[second]) / 3;
  return stiffness_of(bending_potentials(body, patch), surface, states, free, area);
}

std::optional<double> inflation_modulus(const BodyConfig& body, const Surface& surface) {
  if (!surface.mesh.is_closed()) return std::nullopt;
  const auto centroid = enclosed_moments(surface.mesh, surface.positions).centroid;
  const double radius = norm(surface.positions[0] - centroid);
  for (const Vec3& x : surface.positions)
    if (std::abs(norm(x - centroid) - radius) > 1e-3 * radius) return std::nullopt;

  BodyConfig shell = body;
  shell.potentials.volume.reset();
  const bool keeps_shape = !body.potentials.bending || body.potentials.bending->reference == ReferenceAngle::initial;
  const auto all = make_potentials(shell, surface.mesh, surface.positions);
  const auto set = keeps_shape ? only<EdgeSprings, Membrane, FaceAreaPenalty, Bending>(all)
                               : only<EdgeSprings, Membrane, FaceAreaPenalty>(all);
  Hessian hessian(set, surface);
  const Field free(surface.positions.size(), {1, 1, 1});
  Field load(free.size()), displacement(free.size());
  Pressure{1.0}.add_forces(ShapeState(surface.mesh, surface.positions), load);
  relax(hessian, free, load, displacement);
  const double volume = enclosed_volume(surface.mesh, surface.positions);
  const double size = 3 * volume / total_area(surface.mesh, surface.positions);
  const double strain = product(load, displacement) / (3 * volume);
  return size / (4 * strain);
}

SheetModuli asked_moduli(const BodyConfig& body) {
  const auto& given = body.potentials;
  const auto& material = body.material;
  SheetModuli asked;
  const auto set_plane = [&](double area, double shear) {
    area += given.area ? given.area->stiffness : 0;
    asked.area = area;
    asked.shear = shear;
    asked.young = 4 * area * shear / (area + shear);
    asked.poisson = (area - shear) / (area + shear);
  };
  const bool of_material = material.young && !given.edge && !given.membrane;
  if (of_material && material.young_across) {
    asked.young = *material.young * material.thickness;
    asked.young_across = *material.young_across * material.thickness;
  } else if (of_material) {
    const double wall = *material.young * material.thickness;
    set_plane(0.75 * wall, 0.375 * wall);
  } else if (given.edge || given.membrane) {
    double area = 0, shear = 0;
    if (given.edge) {
      const auto network = equilateral_moduli(given.edge->stiffness);
      area += network.area;
      shear += network.shear;
    }
    if (given.membrane) {
      const bool skalak = given.membrane->law == MembraneLaw::skalak;
      area += given.membrane->shear * (skalak ? 1 + 2 * given.membrane->ratio : 3.0);
      shear += given.membrane->shear;
    }
    set_plane(area, shear);
  }
  if (given.bending) asked.bending = 0.5 * std::sqrt(3.0) * given.bending->stiffness;
  else if (material.young) asked.bending = bending_modulus(*material.young, material.thickness, material.poisson);
  return asked;
}

MeasuredModuli find_moduli(const BodyConfig& body, const Surface& surface) {
  if (body.potentials.edge && body.potentials.edge->rest_length != 1)
    throw InputError(
        fmt::format("body.{}: its springs are {} times as long at rest as in the surface, and moduli are those about a "
                    "shape without stress; set potentials.edge.rest_length = 1",
                    body.name, body.potentials.edge->rest_length));
  MeasuredModuli found;
  found.asked = asked_moduli(body);
  const bool has_plane = found.asked.young.has_value(), has_bending = found.asked.bending.has_value();
  if (!has_plane && !has_bending)
    throw InputError(
        fmt::format("body.{} is no elastic sheet: give it young and thickness, or potentials.edge, potentials.membrane "
                    "or potentials.bending",
                    body.name));
  const auto patches = flat_patches(body, surface);
  const auto add = [&](SheetStiffness& sum, const SheetStiffness& one) {
    const double share = 1.0 / static_cast<double>(patches.size());
    sum.c11 += share * one.c11;
    sum.c22 += share * one.c22;
    sum.c12 += share * one.c12;
    sum.c66 += share * one.c66;
    sum.c16 += share * one.c16;
    sum.c26 += share * one.c26;
  };
  for (const auto& patch : patches) {
    if (has_plane) add(found.plane, plane_stiffness(body, patch));
    if (has_bending) add(found.bending, bending_stiffness(body, patch));
    found.n_vertices += patch.surface.mesh.n_vertices();
  }
  found.n_patches = static_cast<int>(patches.size());
  if (has_plane) found.inflation = inflation_modulus(body, surface);
  return found;
}

}  // namespace pliant
