#pragma once
#include <cstring>

#include "core/prefetch.hpp"
#include "field/field.hpp"
#include "transfer/mls_shape.hpp"

namespace pliant {

/// The stencil lines that make up the support among the nodes of one staggered location.
template <class Location>
struct SupportLines {
  static constexpr StencilLine x = x_center, y = y_center, z = z_center;
};
template <>
struct SupportLines<FaceX> {
  static constexpr StencilLine x = x_face, y = y_center, z = z_center;
};
template <>
struct SupportLines<FaceY> {
  static constexpr StencilLine x = x_center, y = y_face, z = z_center;
};
template <>
struct SupportLines<FaceZ> {
  static constexpr StencilLine x = x_center, y = y_center, z = z_face;
};

namespace mls {

// A row of the support is read and written as four numbers, the last with weight zero: padding of the field's rows
// keeps it in memory.
using Row [[gnu::vector_size(4 * sizeof(double))]] = double;

// Factors of the rows (c in z, b in y) of a support: a node's phi is v_a * with_value + w_a * with_weight.
struct RowFactors {
  alignas(64) double with_value[3][3][mls_batch];
  alignas(64) double with_weight[3][3][mls_batch];
};

template <class Location>
inline void row_factors(const StencilBatch& s, RowFactors& f) {
  using Lines = SupportLines<Location>;
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b < 3; ++b)
      for (int l = 0; l < mls_batch; ++l) {
        const double wy = s.weight[Lines::y][b][l], wz = s.weight[Lines::z][c][l];
        const double vy = s.value[Lines::y][b][l], vz = s.value[Lines::z][c][l];
        f.with_value[c][b][l] = wy * wz;
        f.with_weight[c][b][l] = (vy - wy) * wz + wy * (vz - wz);
      }
}

template <class Location, class Value>
inline Value* lowest_node(View<Location, Value> f, const StencilBatch& s, int lane) {
  using Lines = SupportLines<Location>;
  return f.at_row(s.first[Lines::y][lane], s.first[Lines::z][lane]) + s.first[Lines::x][lane];
}

/// Begins to load the rows that the points of a batch will read or add to.
template <class Location>
inline void prefetch(ConstView<Location> f, const StencilBatch& s) {
  for (int l = 0; l < mls_batch; ++l) {
    const double* node = lowest_node(f, s, l);
    for (int c = 0; c < 3; ++c)
      for (int b = 0; b < 3; ++b) {
        pliant::prefetch(node + b * f.row + c * f.plane);
        pliant::prefetch(node + b * f.row + c * f.plane + 2);
      }
  }
}

/// Values of a field at the points of a batch.
template <class Location>
inline void interpolate(ConstView<Location> f, const StencilBatch& s, int count, double* values) {
  constexpr StencilLine line = SupportLines<Location>::x;
  RowFactors factors;
  row_factors<Location>(s, factors);
  for (int l = 0; l < count; ++l) {
    const double* node = lowest_node(f, s, l);
    Row with_value{}, with_weight{};
    for (int c = 0; c < 3; ++c)
      for (int b = 0; b < 3; ++b) {
        Row row;
        std::memcpy(&row, node + b * f.row + c * f.plane, sizeof(row));
        with_value += factors.with_value[c][b][l] * row;
        with_weight += factors.with_weight[c][b][l] * row;
      }
    double sum = 0;
    for (int a = 0; a < 3; ++a) sum += s.value[line][a][l] * with_value[a] + s.weight[line][a][l] * with_weight[a];
    values[l] = sum;
  }
}

/// Adds amount times phi of a point, lane l, to the nodes of a field.
template <class Location>
inline void spread_one(View<Location> f, const StencilBatch& s, const RowFactors& factors, int l, double amount) {
  constexpr StencilLine line = SupportLines<Location>::x;
  double* node = lowest_node(f, s, l);
  const Row value = {amount * s.value[line][0][l], amount * s.value[line][1][l], amount * s.value[line][2][l], 0};
  const Row weight = {amount * s.weight[line][0][l], amount * s.weight[line][1][l], amount * s.weight[line][2][l], 0};
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b < 3; ++b) {
      double* at = node + b * f.row + c * f.plane;
      Row row;
      std::memcpy(&row, at, sizeof(row));
      row += factors.with_value[c][b][l] * value + factors.with_weight[c][b][l] * weight;
      std::memcpy(at, &row, sizeof(row));
    }
}

/// Gradients of a field at the points of a batch: out[d][lane].
template <class Location>
inline void gradient(ConstView<Location> f, const StencilBatch& s, const SlopeBatch& slopes, int count,
                     double (*out)[mls_batch]) {
  using Lines = SupportLines<Location>;
  struct Factors {
    alignas(64) double x[3][3][mls_batch], y[3][3][mls_batch], z[3][3][mls_batch];
  } factors;
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b < 3; ++b)
      for (int l = 0; l < mls_batch; ++l) {
        const double wy = s.weight[Lines::y][b][l], wz = s.weight[Lines::z][c][l];
        factors.x[c][b][l] = wy * wz;
        factors.y[c][b][l] = slopes.slope[Lines::y][b][l] * wz;
        factors.z[c][b][l] = wy * slopes.slope[Lines::z][c][l];
      }
  for (int l = 0; l < count; ++l) {
    const double* node = lowest_node(f, s, l);
    Row x{}, y{}, z{};
    for (int c = 0; c < 3; ++c)
      for (int b = 0; b < 3; ++b) {
        Row row;
        std::memcpy(&row, node + b * f.row + c * f.plane, sizeof(row));
        x += factors.x[c][b][l] * row;
        y += factors.y[c][b][l] * row;
        z += factors.z[c][b][l] * row;
      }
    double gx = 0, gy = 0, gz = 0;
    for (int a = 0; a < 3; ++a) {
      gx += slopes.slope[Lines::x][a][l] * x[a];
      gy += s.weight[Lines::x][a][l] * y[a];
      gz += s.weight[Lines::x][a][l] * z[a];
    }
    out[0][l] = gx, out[1][l] = gy, out[2][l] = gz;
  }
}

}  // namespace mls
}  // namespace pliant
