#include "structure/select_vertices.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "mesh/shapes/cylinder.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "mesh/shapes/plate.hpp"

namespace pliant {
namespace {

/// The vertices for which `holds` does.
template <class Holds>
std::vector<int> vertices_where(const Surface& surface, Holds holds) {
  std::vector<int> vertices;
  for (int v = 0; v < surface.mesh.n_vertices(); ++v)
    if (holds(surface.positions[v])) vertices.push_back(v);
  return vertices;
}
std::vector<int> select(const SelectionConfig& selection, const Surface& surface) {
  return select_vertices(selection, surface.mesh, surface.positions);
}

TEST(SelectVertices, InShapes) {
  const auto sphere = make_icosphere(6, 1.0);
  SelectionConfig ball, box, rod;
  ball.sphere = {{0, 0, 1}, 0.5};
  EXPECT_EQ(select(ball, sphere), vertices_where(sphere, [](Vec3 x) { return norm(x - Vec3{0, 0, 1}) <= 0.5; }));
  box.box = {{-2, -2, -0.3}, {0, 2, 0.3}};
  EXPECT_EQ(select(box, sphere), vertices_where(sphere, [](Vec3 x) { return std::abs(x.z) <= 0.3 && x.x <= 0; }));
  rod.cylinder = {{0.1, 0, 7}, {0, 0, -3}, 0.4};
  EXPECT_EQ(select(rod, sphere),
            vertices_where(sphere, [](Vec3 x) { return std::hypot(x.x - 0.1, x.y) <= 0.4; }));  // both caps
  rod.box = {{-1, -1, 0}, {1, 1, 1}};
  EXPECT_EQ(select(rod, sphere),
            vertices_where(sphere, [](Vec3 x) { return std::hypot(x.x - 0.1, x.y) <= 0.4 && x.z >= 0; }));
}

TEST(SelectVertices, ByAPlane) {
  const auto plate = make_plate(2, 1, 0.1);
  SelectionConfig edge;
  edge.plane = {{-1, 0, 0}, {2, 0, 0}, PlaneSide::on, {}};
  const auto on = vertices_where(plate, [](Vec3 x) { return x.x < -1 + 1e-9; });
  EXPECT_GE(on.size(), 10u);
  EXPECT_EQ(select(edge, plate), on);
  edge.plane = {{0.5, 0, 0}, {1, 0, 0}, PlaneSide::beyond, 0.0};
  EXPECT_EQ(select(edge, plate), vertices_where(plate, [](Vec3 x) { return x.x >= 0.5; }));
  edge.plane->tolerance = 0.3;
  EXPECT_EQ(select(edge, plate), vertices_where(plate, [](Vec3 x) { return x.x >= 0.2; }));
}

TEST(SelectVertices, AtBorders) {
  const auto tube = make_cylinder(0.5, 2.0, 0.2, Ends::open);
  SelectionConfig border;
  border.border = true;
  const auto all = vertices_where(tube, [](Vec3 x) { return std::abs(x.z) > 1 - 1e-9; });
  EXPECT_EQ(select(border, tube), all);
  border.border = false;
  border.border_near = Vec3{0.2, 0.1, 5};
  EXPECT_EQ(select(border, tube), vertices_where(tube, [](Vec3 x) { return x.z > 1 - 1e-9; }));
}

TEST(SelectVertices, FarthestAlongADirection) {
  const auto sphere = make_icosphere(5, 1.0);  // 252 vertices
  SelectionConfig end;
  end.extreme = {{1, 0.3, 0.2}, 0.02};
  const auto found = select(end, sphere);
  ASSERT_EQ(found.size(), 5u);
  double least = 2;
  for (int v : found) least = std::min(least, dot(sphere.positions[v], end.extreme->direction));
  EXPECT_EQ(vertices_where(sphere, [&](Vec3 x) { return dot(x, end.extreme->direction) >= least; }), found);
}

TEST(SelectVertices, TakesThoseOfTheSurfaceUnlessTheCaseHasOne) {
  const auto sphere = make_icosphere(2, 1.0);
  const std::vector<NamedVertices> brought{{"rim", {3, 5}}, {"top", {1}}};
  BodyConfig body;
  const auto found = [&](const std::string& name) {
    return select_vertices(body, name, sphere.mesh, sphere.positions, brought);
  };
  EXPECT_EQ(found("rim"), (std::vector<int>{3, 5}));
  body.selections.resize(1);
  body.selections[0].name = "rim";
  body.selections[0].sphere = {{0, 0, 1}, 0.1};
  EXPECT_EQ(found("rim"), (std::vector<int>{0}));
  EXPECT_EQ(found("top"), (std::vector<int>{1}));
  try {
    found("middle");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("its surface brings rim, top"), std::string::npos);
  }
}

TEST(SelectVertices, RefusesEmptyOnesByName) {
  const auto sphere = make_icosphere(2, 1.0);
  BodyConfig body;
  body.name = "cell";
  body.selections.resize(1);
  body.selections[0].name = "far";
  body.selections[0].sphere = {{5, 0, 0}, 1};
  const auto message_of = [&](const std::string& name) {
    try {
      select_vertices(body, name, sphere.mesh, sphere.positions);
    } catch (const InputError& error) { return std::string(error.what()); }
    return std::string();
  };
  EXPECT_NE(message_of("far").find("body.cell.selection.far holds no vertex"), std::string::npos);
  EXPECT_NE(message_of("near").find("no selection named near"), std::string::npos);
}

}  // namespace
}  // namespace pliant
