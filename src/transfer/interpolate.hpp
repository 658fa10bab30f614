#pragma once
#include "field/field.hpp"
#include "transfer/markers.hpp"

namespace pliant {

/// U_l = sum_k phi_k u_k for the three components of a velocity, ghosts filled, at the markers of a block. A component
/// that another rank works on comes out as 0. `velocities` must have the markers' padded size.
void interpolate(const Markers& markers, const StencilBlock& block, ConstView<FaceX> u, ConstView<FaceY> v,
                 ConstView<FaceZ> w, MarkerVectors& velocities);
/// The same at all markers.
void interpolate(const Markers& markers, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w,
                 MarkerVectors& velocities);

/// Begins to load what the markers of a block will read of three fields, or add to them.
void prefetch(const StencilBlock& block, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w);

/// What a probe reads.
struct ProbedFields {
  ConstView<FaceX> u;
  ConstView<FaceY> v;
  ConstView<FaceZ> w;
  ConstView<Center> p;
};

/// Velocity, pressure and velocity gradient at the points of a batch.
struct ProbeBatch {
  double velocity[3][mls_batch];
  double pressure[mls_batch];
  double gradient[3][3][mls_batch];  ///< [i][j] = d u_i / d x_j
};

/// Pressure and gradients at the first `count` points of a batch; all nodes must be this rank's or its ghosts. Leaves
/// the velocity alone.
void probe(const ProbedFields& fields, const StencilBatch& stencils, const SlopeBatch& slopes, int count,
           ProbeBatch& result);
/// The velocity as well.
void probe_all(const ProbedFields& fields, const StencilBatch& stencils, const SlopeBatch& slopes, int count,
               ProbeBatch& result);

}  // namespace pliant
