#include "mesh/formats/ply.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "core/error.hpp"
#include "mesh/check_mesh.hpp"
#include "mesh/geometry.hpp"
#include "mesh/read_surface.hpp"
#include "mesh/shapes/icosphere.hpp"

namespace pliant {
namespace {

constexpr PlyEncoding encodings[] = {PlyEncoding::ascii, PlyEncoding::binary_little_endian,
                                     PlyEncoding::binary_big_endian};

SurfaceData read(const std::string& bytes) {
  std::istringstream input(bytes);
  return read_ply(input, "s.ply");
}

std::string written(const Surface& surface, PlyEncoding encoding) {
  std::ostringstream output;
  write_ply(output, surface, encoding);
  return output.str();
}

/// What reading and checking says, all problems joined.
std::string error_of(const std::string& bytes) {
  try {
    make_surface(read(bytes), Closure::any);
  } catch (const InputError& error) { return error.what(); }
  return "no error";
}

void expect_error(const std::string& bytes, const std::string& part) {
  const std::string error = error_of(bytes);
  EXPECT_NE(error.find(part), std::string::npos) << "'" << part << "' is not in:\n" << error;
}

void expect_same(const Surface& a, const Surface& b) {
  EXPECT_TRUE(std::equal(a.positions.begin(), a.positions.end(), b.positions.begin(), b.positions.end()));
  const auto faces = a.mesh.vertices_of_face(), expected = b.mesh.vertices_of_face();
  EXPECT_TRUE(std::equal(faces.begin(), faces.end(), expected.begin(), expected.end()));
}

/// Appends the value in the byte order asked for.
template <class Value>
void append(std::string& bytes, Value value, std::endian order) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (order != std::endian::native) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof value);
}

std::string place(const char* kind, int number, std::size_t byte) {
  return "s.ply, " + std::string(kind) + " " + std::to_string(number) + " (byte " + std::to_string(byte) + "): ";
}

/// Lines 1 to 9 of a file of three vertices and one face.
const std::string header =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(Ply, EveryEncodingKeepsEveryBit) {
  const auto sphere = make_icosphere(3, 0.7);
  for (const PlyEncoding encoding : encodings) {
    SCOPED_TRACE(name_of(encoding));
    const std::string bytes = written(sphere, encoding);
    expect_same(make_surface(read(bytes), Closure::closed), sphere);
    // What is read writes the same file again.
    EXPECT_EQ(written(make_surface(read(bytes), Closure::closed), encoding), bytes);
  }
}

TEST(Ply, SurfaceFilesGoBothWays) {
  const auto sphere = make_icosphere(2, 1.3);
  const std::filesystem::path base = testing::TempDir() + "pliant_ply_test";
  const auto ply = base.string() + ".PLY", gts = base.string() + ".gts";
  write_surface(ply, sphere);
  write_surface(gts, read_surface(ply, Closure::closed));
  expect_same(read_surface(gts, Closure::closed), sphere);
  std::filesystem::remove(ply);
  std::filesystem::remove(gts);
}

TEST(Ply, BytesAreThoseOfTheFormat) {
  const auto big = written(make_icosphere(1, 1.0), PlyEncoding::binary_big_endian);
  const auto little = written(make_icosphere(1, 1.0), PlyEncoding::binary_little_endian);
  const std::size_t data = 12 * 24 + 20 * 13;
  const std::string end = "end_header\n";
  EXPECT_EQ(big.size(), big.find(end) + end.size() + data);
  EXPECT_EQ(little.size(), little.find(end) + end.size() + data);
  // The last index, 0 to 11, has its only set byte last or first.
  EXPECT_EQ(big[big.size() - 1], little[little.size() - 4]);
  EXPECT_EQ(big.substr(big.size() - 4, 3), std::string(3, '\0'));
}

TEST(Ply, OtherPropertiesElementsAndCommentsArePassedOver) {
  const auto data = read(
      "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nobj_info 3 4\r\nelement material 1\r\nproperty uchar red\r\n"
      "property list uchar float weights\r\nelement vertex 3\r\nproperty int z\r\nproperty uint8 quality\r\n"
      "property short y\r\nproperty list int8 int32 near\r\nproperty float64 x\r\nelement nothing 5\r\n"
      "element face 1\r\nproperty float area\r\nproperty list uint uint8 vertex_index\r\nproperty list uchar float "
      "uv\r\n"
      "element edge 1\r\nproperty int a\r\nend_header\r\n"
      "255 2 0.5 0.25\r\n-3 9 2 0 0.1\r\n0 9 0 3 7 8 9 1e-3\r\n\r\n1 9 1 1 5 -2\r\n0.5 3 2 0 1 1 0.5\r\n7\r\n");
  EXPECT_EQ(data.positions, (std::vector<Vec3>{{0.1, 2, -3}, {1e-3, 0, 0}, {-2, 1, 1}}));
  EXPECT_EQ(data.faces, (std::vector<Face>{{2, 0, 1}}));
  EXPECT_EQ(data.vertex_lines, (std::vector<long>{23, 24, 26}));
  EXPECT_EQ(data.face_lines, (std::vector<long>{27}));
}

TEST(Ply, BinaryTypesOfEverySizeAreRead) {
  for (const auto order : {std::endian::little, std::endian::big}) {
    const bool is_big = order == std::endian::big;
    std::string bytes =
        std::string("ply\nformat ") + (is_big ? "binary_big_endian" : "binary_little_endian") +
        " 1.0\nelement vertex 3\nproperty short x\nproperty uchar flag\nproperty list char double more\n"
        "property float y\nproperty uint z\nelement face 1\n"
        "property list ushort short vertex_index\nproperty int8 part\nend_header\n";
    for (int v = 0; v < 3; ++v) {
      append(bytes, static_cast<std::int16_t>(-300 * v), order);
      append(bytes, std::uint8_t{10}, order);  // a line end, which must not be taken for one
      append(bytes, static_cast<std::int8_t>(v), order);
      for (int k = 0; k < v; ++k) append(bytes, 1.5, order);
      append(bytes, 0.25f * static_cast<float>(v * v), order);
      append(bytes, std::uint32_t{4000000000u}, order);
    }
    append(bytes, std::uint16_t{3}, order);
    for (int k : {0, 2, 1}) append(bytes, static_cast<std::int16_t>(k), order);
    append(bytes, std::int8_t{-1}, order);
    const auto data = read(bytes);
    EXPECT_EQ(data.positions, (std::vector<Vec3>{{0, 0, 4e9}, {-300, 0.25, 4e9}, {-600, 1, 4e9}}));
    EXPECT_EQ(data.faces, (std::vector<Face>{{0, 2, 1}}));
    EXPECT_TRUE(data.vertex_lines.empty() && data.face_lines.empty());
  }
}

TEST(Ply, HeaderErrorsNameTheLine) {
  expect_error("", "s.ply: the file is empty");
  expect_error("solid a\n", "s.ply:1: 'solid a' is no first line");
  expect_error("ply\nformat ascii 1.0\nelement vertex 3\n", "s.ply:3: the file ends within the header");
  expect_error(replaced(header, "end_header\n", "") + vertices, "s.ply:9: '0 0 0' is no line of a PLY header");
  expect_error(replaced(header, "format ascii 1.0\n", "") + vertices, "s.ply:8: the header has no line 'format'");
  expect_error(replaced(header, "ascii 1.0", "ascii 2.0"), "s.ply:2: 'format ascii 2.0' is no known format");
  expect_error(replaced(header, "vertex 3", "vertex three"), "s.ply:3: 'element vertex three' is no element");
  expect_error(replaced(header, "vertex 3", "vertex -3"), "s.ply:3: ");
  expect_error(replaced(header, "float y", "real y"), "s.ply:5: 'property real y' is no property");
  expect_error(replaced(header, "float y", "float x"), "s.ply:5: the property 'x' is declared twice");
  expect_error(replaced(header, "property float y", "propetry float y"), "s.ply:5: 'propetry float y' is no line");
  expect_error(replaced(header, "property float z\n", ""), "s.ply:3: the element 'vertex' needs a number 'z'");
  expect_error(replaced(header, "float z", "list uchar float z"), "s.ply:3: the element 'vertex' needs a number 'z'");
  expect_error(replaced(header, "vertex_indices", "corners"), "s.ply:7: the element 'face' needs the property");
  expect_error(replaced(header, "uchar int", "uchar float"), "s.ply:7: the property 'vertex_indices' of the element");
  expect_error(replaced(header, "uchar int", "float int"), "s.ply:8: the count of a list cannot be float");
  expect_error(replaced(header, "element face 1", "element tristrips 1"), "the header has no element 'face'");
  expect_error(replaced(header, "element face 1", "element vertex 1"),
               "s.ply:7: the element 'vertex' is declared twice");
  // All at once, each once.
  const auto several = error_of(replaced(replaced(header, "float y", "real y"), "ascii", "text"));
  EXPECT_NE(several.find("s.ply:2: "), std::string::npos);
  EXPECT_NE(several.find("s.ply:5: "), std::string::npos);
  EXPECT_EQ(several.find("needs"), std::string::npos);
}

TEST(Ply, TextErrorsNameTheLine) {
  EXPECT_EQ(error_of(header + vertices + "3 0 1 2\n"), "no error");
  expect_error(header + "0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n", "s.ply:11: 'zero' is no float");
  expect_error(header + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "s.ply:11: '1 0' has too few values");
  expect_error(header + "0 0 0\n1 0 0\n3 0 1 2\n", "s.ply:12: '3 0 1 2' has 4 values, but by the header 3");
  expect_error(header + vertices, "s.ply:12: the file ends after 0 of 1 items 'face'");
  expect_error(header + vertices + "3 0 1 2\n3 0 2 1\n", "s.ply:14: a line is left over");
  expect_error(header + vertices + "4 0 1 2 0\n", "s.ply:13: the face has 4 vertices; it needs three");
  expect_error(header + vertices + "2 0 1\n", "s.ply:13: the face has 2 vertices");
  expect_error(header + vertices + "3 0 1\n", "s.ply:13: '3 0 1' has too few values");
  expect_error(header + vertices + "3 0 1 2.5\n", "s.ply:13: '2.5' is no int");
  expect_error(header + vertices + "300 0 1 2\n", "s.ply:13: '300' is no uchar");
  expect_error(header + vertices + "3 0 1 3\n",
               "s.ply:13: the face names vertex 3, but there are 3 vertices, counted from 0");
  expect_error(header + vertices + "3 0 1 -1\n", "s.ply:13: the face names vertex -1,");
  expect_error(replaced(header, "uchar int", "uchar uint") + vertices + "3 0 1 4294967295\n",
               "s.ply:13: the face names vertex 4294967295, more than any surface has");
  expect_error(replaced(header, "uchar int", "char int") + vertices + "-3 0 1 2\n",
               "s.ply:13: the list 'vertex_indices' has the count -3");
  expect_error(header + "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", "s.ply:11: a coordinate is not a finite number");
  std::string many = replaced(header, "vertex 3", "vertex 100");
  for (int i = 0; i < 100; ++i) many += "x y z\n";
  expect_error(many + "3 0 1 2\n", "s.ply: and 80 more problems");
}

TEST(Ply, BinaryErrorsNameItemAndByte) {
  const auto sphere = make_icosphere(1, 1.0);
  for (const PlyEncoding encoding : {PlyEncoding::binary_little_endian, PlyEncoding::binary_big_endian}) {
    const std::string good = written(sphere, encoding);
    const std::size_t data = good.find("end_header\n") + 11, faces = data + 12 * 24;
    expect_error(good.substr(0, data + 30), place("vertex", 1, data + 24) + "the file ends within it");
    expect_error(good.substr(0, faces), place("face", 0, faces) + "the file ends after 0 of 20 items 'face'");
    expect_error(good.substr(0, good.size() - 1), place("face", 19, good.size() - 13) + "the file ends within it");
    expect_error(good + "xy", "s.ply, byte " + std::to_string(good.size()) + ": 2 bytes are left over");
    std::string polygon = good;
    polygon[faces + 13] = 4;
    expect_error(polygon, place("face", 1, faces + 13) + "the face has 4 vertices");
    std::string beyond = good;
    beyond[faces + (encoding == PlyEncoding::binary_big_endian ? 4 : 1)] = 12;
    expect_error(beyond, "s.ply, face 0: the face names vertex 12, but there are 12 vertices, counted from 0");
  }
  expect_error(replaced(written(sphere, PlyEncoding::binary_little_endian), "vertex 12", "vertex 99999999"), "s.ply, ");
}

}  // namespace
}  // namespace pliant
