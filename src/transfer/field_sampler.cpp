#include "transfer/field_sampler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"

namespace pliant {
namespace {

constexpr std::size_t n_numbers = 13;  // velocity, gradient, pressure

// Three neighbouring nodes of one direction with the weights of the value and of the derivative.
struct Stencil {
  int middle = 0;
  double value[3] = {};
  double slope[3] = {};
};

// Lagrange's parabola through the nodes a < b < c.
Stencil parabola(int middle, double a, double b, double c, double x) {
  Stencil s;
  s.middle = middle;
  const double ab = 1 / (a - b), ac = 1 / (a - c), bc = 1 / (b - c);
  s.value[0] = (x - b) * (x - c) * ab * ac;
  s.value[1] = -(x - a) * (x - c) * ab * bc;
  s.value[2] = (x - a) * (x - b) * ac * bc;
  s.slope[0] = (2 * x - b - c) * ab * ac;
  s.slope[1] = -(2 * x - a - c) * ab * bc;
  s.slope[2] = (2 * x - a - b) * ac * bc;
  return s;
}

enum class Nodes { centers, faces };

// The middle node must have a neighbour on either side: ghosts serve, but the one beyond a face on a bounded side holds
// nothing of the flow.
int last_middle(Nodes nodes, int n, bool periodic) {
  return nodes == Nodes::faces && !periodic ? std::max(0, n - 2) : n - 1;
}

// Uniform direction of n cells; x relative to its lower side, within [0, n h].
Stencil uniform_stencil(Nodes nodes, int n, double h, bool periodic, double x) {
  const double first = nodes == Nodes::faces ? h : 0.5 * h;  // place of node 0
  int middle = static_cast<int>(std::lround((x - first) / h));
  if (middle < 0 && periodic) {
    middle += n;
    x += n * h;
  }
  middle = std::clamp(middle, 0, last_middle(nodes, n, periodic));
  const double b = first + middle * h;
  return parabola(middle, b - h, b, b + h, x);
}

// z, in global planes; z within the box.
Stencil z_stencil(Nodes nodes, const Grid& grid, double z) {
  const int n = grid.cells()[2];
  const bool periodic = grid.is_periodic(2);
  const auto at = nodes == Nodes::faces ? grid.global_z_face() : grid.global_z_center();
  int middle = grid.plane_of_height(z);  // for centres the nearest, up to stretching, which costs nothing in order
  if (nodes == Nodes::faces && z < grid.global_z_center()[middle]) --middle;
  double shift = 0;
  if (middle < 0 && periodic) {
    middle += n;
    shift = grid.size().z;
  }
  middle = std::clamp(middle, 0, last_middle(nodes, n, periodic));
  return parabola(middle, at[middle - 1], at[middle], at[middle + 1], z + shift);
}

struct Value {
  double value = 0;
  Vec3 gradient;
};

template <class Location>
Value apply(ConstView<Location> f, const Stencil& x, const Stencil& y, const Stencil& z, int first_plane) {
  Value result;
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b < 3; ++b) {
      const double* row = f.at_row(y.middle + b - 1, z.middle - first_plane + c - 1) + x.middle - 1;
      const double value = x.value[0] * row[0] + x.value[1] * row[1] + x.value[2] * row[2];
      const double slope = x.slope[0] * row[0] + x.slope[1] * row[1] + x.slope[2] * row[2];
      const double yz = y.value[b] * z.value[c];
      result.value += value * yz;
      result.gradient.x += slope * yz;
      result.gradient.y += value * y.slope[b] * z.value[c];
      result.gradient.z += value * y.value[b] * z.slope[c];
    }
  return result;
}

void store(const Value& value, double* velocity, double* gradient) {
  *velocity = value.value;
  for (int d = 0; d < 3; ++d) gradient[d] = value.gradient[d];
}

}  // namespace

FieldSampler::FieldSampler(const Grid& grid, SampledFields fields, double density)
    : grid_(grid), fields_(fields), density_(density) {}

void FieldSampler::sample(std::span<const Vec3> points, std::span<FlowSample> samples) const {
  std::vector<double> numbers(n_numbers * points.size(), 0.0);
  const auto origin = grid_.origin(), size = grid_.size();
  const int first = grid_.slab().begin;
  const auto is_here = [&](const Stencil& z) { return z.middle >= first && z.middle < first + grid_.nz(); };

  for (std::size_t n = 0; n < points.size(); ++n) {
    Vec3 x = points[n] - origin;
    for (int d = 0; d < 3; ++d) {
      if (grid_.is_periodic(d)) x[d] -= size[d] * std::floor(x[d] / size[d]);
      // Written so that what is not a number fails as well.
      if (!(x[d] >= 0 && x[d] <= size[d]))
        throw CollectiveError(fmt::format("the flow was asked for at ({}, {}, {}), which is outside the box",
                                          points[n].x, points[n].y, points[n].z));
    }
    const auto z_center = z_stencil(Nodes::centers, grid_, origin.z + x.z);
    const auto z_face = z_stencil(Nodes::faces, grid_, origin.z + x.z);
    if (!is_here(z_center) && !is_here(z_face)) continue;
    const auto stencil_x = [&](Nodes nodes) {
      return uniform_stencil(nodes, grid_.nx(), grid_.dx(), grid_.is_periodic(0), x.x);
    };
    const auto stencil_y = [&](Nodes nodes) {
      return uniform_stencil(nodes, grid_.ny(), grid_.dy(), grid_.is_periodic(1), x.y);
    };
    const auto x_center = stencil_x(Nodes::centers), y_center = stencil_y(Nodes::centers);
    double* out = numbers.data() + n_numbers * n;
    if (is_here(z_center)) {
      store(apply(fields_.u->view(), stencil_x(Nodes::faces), y_center, z_center, first), out + 0, out + 3);
      store(apply(fields_.v->view(), x_center, stencil_y(Nodes::faces), z_center, first), out + 1, out + 6);
      out[12] = density_ * apply(fields_.p->view(), x_center, y_center, z_center, first).value;
    }
    if (is_here(z_face)) store(apply(fields_.w->view(), x_center, y_center, z_face, first), out + 2, out + 9);
  }

  if (!numbers.empty()) grid_.ranks().sum(numbers);
  for (std::size_t n = 0; n < points.size(); ++n) {
    const double* in = numbers.data() + n_numbers * n;
    samples[n].velocity = {in[0], in[1], in[2]};
    for (int i = 0; i < 3; ++i) samples[n].gradient[i] = {in[3 + 3 * i], in[4 + 3 * i], in[5 + 3 * i]};
    samples[n].pressure = in[12];
  }
}

}  // namespace pliant
