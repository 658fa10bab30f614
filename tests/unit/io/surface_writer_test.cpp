#include "io/surface_writer.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "io/hdf5_file.hpp"
#include "temporary_folder.hpp"

namespace pliant {
namespace {

template <class T>
std::vector<T> read(const std::filesystem::path& path, const char* name, hid_t type) {
  Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  Hdf5Id set(H5Dopen2(file.get(), name, H5P_DEFAULT), H5Dclose);
  Hdf5Id space(H5Dget_space(set.get()), H5Sclose);
  std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
  EXPECT_GE(H5Dread(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  return values;
}

const std::vector<std::array<int, 3>> tetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

TEST(SurfaceWriter, StoresASurfaceAndListsIt) {
  TemporaryFolder folder;
  SurfaceWriter writer(folder.path(), "tet", tetrahedron, 4, Communicator());
  const std::vector<double> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 0.1, 0.2, 1.0 / 3};
  const std::vector<double> velocities{1, 2, 3, 4, 5, 6, 7, 8, 9, -1, -2, -3};
  const std::vector<double> pressures{1.5, 2.5, 3.5, 4.5};
  writer.write({{1},
                {{"positions", SurfaceCenter::vertex, 3, positions},
                 {"velocity", SurfaceCenter::vertex, 3, velocities},
                 {"pressure", SurfaceCenter::face, 1, pressures}}},
               {7, 0.7});

  const auto file = folder / "surfaces/tet_000007.h5";
  EXPECT_EQ(read<double>(file, "positions", H5T_NATIVE_DOUBLE), positions);
  EXPECT_EQ(read<double>(file, "velocity", H5T_NATIVE_DOUBLE), velocities);
  EXPECT_EQ(read<double>(file, "pressure", H5T_NATIVE_DOUBLE), pressures);
  EXPECT_EQ(read<int>(file, "triangles", H5T_NATIVE_INT), (std::vector<int>{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}));
  EXPECT_EQ(read<int>(file, "body", H5T_NATIVE_INT), (std::vector<int>{1, 1, 1, 1}));
  const auto series = text_of(folder / "tet.xdmf");
  EXPECT_NE(series.find("NumberOfElements=\"4\""), std::string::npos);
  EXPECT_NE(series.find("<Time Value=\"0.7\"/>"), std::string::npos);
  EXPECT_NE(series.find("surfaces/tet_000007.h5:/positions"), std::string::npos);
  EXPECT_NE(series.find("Name=\"velocity\" AttributeType=\"Vector\" Center=\"Node\""), std::string::npos);
  EXPECT_NE(series.find("Name=\"pressure\" AttributeType=\"Scalar\" Center=\"Cell\""), std::string::npos);
  EXPECT_EQ(series.find("force"), std::string::npos) << "no forces were given";
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".tmp"));
}

TEST(SurfaceWriter, PutsCopiesOneAfterTheOther) {
  TemporaryFolder folder;
  SurfaceWriter writer(folder.path(), "tet", tetrahedron, 4, Communicator());
  std::vector<double> positions;
  for (int n = 0; n < 24; ++n) positions.push_back(0.25 * n);
  writer.write({{5, 2}, {{"positions", SurfaceCenter::vertex, 3, positions}}}, {0, 0});
  const auto file = folder / "surfaces/tet_000000.h5";
  EXPECT_EQ(read<double>(file, "positions", H5T_NATIVE_DOUBLE), positions);
  EXPECT_EQ(read<int>(file, "body", H5T_NATIVE_INT), (std::vector<int>{5, 5, 5, 5, 2, 2, 2, 2}));
  EXPECT_EQ(read<int>(file, "triangles", H5T_NATIVE_INT),
            (std::vector<int>{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 4, 6, 5, 4, 5, 7, 5, 6, 7, 4, 7, 6}));
}

TEST(SurfaceWriter, NamesTheFileThatCannotBeWritten) {
  TemporaryFolder folder;
  std::ofstream(folder / "surfaces") << "in the way\n";
  SurfaceWriter writer(folder.path(), "tet", {{0, 2, 1}}, 3, Communicator());
  try {
    writer.write({{1}, {{"positions", SurfaceCenter::vertex, 3, std::vector<double>(9)}}}, {0, 0});
    FAIL() << "must throw";
  } catch (const RunError& error) { EXPECT_NE(std::string(error.what()).find("surfaces"), std::string::npos); }
}

}  // namespace
}  // namespace pliant
