#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "mesh/formats/gts.hpp"
#include "mesh/formats/obj.hpp"
#include "mesh/formats/stl.hpp"
#include "mesh/geometry.hpp"
#include "mesh/read_surface.hpp"
#include "mesh/shapes/icosphere.hpp"

namespace pliant {
namespace {

/// A folder that goes away with the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "pliant-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const char* name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

TEST(Formats, GtsAndObjKeepEveryBit) {
  const Folder folder;
  const auto sphere = make_icosphere(3, 0.7);
  for (const char* name : {"a.gts", "a.obj", "A.OBJ"}) {
    write_surface(folder / name, sphere);
    const auto back = read_surface(folder / name, Closure::closed);
    EXPECT_TRUE(
        std::equal(back.positions.begin(), back.positions.end(), sphere.positions.begin(), sphere.positions.end()));
    const auto faces = back.mesh.vertices_of_face(), expected = sphere.mesh.vertices_of_face();
    EXPECT_TRUE(std::equal(faces.begin(), faces.end(), expected.begin(), expected.end()));
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_NE(entry.path().extension(), ".tmp");
}

TEST(Formats, StlWeldsItsCorners) {
  const Folder folder;
  const auto sphere = make_icosphere(2, 1.0);
  write_surface(folder / "a.stl", sphere);
  const auto back = read_surface(folder / "a.stl", Closure::closed);
  EXPECT_EQ(back.mesh.n_vertices(), sphere.mesh.n_vertices());
  EXPECT_EQ(enclosed_volume(back.mesh, back.positions), enclosed_volume(sphere.mesh, sphere.positions));
}

TEST(Formats, BinaryStlIsRead) {
  const auto sphere = make_icosphere(2, 1.0);
  std::string bytes(80, ' ');
  bytes.replace(0, 5, "solid");  // misleading on purpose
  const auto count = static_cast<std::uint32_t>(sphere.mesh.n_faces());
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (const Face& face : sphere.mesh.vertices_of_face()) {
    float values[12] = {};
    for (int k = 0; k < 3; ++k)
      for (int d = 0; d < 3; ++d) values[3 + 3 * k + d] = static_cast<float>(sphere.positions[face[k]][d]);
    bytes.append(reinterpret_cast<const char*>(values), 48).append(2, '\0');
  }
  std::istringstream input(bytes);
  const auto back = make_surface(read_stl(input, "b.stl"), Closure::closed);
  EXPECT_EQ(back.mesh.n_vertices(), sphere.mesh.n_vertices());
  EXPECT_NEAR(total_area(back.mesh, back.positions), total_area(sphere.mesh, sphere.positions), 1e-5);
}

TEST(Formats, GtsSkipsCommentsAndKeepsOrientation) {
  std::istringstream input(
      "# a tetrahedron\n4 6 4 GtsSurface GtsFace GtsEdge GtsVertex\n0 0 0\n1 0 0\n! half way\n0 1 0\n\n0 0 1\n"
      "1 2\n1 3\n1 4\n2 3\n2 4\n3 4\n2 4 1\n1 5 3\n3 6 2\n4 6 5\n");
  const auto data = read_gts(input, "t.gts");
  EXPECT_EQ(data.vertex_lines, (std::vector<long>{3, 4, 6, 8}));
  EXPECT_EQ(data.face_lines.front(), 15);
  const auto surface = make_surface(data, Closure::closed);
  EXPECT_NEAR(enclosed_volume(surface.mesh, surface.positions), 1.0 / 6.0, 1e-15);
}

std::string gts_error(const std::string& text) {
  std::istringstream input(text);
  try {
    read_gts(input, "bad.gts");
  } catch (const InputError& error) { return error.what(); }
  return "no error";
}

TEST(Formats, GtsKeepsSelectionsInComments) {
  auto sphere = make_icosphere(3, 1.0);
  sphere.selections = {{"rim", {}}, {"apex", {4}}};
  for (int v = 0; v < 90; v += 2) sphere.selections[0].vertices.push_back(v);
  std::stringstream stream;
  write_gts(stream, sphere);
  const auto text = stream.str();
  EXPECT_NE(text.find("\n# selection apex 5\n"), std::string::npos);
  const auto back = make_surface(read_gts(stream, "a.gts"), Closure::closed);
  ASSERT_EQ(back.selections.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.selections[i].name, sphere.selections[i].name);
    EXPECT_EQ(back.selections[i].vertices, sphere.selections[i].vertices);
  }
  EXPECT_EQ(back.positions, sphere.positions);
  // Words after "selection" that are no numbers make it a comment like any other; numbers must be those of vertices.
  std::istringstream talk(text + "# selection made by hand\n! selection rim 1\n# selection\n");
  EXPECT_EQ(read_gts(talk, "a.gts").selections.size(), 2u);
  std::istringstream wrong(text + "# selection apex 2 93\n");
  try {
    read_gts(wrong, "a.gts");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the selection 'apex' names vertex 93, out of range: there are 92"),
              std::string::npos);
  }
}

TEST(Formats, GtsErrorsNameTheLine) {
  EXPECT_NE(gts_error("").find("bad.gts: the file is empty"), std::string::npos);
  EXPECT_NE(gts_error("# only this\n").find("is empty"), std::string::npos);
  EXPECT_NE(gts_error(std::string("\x7f"
                                  "ELF\x02\x01\0\0garbage",
                                  16))
                .find("bad.gts:1: "),
            std::string::npos);
  EXPECT_NE(gts_error("3 3\n").find("bad.gts:1: '3 3' is no GTS header"), std::string::npos);
  EXPECT_NE(gts_error("-3 3 1\n").find("bad.gts:1: "), std::string::npos);
  EXPECT_NE(gts_error("3 3 1\n0 0 0\n1 0\n0 1 0\n1 2\n2 3\n3 1\n1 2 3\n").find("bad.gts:3: '1 0' is no vertex"),
            std::string::npos);
  EXPECT_NE(gts_error("3 3 1\n0 0 0\n1 0 0\n0 1 0\n1 2\n2 4\n3 1\n1 2 3\n").find("bad.gts:6: the edge names vertex 4"),
            std::string::npos);
  EXPECT_NE(gts_error("3 3 1\n0 0 0\n1 0 0\n0 1 0\n1 2\n2 3\n3 1\n1 2 0\n").find("bad.gts:8: the face names edge 0"),
            std::string::npos);
  EXPECT_NE(gts_error("3 3 1\n0 0 0\n1 0 0\n0 1 0\n1 2\n2 3\n3 1\n1 2 2\n").find("bad.gts:8: degenerate face"),
            std::string::npos);
  EXPECT_NE(gts_error("3 3 1\n0 0 0\n1 0 0\n0 1 0\n1 2\n").find("the file ends after 1 of 3 edge lines"),
            std::string::npos);
  EXPECT_NE(
      gts_error("3 3 1\n0 0 0\n1 0 0\n0 1 0\n1 2\n2 3\n3 1\n1 2 3\n1 2 3\n").find("bad.gts:9: a line is left over"),
      std::string::npos);
}

TEST(Formats, ManyErrorsAreCountedNotListed) {
  std::string text = "100 0 0\n";
  for (int i = 0; i < 100; ++i) text += "x y z\n";
  EXPECT_NE(gts_error(text).find("and 80 more problems"), std::string::npos);
}

TEST(Formats, ObjAndStlErrorsNameTheLine) {
  std::istringstream obj("v 0 0 0\nv 1 0 0\nv 0 1 zero\nf 1 2\n"),
      stl("solid a\nfacet normal 0 0 1\nvertex 0 0 0\nendfacet\n");
  try {
    read_obj(obj, "a.obj");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 2u);
    EXPECT_EQ(error.problems()[0].find("a.obj:3:"), 0u);
    EXPECT_EQ(error.problems()[1].find("a.obj:4:"), 0u);
  }
  try {
    read_stl(stl, "a.stl");
    FAIL();
  } catch (const InputError& error) { EXPECT_EQ(error.problems()[0].find("a.stl:2:"), 0u); }
}

TEST(Formats, PathsThatCannotBeReadOrWrittenAreNamed) {
  EXPECT_THROW(read_surface("no/such.gts"), InputError);
  EXPECT_THROW(read_surface("surface.xyz"), InputError);
  EXPECT_THROW(write_surface("/dev/null/a.gts", make_icosphere(1, 1.0)), RunError);
}

}  // namespace
}  // namespace pliant
