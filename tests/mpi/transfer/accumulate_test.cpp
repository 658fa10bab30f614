#include <gtest/gtest.h>

#include "boundary/fill_ghosts.hpp"
#include "boundary/periodic_ghosts.hpp"
#include "unit/transfer/transfer_fixture.hpp"

// Ghosts brought home: with ones in all nodes and ghosts, a node ends with one for itself and one for each of its
// copies.
namespace pliant::test {
namespace {

// The number of times a node stands in the arrays: 2 for each direction in which it has a copy.
int expected(const Grid& grid, int i, int j, int global_k) {
  const auto n = grid.cells();
  const auto copies = [](int index, int size) { return (index == 0) + (index == size - 1); };
  const int in_x = grid.is_periodic(0) ? copies(i, n[0]) : 0;
  const int in_y = grid.is_periodic(1) ? copies(j, n[1]) : 0;
  int in_z = 0;
  const int k = global_k - grid.slab().begin;
  if (k == 0 && !grid.has_bottom()) ++in_z;
  if (k == grid.nz() - 1 && !grid.has_top()) ++in_z;
  return (1 + in_x) * (1 + in_y) * (1 + in_z);
}

template <class Location>
void check(const Grid& grid) {
  Field<Location> field(grid);
  const auto f = field.view();
  for (int k = -1; k <= grid.nz(); ++k)
    for (int j = -1; j <= grid.ny(); ++j)
      for (int i = -1; i <= grid.nx(); ++i) f(i, j, k) = 1;
  for (int k = -1; k <= grid.nz(); ++k) accumulate_periodic_ghosts(f, grid, k, {-1, grid.nx() + 1, -1, grid.ny() + 1});
  SlabHalo halo(grid.ranks(), grid.is_periodic(2) ? SlabHalo::Ends::periodic : SlabHalo::Ends::bounded, grid.nz());
  halo.accumulate({plane_stack(field)});
  for (int k = 0; k < grid.nz(); ++k)
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i)
        ASSERT_EQ(f(i, j, k), expected(grid, i, j, grid.slab().begin + k)) << i << ' ' << j << ' ' << k;
}

TEST(Accumulate, CountsCornersEdgesAndFaces) {
  for (int periodic = 0; periodic < 8; ++periodic) {
    BoundaryConfig sides = walls();
    for (std::size_t s = 0; s < 6; ++s)
      if (periodic >> (s / 2) & 1) sides[s] = PeriodicSide{};
    for (int nz : {4, 9}) {  // on four ranks also slabs of one plane, which have copies below and above
      BoxConfig box;
      box.cells = {5, 6, nz};
      check<Center>(Grid(box, sides, Communicator()));
      check<FaceZ>(Grid(box, sides, Communicator()));
    }
  }
  // Periodic in all directions on one rank: the box's corners are in eight places, its edges in four, its faces in two.
  BoxConfig box;
  box.cells = {5, 6, 7};
  const Grid alone(box, BoundaryConfig{}, Communicator(MPI_COMM_SELF));
  check<FaceX>(alone);
  EXPECT_EQ(expected(alone, 0, 5, 6), 8);
  EXPECT_EQ(expected(alone, 0, 5, 3), 4);
  EXPECT_EQ(expected(alone, 0, 3, 3), 2);
  EXPECT_EQ(expected(alone, 2, 3, 3), 1);
}

TEST(Accumulate, IsTheTransposeOfFilling) {
  // sum of a times fill(b) over all nodes and ghosts = sum of accumulate(a) times b over the nodes.
  BoxConfig box;
  box.cells = {5, 4, 8};
  const Grid grid(box, BoundaryConfig{}, Communicator());
  Field<FaceY> a(grid), b(grid);
  const auto value = [&](int i, int j, int k, int salt) {
    return std::sin(1.3 * i + 2.7 * j * j + 0.9 * k * salt + salt);
  };
  for (int k = -1; k <= grid.nz(); ++k)
    for (int j = -1; j <= grid.ny(); ++j)
      for (int i = -1; i <= grid.nx(); ++i) {
        const int global = grid.slab().begin + k;
        a.view()(i, j, k) = value(i, j, global, 1 + grid.ranks().rank());
        b.view()(i, j, k) = value(i, j, global, 9);
      }
  SlabHalo halo(grid.ranks(), SlabHalo::Ends::periodic, grid.nz());
  for (int k = 0; k < grid.nz(); ++k) fill_periodic_ghosts(b.view(), grid, k);
  halo.fill({plane_stack(b)});
  const auto product = [&](int ghosts) {
    double sum = 0;
    for (int k = -ghosts; k < grid.nz() + ghosts; ++k)
      for (int j = -ghosts; j < grid.ny() + ghosts; ++j)
        for (int i = -ghosts; i < grid.nx() + ghosts; ++i) sum += a.view()(i, j, k) * b.view()(i, j, k);
    return grid.ranks().sum(sum);
  };
  const double filled = product(1);
  for (int k = -1; k <= grid.nz(); ++k)
    accumulate_periodic_ghosts(a.view(), grid, k, {-1, grid.nx() + 1, -1, grid.ny() + 1});
  halo.accumulate({plane_stack(a)});
  EXPECT_NEAR(filled, product(0), 1e-12);
}

}  // namespace
}  // namespace pliant::test
