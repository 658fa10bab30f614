#include "config/motion_keys.hpp"

namespace pliant {
namespace {
using BodyKey = Key<BodyConfig>;

BodyKey deformable(BodyKey key) {
  return only_when<BodyConfig>(std::move(key), "motion is \"deformable\"",
                               [](const BodyConfig& body) { return body.motion == MotionKind::deformable; });
}

/// A number of a potential that may be absent.
template <class Group, class Value>
BodyKey potential_key(KeyText text, std::optional<Group> PotentialsConfig::*group, Value Group::*value,
                      Limits limits = {}) {
  text.path = "potentials." + text.path;
  return deformable(make_key<BodyConfig>(
      std::move(text),
      [group, value](auto& body) {
        auto* found = member(body.potentials.*group);
        return found ? &(found->*value) : nullptr;
      },
      limits));
}

void add_material(std::vector<BodyKey>& keys) {
  const auto add = [&](BodyKey key) { keys.push_back(deformable(std::move(key))); };
  auto mass = make_key<BodyConfig>(
      {"mass_per_vertex", "mass",
       "of each vertex in Newton's law; default: its share of area times thickness times "
       "density; without a thickness 0 if it moves with the flow, 1 if by itself (one-way, loose, strong)"},
      [](auto& b) { return &b.mass_per_vertex; }, at_least(0));
  add(instead_of(std::move(mass), {"density"}));
  add(make_key<BodyConfig>(
      {"young", "pressure",
       "Young's modulus of the wall: gives each edge and hinge its stiffness, where potentials.edge, "
       "potentials.membrane and potentials.bending do not"},
      [](auto& b) { return &b.material.young; }, positive()));
  add(make_key<BodyConfig>(
      {"poisson", "", "Poisson's ratio of the wall in bending; in its plane a network of springs always has 1/3"},
      [](auto& b) { return &b.material.poisson; }, Limits{.min = -1, .min_bound = Bound::exclusive, .max = 0.5}));
  add(make_key<BodyConfig>({"fibre", "",
                            "direction along which edges have the stiffness of `young`; in the surface before "
                            "`rotation`, projected on it"},
                           [](auto& b) { return &b.material.fibre; }));
  add(make_key<BodyConfig>(
      {"young_across", "pressure",
       "Young's modulus across the fibre, a quarter of `young` to four times it; default: young"},
      [](auto& b) { return &b.material.young_across; }, positive()));
  add(make_key<BodyConfig>(
      {"damping", "mass / time", "force of -damping times the velocity of a vertex"},
      [](auto& b) { return &b.damping; }, at_least(0)));
  add(make_key<BodyConfig>(
      {"inner_damping", "mass / time", "force along each edge of -inner_damping times the rate at which it lengthens"},
      [](auto& b) { return &b.inner_damping; }, at_least(0)));
  add(make_key<BodyConfig>(
      {"substeps", "", "of the vertices within a fluid step; default: as many as stability asks for"},
      [](auto& b) { return &b.substeps; }, at_least(1)));
  add(make_key<BodyConfig>({"pinned", "", "selections whose vertices stay where they are"},
                           [](auto& b) { return &b.pinned; }));
  add(make_key<BodyConfig>(
      {"watch", "",
       "selections whose mean position and mean velocity the body's table has, as watch_NAME_x and "
       "watch_NAME_velocity_x, and so for y and z"},
      [](auto& b) { return &b.watch; }));
}

void add_potentials(std::vector<BodyKey>& keys) {
  using P = PotentialsConfig;
  const auto add = [&](BodyKey key) { keys.push_back(std::move(key)); };
  add(required(potential_key({"edge.stiffness", "force / length", "k_e of every edge's spring"}, &P::edge,
                             &EdgeConfig::stiffness, at_least(0))));
  add(potential_key({"edge.rest_length", "", "of the springs, as a fraction of the initial length"}, &P::edge,
                    &EdgeConfig::rest_length, at_least(0)));
  add(potential_key({"membrane.law", "",
                     "energy of a face's stretch from the initial shape: neo-Hookean (a thin incompressible sheet of "
                     "rubber), or Skalak's for cells"},
                    &P::membrane, &MembraneConfig::law));
  add(required(potential_key({"membrane.shear", "force / length", "G_s, the shear modulus of the surface"},
                             &P::membrane, &MembraneConfig::shear, at_least(0))));
  auto ratio = potential_key({"membrane.ratio", "", "C of Skalak's law: the area modulus is (1 + 2 C) G_s"},
                             &P::membrane, &MembraneConfig::ratio, at_least(0));
  add(only_when<BodyConfig>(std::move(ratio), "potentials.membrane.law is \"skalak\"", [](const BodyConfig& body) {
    const auto& membrane = body.potentials.membrane;
    return body.motion == MotionKind::deformable && membrane && membrane->law == MembraneLaw::skalak;
  }));
  add(required(potential_key({"bending.stiffness", "energy", "k_b of every hinge between two faces"}, &P::bending,
                             &BendingConfig::stiffness, at_least(0))));
  add(potential_key({"bending.reference", "", "the angle of zero energy: that of the initial shape, or flat"},
                    &P::bending, &BendingConfig::reference));
  add(required(potential_key({"volume.stiffness", "energy / volume", "k_v, holds the volume enclosed by the body"},
                             &P::volume, &VolumeConfig::stiffness, at_least(0))));
  add(required(potential_key({"pressure.value", "pressure",
                              "constant, inside over outside; on an open surface, which must be pinned, it pushes "
                              "along the normals"},
                             &P::pressure, &PressureConfig::value)));
  add(required(potential_key({"area.stiffness", "energy / area", "k_a, holds the area of each face"}, &P::area,
                             &AreaConfig::stiffness, at_least(0))));
  add(required(potential_key({"total_area.stiffness", "energy / area", "holds the area of the whole surface"},
                             &P::total_area, &AreaConfig::stiffness, at_least(0))));
  add(required(potential_key({"surface_tension.sigma", "energy / area", "tension of a liquid-liquid interface"},
                             &P::surface_tension, &SurfaceTensionConfig::sigma, at_least(0))));
  add(potential_key(
      {"surface_tension.mesh_control", "force / length",
       "stiffness of tangential springs between vertices, which keep the mesh even and, in two-way flow, resist "
       "stretching as surfactants do; 0: with force-spreading none, as the mesh is then kept even without "
       "forces, else sigma / sqrt(3)"},
      &P::surface_tension, &SurfaceTensionConfig::mesh_control, at_least(0)));
}

/// A name that has no default.
template <class Config, class Access>
Key<Config> name_key(KeyText text, Access access) {
  auto key = make_key<Config>(std::move(text), access);
  key.default_value = Json();
  key.legal = "the name of a selection";
  key.get = [access](const Config& config) { return access(config)->empty() ? Json() : Json(*access(config)); };
  return key;
}

/// A member of a shape that a selection may have.
template <class Group, class Value>
Key<SelectionConfig> shape_key(KeyText text, std::optional<Group> SelectionConfig::*group, Value Group::*value,
                               Limits limits = {}) {
  return make_key<SelectionConfig>(
      std::move(text),
      [group, value](auto& selection) {
        auto* found = member(selection.*group);
        return found ? &(found->*value) : nullptr;
      },
      limits);
}
}  // namespace

void add_structure_keys(std::vector<BodyKey>& keys) {
  add_material(keys);
  add_potentials(keys);
}

std::vector<Key<SelectionConfig>> selection_keys() {
  using S = SelectionConfig;
  std::vector<Key<S>> keys;
  const auto add = [&](Key<S> key) { keys.push_back(std::move(key)); };
  add(make_key<S>({"border", "", "true: vertices at a free border"}, [](auto& s) { return &s.border; }));
  add(make_key<S>({"border_near", "length", "vertices of the border that comes nearest to this point"},
                  [](auto& s) { return &s.border_near; }));
  add(required(shape_key({"sphere.center", "length", "vertices in a sphere"}, &S::sphere, &S::Sphere::center)));
  add(required(shape_key({"sphere.radius", "length", "of the sphere"}, &S::sphere, &S::Sphere::radius, positive())));
  add(required(shape_key({"box.lower", "length", "vertices in a box: its lower corner"}, &S::box, &S::Box::lower)));
  add(required(shape_key({"box.upper", "length", "its upper corner"}, &S::box, &S::Box::upper)));
  add(required(shape_key({"cylinder.point", "length", "vertices in an endless cylinder: a point of its axis"},
                         &S::cylinder, &S::Cylinder::point)));
  add(shape_key({"cylinder.axis", "", "direction of its axis"}, &S::cylinder, &S::Cylinder::axis));
  add(required(
      shape_key({"cylinder.radius", "length", "of the cylinder"}, &S::cylinder, &S::Cylinder::radius, positive())));
  add(required(
      shape_key({"plane.point", "length", "vertices by a plane: a point of it"}, &S::plane, &S::Plane::point)));
  add(shape_key({"plane.normal", "", "its normal"}, &S::plane, &S::Plane::normal));
  add(shape_key({"plane.side", "", "on: vertices on the plane; beyond: on it and on the side of its normal"}, &S::plane,
                &S::Plane::side));
  add(shape_key({"plane.tolerance", "length", "still on the plane; default: a hundredth of the mean edge"}, &S::plane,
                &S::Plane::tolerance, at_least(0)));
  add(shape_key({"extreme.direction", "", "the part of all vertices that lies farthest along this direction"},
                &S::extreme, &S::Extreme::direction));
  add(required(shape_key({"extreme.fraction", "", "how large a part; at least one vertex"}, &S::extreme,
                         &S::Extreme::fraction, Limits{.min = 0, .min_bound = Bound::exclusive, .max = 1})));
  return keys;
}

std::vector<Key<TetherConfig>> tether_keys() {
  std::vector<Key<TetherConfig>> keys;
  keys.push_back(required(name_key<TetherConfig>({"selection", "",
                                                  "whose vertices are held by springs at their places "
                                                  "at the start"},
                                                 [](auto& t) { return &t.selection; })));
  keys.push_back(required(make_key<TetherConfig>(
      {"stiffness", "force / length", "of each vertex"}, [](auto& t) { return &t.stiffness; }, at_least(0))));
  keys.push_back(make_key<TetherConfig>(
      {"damping", "mass / time", "force of -damping times the velocity of a vertex"},
      [](auto& t) { return &t.damping; }, at_least(0)));
  return keys;
}

std::vector<Key<CordConfig>> cord_keys() {
  std::vector<Key<CordConfig>> keys;
  const auto add = [&](Key<CordConfig> key) { keys.push_back(std::move(key)); };
  add(required(name_key<CordConfig>({"from", "", "where the cords begin"}, [](auto& c) { return &c.from; })));
  add(instead_of(name_key<CordConfig>({"to", "", "where they end"}, [](auto& c) { return &c.to; }), {"point"}));
  add(make_key<CordConfig>(
      {"point", "length",
       "where they end: a fixed point, in the coordinates of the surface before rotation and center"},
      [](auto& c) { return &c.point; }));
  add(make_key<CordConfig>({"ends", "",
                            "each: a cord from every vertex, to the point or to the nearest vertex of the other "
                            "selection; middle: one cord from the mean of the vertices to the point or the other mean"},
                           [](auto& c) { return &c.ends; }));
  add(required(make_key<CordConfig>(
      {"stiffness", "force / length", "of each cord when taut"}, [](auto& c) { return &c.stiffness; }, at_least(0))));
  add(instead_of(make_key<CordConfig>(
                     {"rest_length", "length", "up to which a cord is slack"}, [](auto& c) { return &c.rest_length; },
                     at_least(0)),
                 {"rest_fraction"}));
  auto fraction = make_key<CordConfig>(
      {"rest_fraction", "", "the same as a fraction of its length at the start"},
      [](auto& c) { return &c.rest_fraction; }, at_least(0));
  fraction.get = [](const CordConfig& c) { return c.rest_length ? Json() : Json(c.rest_fraction); };
  add(std::move(fraction));
  return keys;
}

std::vector<Key<PullConfig>> pull_keys() {
  std::vector<Key<PullConfig>> keys;
  keys.push_back(required(name_key<PullConfig>({"selection", "", "whose vertices share the force evenly"},
                                               [](auto& p) { return &p.selection; })));
  keys.push_back(required(make_key<PullConfig>(
      {"force", "force", "constant, of all vertices together; turned along with the surface by `rotation`"},
      [](auto& p) { return &p.force; })));
  return keys;
}

}  // namespace pliant
