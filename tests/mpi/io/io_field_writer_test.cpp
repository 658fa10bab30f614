#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "core/error.hpp"
#include "io/field_writer.hpp"
#include "mpi/io/shared_folder.hpp"
#include "unit/io/text_of.hpp"

namespace pliant {
namespace {

namespace fs = std::filesystem;

// A folder of its own for a test, the same on all ranks.
std::vector<double> read(const fs::path& path, const char* name, std::vector<hsize_t>& shape) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
  const hid_t space = H5Dget_space(set);
  shape.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  H5Sclose(space);
  H5Dclose(set);
  H5Fclose(file);
  return values;
}

Grid test_grid(std::array<int, 3> cells) {
  BoxConfig box;
  box.size = {2, 3, 4};
  box.origin = {-1, -1, -1};
  box.cells = cells;
  box.stretching_z = {StretchingLaw::tanh, 1.0};
  BoundaryConfig boundary;
  boundary[4] = boundary[5] = WallSide{};
  return {box, boundary, Communicator()};
}

// u = x, v = 2y, w = 3z at the faces, ghosts included, and p = x + y + z at the centres.
FlowState linear_state(const Grid& grid) {
  FlowState state(grid);
  for (int k = -1; k <= grid.nz(); ++k)
    for (int j = -1; j <= grid.ny(); ++j)
      for (int i = -1; i <= grid.nx(); ++i) {
        state.u.view()(i, j, k) = grid.x_face(i);
        state.v.view()(i, j, k) = 2 * grid.y_face(j);
        state.w.view()(i, j, k) = 3 * grid.z_face()[k];
        state.p.view()(i, j, k) = grid.x_center(i) + grid.y_center(j) + grid.z_center()[k];
      }
  return state;
}

std::vector<CellQuantity> snapshot(const FlowState& state, const Grid& grid, double density) {
  return flow_quantities(state, density, std::make_shared<CenteredFlow>(grid, BoundaryConfig{}), false);
}

TEST(FieldWriter, StoresTheCentredFlowAtItsPlace) {
  const SharedFolder owner;
  const auto& folder = owner.path();
  const auto grid = test_grid({5, 4, 7});
  FieldWriter writer(folder, "fields", "fields", grid, Precision::full);
  const auto state = linear_state(grid);
  writer.write(snapshot(state, grid, 2.0), {0, 0.0});
  writer.write(snapshot(state, grid, 2.0), {12, 0.25});
  if (!grid.ranks().is_root()) return;

  const auto file = folder / "fields/fields_000012.h5";
  std::vector<hsize_t> shape;
  const auto z = read(file, "z", shape);
  ASSERT_EQ(z.size(), 8u);
  EXPECT_EQ(z.front(), -1);
  EXPECT_EQ(z.back(), 3);
  const auto velocity = read(file, "velocity", shape);
  ASSERT_EQ(shape, (std::vector<hsize_t>{7, 4, 5, 3}));
  const auto pressure = read(file, "pressure", shape);
  ASSERT_EQ(shape, (std::vector<hsize_t>{7, 4, 5}));
  for (int k = 0; k < 7; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 5; ++i) {
        const auto n = static_cast<std::size_t>((k * 4 + j) * 5 + i);
        const double zc = grid.global_z_center()[k];
        EXPECT_NEAR(velocity[3 * n], grid.x_center(i), 1e-14);
        EXPECT_NEAR(velocity[3 * n + 1], 2 * grid.y_center(j), 1e-14);
        EXPECT_NEAR(velocity[3 * n + 2], 3 * zc, 1e-14);
        EXPECT_NEAR(pressure[n], 2 * (grid.x_center(i) + grid.y_center(j) + zc), 1e-14);
      }
  const auto series = text_of(folder / "fields.xdmf");
  EXPECT_NE(series.find("<Time Value=\"0.25\"/>"), std::string::npos);
  EXPECT_NE(series.find("fields/fields_000012.h5:/velocity"), std::string::npos);
  for (const auto& entry : fs::recursive_directory_iterator(folder)) EXPECT_NE(entry.path().extension(), ".tmp");
}

TEST(FieldWriter, TellsAllRanksOfAFileThatCannotBeWritten) {
  const SharedFolder owner;
  const auto& folder = owner.path();
  const auto grid = test_grid({32, 32, 32});
  FieldWriter writer(folder, "fields", "fields", grid, Precision::full);
  const auto state = linear_state(grid);
  writer.write(snapshot(state, grid, 1.0), {0, 0.0});

  // A limit on the size of files behaves as a full disk does: some writes succeed, then one fails.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit tight = before;
  tight.rlim_cur = 400 * 1024;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &tight), 0);
  EXPECT_THROW(writer.write(snapshot(state, grid, 1.0), {1, 0.1}), CollectiveError);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);

  // What was there is whole, nothing half-written is left, and writing works again once there is space.
  if (grid.ranks().is_root()) {
    EXPECT_FALSE(fs::exists(folder / "fields/fields_000001.h5"));
    EXPECT_FALSE(fs::exists(folder / "fields/fields_000001.h5.tmp"));
    std::vector<hsize_t> shape;
    EXPECT_EQ(read(folder / "fields/fields_000000.h5", "pressure", shape).size(), 32u * 32 * 32);
    EXPECT_EQ(text_of(folder / "fields.xdmf").find("fields_000001"), std::string::npos);
  }
  writer.write(snapshot(state, grid, 1.0), {2, 0.2});
}

TEST(FieldWriter, NamesAFolderThatCannotBe) {
  const SharedFolder owner;
  const auto& folder = owner.path();
  if (Communicator().is_root()) std::ofstream(folder / "fields") << "a file where a folder should be\n";
  Communicator().barrier();
  const auto grid = test_grid({4, 4, 4});
  FieldWriter writer(folder, "fields", "fields", grid);
  try {
    const auto state = linear_state(grid);
    writer.write(snapshot(state, grid, 1.0), {0, 0.0});
    FAIL() << "must throw";
  } catch (const CollectiveError& error) { EXPECT_NE(std::string(error.what()).find("fields"), std::string::npos); }
}

}  // namespace
}  // namespace pliant
