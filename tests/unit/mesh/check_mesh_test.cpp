#include "mesh/check_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "mesh/shapes/icosphere.hpp"

namespace pliant {
namespace {

/// A sound sphere as read from a file: vertex v on line 10 + v, face f on line 1000 + f.
SurfaceData sphere_data() {
  const auto sphere = make_icosphere(2, 1.0);
  SurfaceData data;
  data.source = "s.gts";
  data.positions = sphere.positions;
  data.faces.assign(sphere.mesh.vertices_of_face().begin(), sphere.mesh.vertices_of_face().end());
  for (std::size_t v = 0; v < data.positions.size(); ++v) data.vertex_lines.push_back(10 + static_cast<long>(v));
  for (std::size_t f = 0; f < data.faces.size(); ++f) data.face_lines.push_back(1000 + static_cast<long>(f));
  return data;
}

/// The only problem found, which must begin with file and line.
std::string only_problem(const SurfaceData& data, Closure closure = Closure::closed) {
  const auto problems = find_mesh_problems(data, closure);
  EXPECT_EQ(problems.size(), 1u) << (problems.size() > 1 ? problems[1] : "");
  return problems.empty() ? "" : problems[0];
}

void expect_begins(const std::string& text, const std::string& start) {
  EXPECT_EQ(text.substr(0, start.size()), start);
}

TEST(CheckMesh, AcceptsASoundSphere) { EXPECT_TRUE(find_mesh_problems(sphere_data(), Closure::closed).empty()); }

TEST(CheckMesh, FindsAnIndexOutOfRange) {
  auto data = sphere_data();
  data.faces[7][1] = 42;
  expect_begins(only_problem(data), "s.gts:1007: the face names vertex 43, but there are 42 vertices");
}

TEST(CheckMesh, FindsDegenerateFaces) {
  auto data = sphere_data();
  data.faces[7][1] = data.faces[7][0];
  expect_begins(only_problem(data), "s.gts:1007: degenerate face: it names a vertex twice");

  data = {"f", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, {}, {5}};
  expect_begins(only_problem(data, Closure::any), "f:5: degenerate face: its three vertices lie on a line");
}

TEST(CheckMesh, FindsAHoleOnlyWhereTheBodyMustBeClosed) {
  auto data = sphere_data();
  data.faces.erase(data.faces.begin() + 7);
  const auto problems = find_mesh_problems(data, Closure::closed);
  ASSERT_EQ(problems.size(), 3u);
  for (const auto& problem : problems) EXPECT_NE(problem.find("hole"), std::string::npos);
  EXPECT_TRUE(find_mesh_problems(data, Closure::open).empty());
  EXPECT_TRUE(find_mesh_problems(data, Closure::any).empty());
  EXPECT_EQ(find_mesh_problems(sphere_data(), Closure::open).size(), 1u);
}

TEST(CheckMesh, NamesTheFlippedFaceNotItsNeighbours) {
  auto data = sphere_data();
  std::swap(data.faces[30][0], data.faces[30][1]);
  expect_begins(only_problem(data), "s.gts:1030: flipped face");
}

TEST(CheckMesh, FindsANonManifoldEdge) {
  auto data = sphere_data();
  data.positions.push_back({3, 0, 0});
  data.vertex_lines.push_back(99);
  data.faces.push_back({data.faces[0][0], data.faces[0][1], 42});
  data.face_lines.push_back(2000);
  const auto problems = find_mesh_problems(data, Closure::any);
  ASSERT_EQ(problems.size(), 1u);
  expect_begins(problems[0], "s.gts:2000: non-manifold edge");
}

TEST(CheckMesh, FindsDuplicates) {
  auto data = sphere_data();
  data.faces.push_back(data.faces[3]);
  data.face_lines.push_back(2000);
  const auto problems = find_mesh_problems(data, Closure::closed);
  ASSERT_FALSE(problems.empty());
  expect_begins(problems[0], "s.gts:2000: duplicate face: the face of line 1003");

  data = sphere_data();
  data.positions.push_back(data.positions[4]);
  data.vertex_lines.push_back(99);
  const auto vertex_problems = find_mesh_problems(data, Closure::closed);
  ASSERT_EQ(vertex_problems.size(), 2u);
  expect_begins(vertex_problems[0], "s.gts:99: unused vertex");
  expect_begins(vertex_problems[1], "s.gts:99: duplicate vertex: the vertex of line 14");
}

TEST(CheckMesh, FindsInwardNormalsAndBadNumbersAndNothing) {
  auto data = sphere_data();
  for (Face& face : data.faces) std::swap(face[0], face[1]);
  expect_begins(only_problem(data), "s.gts: inward normals");

  data = sphere_data();
  data.positions[5].y = std::nan("");
  expect_begins(only_problem(data), "s.gts:15: a coordinate is not a finite number");

  EXPECT_EQ(find_mesh_problems({"empty.gts", {}, {}, {}, {}}, Closure::any).size(), 1u);
}

TEST(CheckMesh, ListsEverythingUpToTheLimit) {
  auto data = sphere_data();
  for (int f = 0; f < 30; ++f) data.faces[f] = {0, 0, 0};
  const auto problems = find_mesh_problems(data, Closure::closed);
  ASSERT_EQ(problems.size(), 21u);
  EXPECT_EQ(problems.back(), "s.gts: and 10 more problems");
  EXPECT_THROW(make_surface(data, Closure::closed), InputError);
}

}  // namespace
}  // namespace pliant
