#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <tuple>

#include "core/error.hpp"
#include "mesh/check_mesh.hpp"
#include "mesh/crossing.hpp"
#include "mesh/describe.hpp"
#include "mesh/geometry.hpp"
#include "mesh/shapes/channel.hpp"
#include "mesh/shapes/mechanical_leaflet.hpp"
#include "mesh/shapes/natural_valve.hpp"
#include "mesh/shapes/plate_with_holes.hpp"
#include "mesh/shapes/ventricle.hpp"

namespace pliant {
namespace {
constexpr double pi = std::numbers::pi;

std::vector<int> named(const Surface& surface, const std::string& name) {
  for (const auto& selection : surface.selections)
    if (selection.name == name) return selection.vertices;
  ADD_FAILURE() << "no selection " << name;
  return {};
}

/// Sound, with this Euler number, no angle below 35 degrees, and edges within a factor of two of what is asked.
void expect_good(const Surface& surface, int euler, double shortest, double longest) {
  SurfaceData data{"shape", surface.positions, {}, {}, {}};
  data.faces.assign(surface.mesh.vertices_of_face().begin(), surface.mesh.vertices_of_face().end());
  EXPECT_EQ(find_mesh_problems(data, Closure::open), std::vector<std::string>{});
  const auto report = describe(surface);
  EXPECT_EQ(report.n_components, 1);
  EXPECT_EQ(report.euler_characteristic, euler);
  EXPECT_GE(report.angle_min, 35);
  EXPECT_GE(report.edge_min, 0.5 * shortest);
  EXPECT_LE(report.edge_max, 2 * longest);
  EXPECT_FALSE(find_self_crossing({surface.mesh, surface.positions}, 1e-9));
  for (const auto& [name, vertices] : surface.selections) {
    EXPECT_FALSE(vertices.empty()) << name;
    EXPECT_TRUE(std::is_sorted(vertices.begin(), vertices.end())) << name;
  }
}

std::set<std::tuple<double, double, double>> places(const Surface& surface, const std::string& name, Vec3 shift = {}) {
  std::set<std::tuple<double, double, double>> result;
  for (int v : named(surface, name)) {
    const Vec3 x = surface.positions[v] + shift;
    result.insert({x.x, x.y, x.z});
  }
  return result;
}

double area_of(const Surface& s) { return total_area(s.mesh, s.positions); }

/// Half the edge, a quarter of the error; meshes of the two are unlike, so the ratio has some scatter.
void expect_second_order(const std::function<double(int)>& measured, double exact) {
  const double coarse = measured(1) - exact, fine = measured(2) - exact;
  EXPECT_GT(coarse / fine, 3.5);
  EXPECT_LT(coarse / fine, 4.5);
}

TEST(HeartShapes, AreSoundAndWellShaped) {
  for (const double edge : {0.03, 0.057, 0.1, 0.16}) {
    SCOPED_TRACE(edge);
    expect_good(make_ventricle({0.8, 1.7, edge, 0}), 1, edge, edge);
    expect_good(make_ventricle({0.8, 1.7, edge, 0.5 * edge}), 1, 0.5 * edge, edge);
    expect_good(make_plate_with_holes({{2.5, 2}, {{-0.5, 0, 0.5}, {0.65, 0.1, 0.35}}, edge, 0}), -1, edge, edge);
    expect_good(make_plate_with_holes({{2.5, 2}, {{-0.5, 0, 0.5}, {0.65, 0.1, 0.35}}, edge, 0.6 * edge}), -1,
                0.6 * edge, edge);
    expect_good(make_channel(0.5, 0.8, edge), 0, edge, edge);
    NaturalValveSizes natural;
    natural.edge = edge;
    expect_good(make_natural_valve(natural), 0, edge, edge);
    for (const auto leaflet : {LeafletsMade::anterior, LeafletsMade::posterior}) {
      natural.leaflet = leaflet;
      expect_good(make_natural_valve(natural), 1, edge, edge);
    }
    MechanicalLeafletSizes mechanical;
    mechanical.edge = std::min(edge, 0.1);  // the short part is a tenth of the diameter
    expect_good(make_mechanical_leaflet(mechanical), 1, mechanical.edge, mechanical.edge);
  }
}

TEST(HeartShapes, AreWellShapedHoweverLongOrFlat) {
  expect_good(make_ventricle({0.285, 3.67, 0.13, 0}), 1, 0.1, 0.13);
  expect_good(make_ventricle({2, 0.3, 0.1, 0}), 1, 0.1, 0.1);
  expect_good(make_ventricle({1, 1, 0.1, 0}), 1, 0.1, 0.1);  // half a sphere
}

TEST(HeartShapes, HaveAsManyFacesAsAsked) {
  // Equilateral faces of the edge asked for: area over sqrt(3) / 4 edge^2, here with the area of half a spheroid.
  const double a = 1.32, c = 3.52, e = std::sqrt(1 - a * a / (c * c)), edge = 0.06;
  const double area = pi * a * a * (1 + c / (a * e) * std::asin(e));
  const auto sack = make_ventricle({a, c, edge, 0});
  EXPECT_NEAR(sack.mesh.n_faces() / (area / (std::sqrt(0.1875) * edge * edge)), 1, 0.05);
  EXPECT_NEAR(describe(sack).edge_mean, edge, 0.03 * edge);
}

TEST(HeartShapes, AreTheSameBitForBitEachTime) {
  const auto first = make_ventricle({0.8, 1.7, 0.1, 0.05}), second = make_ventricle({0.8, 1.7, 0.1, 0.05});
  EXPECT_EQ(first.positions, second.positions);
  EXPECT_TRUE(std::equal(first.mesh.vertices_of_face().begin(), first.mesh.vertices_of_face().end(),
                         second.mesh.vertices_of_face().begin(), second.mesh.vertices_of_face().end()));
}

TEST(HeartShapes, BordersOfOneCircleAreTheSameBitForBit) {
  const double radius = 0.5, edge = 0.07;
  NaturalValveSizes natural;
  natural.edge = edge;
  const auto circle = places(make_natural_valve(natural), "annulus");
  EXPECT_EQ(circle.size(), 42u);  // 6 x 0.5 / 0.07
  EXPECT_EQ(places(make_channel(radius, 0.6, edge), "lower-rim"), circle);
  EXPECT_EQ(places(make_channel(radius, 0.5, edge), "upper-rim", {0, 0, -0.5}), circle);
  EXPECT_EQ(places(make_ventricle({radius, 2, edge, 0}), "rim"), circle);
  EXPECT_EQ(places(make_plate_with_holes({{2, 2}, {{0, 0, radius}}, 0.2, edge}), "hole-1"), circle);
  // A hole elsewhere against a channel that is moved there, as a body's center does.
  EXPECT_EQ(places(make_plate_with_holes({{3, 3}, {{-0.6, 0.3, radius}}, 0.2, edge}), "holes"),
            places(make_channel(radius, 0.6, edge), "lower-rim", {-0.6, 0.3, 0}));
}

TEST(HeartShapes, LieOnTheirSurfacesWithExactBorders) {
  const double a = 1.32, c = 3.52;
  const auto sack = make_ventricle({a, c, 0.15, 0});
  for (const Vec3 x : sack.positions) EXPECT_NEAR((x.x * x.x + x.y * x.y) / (a * a) + x.z * x.z / (c * c), 1, 1e-14);
  const auto rim = named(sack, "rim");
  EXPECT_EQ(static_cast<int>(rim.size()), sack.mesh.n_border_edges());
  for (int v : rim) EXPECT_EQ(sack.positions[v].z, 0);
  ASSERT_EQ(named(sack, "apex").size(), 1u);
  EXPECT_EQ(sack.positions[named(sack, "apex")[0]].z, -c);
  const auto normals = face_normals(sack.mesh, sack.positions);
  const auto centroids = face_centroids(sack.mesh, sack.positions);
  for (std::size_t f = 0; f < normals.size(); ++f) EXPECT_GT(dot(normals[f], centroids[f]), 0);

  const auto plate = make_plate_with_holes({{3, 2}, {{-0.6, 0.1, 0.5}, {0.7, 0, 0.35}}, 0.1, 0.05});
  std::set<double> left, right;
  for (int v : named(plate, "border")) {
    const Vec3 x = plate.positions[v];
    EXPECT_TRUE(std::abs(x.x) == 1.5 || std::abs(x.y) == 1);
    if (x.x == -1.5) left.insert(x.y);
    if (x.x == 1.5) right.insert(x.y);
  }
  EXPECT_EQ(left, right);
  EXPECT_EQ(left.size(), 21u);
  for (const Vec3 n : face_normals(plate.mesh, plate.positions)) EXPECT_NEAR(n.z, 1, 1e-15);
}

TEST(HeartShapes, AreasAndVolumesConvergeAtSecondOrder) {
  const double a = 1.0, c = 2.0, e = std::sqrt(1 - a * a / (c * c));
  const auto sack = [&](int n) { return make_ventricle({a, c, 0.16 / n, 0}); };
  expect_second_order([&](int n) { return area_of(sack(n)); }, pi * a * a * (1 + c / (a * e) * std::asin(e)));
  // The lid in the plane z = 0, which holds the origin, adds nothing.
  const auto volume = [&](int n) {
    const auto s = sack(n);
    double sum = 0;
    for (const Face& face : s.mesh.vertices_of_face())
      sum += dot(s.positions[face[0]], cross(s.positions[face[1]], s.positions[face[2]])) / 6;
    return sum;
  };
  expect_second_order(volume, 2 * pi / 3 * a * a * c);
  // A plate misses just what the polygon of its hole misses of the circle, however its faces lie.
  const auto plate = make_plate_with_holes({{2, 2}, {{0.1, 0, 0.5}}, 0.2, 0.05});
  EXPECT_NEAR(area_of(plate), 4 - 30 * 0.25 * std::sin(2 * pi / 60), 1e-13);
}

TEST(HeartShapes, MechanicalLeafletsKeepTheirClearanceAtAllAngles) {
  MechanicalLeafletSizes sizes;
  sizes.edge = 0.03;
  for (const double angle : {25.0, 40.0, 60.0, 85.0, 90.0}) {
    const auto valve = make_bileaflet_valve(sizes, angle);
    double widest = 0, nearest = 1;
    for (const Vec3 x : valve.positions) {
      widest = std::max(widest, std::hypot(x.x, x.y));
      nearest = std::min(nearest, std::abs(x.x));
    }
    EXPECT_LE(widest, 0.5 - 0.02 + 1e-14) << angle;
    EXPECT_GE(nearest, 0.01 - 1e-14) << angle;
    if (angle == 25.0) {
      // Closed: the arc lies on the circle seen along the channel, and the leaflets a clearance apart.
      for (const auto* name : {"left-arc", "right-arc"})
        for (int v : named(valve, name))
          EXPECT_NEAR(std::hypot(valve.positions[v].x, valve.positions[v].y), 0.48, 1e-12);
      EXPECT_NEAR(nearest, 0.01, 1e-14);
    }
    EXPECT_FALSE(find_self_crossing({valve.mesh, valve.positions}, 1e-9));
  }
  const auto leaflet = make_mechanical_leaflet(sizes);
  const auto axis = named(leaflet, "hinge-axis");
  ASSERT_EQ(axis.size(), 2u);
  for (int v : axis) EXPECT_EQ(leaflet.positions[v].x, 0);
  // The long part swings downstream, to z < 0, for a positive angle about (0, 1, 0).
  const auto open = make_bileaflet_valve(sizes, 85);
  for (int v : named(open, "right-arc")) EXPECT_LE(open.positions[v].z, 0);
}

TEST(HeartShapes, FreeEdgesOfANaturalValveHaveTheirLengthAndOpening) {
  NaturalValveSizes sizes;
  sizes.edge = 0.02;
  const auto length_of = [](const Surface& s, const std::string& name) {
    const auto chosen = named(s, name);
    const std::set<int> on(chosen.begin(), chosen.end());
    double sum = 0;
    for (std::size_t e = 0; e < s.mesh.vertices_of_edge().size(); ++e) {
      const auto [a, b] = s.mesh.vertices_of_edge()[e];
      if (s.mesh.faces_of_edge()[e][1] < 0 && on.contains(a) && on.contains(b))
        sum += norm(s.positions[b] - s.positions[a]);
    }
    return sum;
  };
  for (const double opening : {0.05, 0.2, 0.4}) {
    sizes.opening = opening;
    const auto valve = make_natural_valve(sizes);
    EXPECT_NEAR(length_of(valve, "anterior-edge"), 1.2, 0.001);
    EXPECT_NEAR(length_of(valve, "posterior-edge"), 1.2, 0.001);
    EXPECT_NEAR(length_of(valve, "free-edge"), 2.4, 0.002);
    EXPECT_NEAR(length_of(valve, "annulus"), pi, 0.002);
    const auto middle = [&](const std::string& name) {
      Vec3 best{0, 1, 0};
      for (int v : named(valve, name))
        if (std::abs(valve.positions[v].y) < std::abs(best.y)) best = valve.positions[v];
      return best;
    };
    EXPECT_NEAR(middle("anterior-edge").x - middle("posterior-edge").x, opening, 0.002);
    EXPECT_NEAR(norm(middle("posterior-edge") - Vec3{-0.5, 0, 0}), 0.5, 0.002);
    for (int v : named(valve, "commissure"))
      EXPECT_NEAR(std::atan2(std::abs(valve.positions[v].y), valve.positions[v].x), pi / 3, 1e-14);
  }
}

TEST(HeartShapes, SingleLeafletsShareTheCommissures) {
  NaturalValveSizes sizes;
  const auto both = make_natural_valve(sizes);
  sizes.leaflet = LeafletsMade::anterior;
  const auto anterior = make_natural_valve(sizes);
  sizes.leaflet = LeafletsMade::posterior;
  const auto posterior = make_natural_valve(sizes);
  EXPECT_EQ(places(anterior, "commissure"), places(posterior, "commissure"));
  EXPECT_EQ(places(both, "commissure"), places(posterior, "commissure"));
  EXPECT_EQ(anterior.mesh.n_faces() + posterior.mesh.n_faces(), both.mesh.n_faces());
}

TEST(HeartShapes, RefuseSizesThatFitNothing) {
  EXPECT_THROW(make_ventricle({-1, 2, 0.1, 0}), InputError);
  EXPECT_THROW(make_ventricle({1, 2, 1e-5, 0}), InputError);
  EXPECT_THROW(make_plate_with_holes({{2, 2}, {{0.8, 0, 0.5}}, 0.1, 0}), InputError);
  EXPECT_THROW(make_plate_with_holes({{2, 2}, {{0.3, 0, 0.4}, {-0.3, 0, 0.4}}, 0.1, 0}), InputError);
  MechanicalLeafletSizes mechanical;
  mechanical.hinge_offset = 0.6;
  EXPECT_THROW(make_mechanical_leaflet(mechanical), InputError);
  NaturalValveSizes natural;
  natural.edge = 0.3;  // longer than the commissures, 0.2
  EXPECT_THROW(make_natural_valve(natural), InputError);
  natural.edge = 0.05;
  natural.free_edge = 1.5;
  EXPECT_THROW(make_natural_valve(natural), InputError);
  natural.free_edge = 2.4;
  natural.opening = 2;
  EXPECT_THROW(make_natural_valve(natural), InputError);
  natural.opening = 0.2;
  natural.posterior_length = 3;
  EXPECT_THROW(make_natural_valve(natural), InputError);
}

}  // namespace
}  // namespace pliant
