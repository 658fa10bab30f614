#pragma once
#include "transfer/force_fields.hpp"
#include "transfer/markers.hpp"

namespace pliant {

/// f_k += c_l phi_k F_l for the markers of a block, in their order: the fluid's acceleration from that of the
/// markers, `forces` of the markers' padded size. The sum of f dV over the nodes is the sum of A h F over the markers.
/// What goes to ghosts is brought home by ForceFields::gather; what falls on a bounded side's own face, the side takes.
void spread(const Markers& markers, const StencilBlock& block, const MarkerVectors& forces, ForceFields& fields);
/// The same for all markers.
void spread(const Markers& markers, const MarkerVectors& forces, ForceFields& fields);

}  // namespace pliant
