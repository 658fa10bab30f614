#pragma once
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "grid/grid.hpp"
#include "core/body_blob.hpp"
#include "io/surface_writer.hpp"
#include "structure/deformable_body.hpp"
#include "transfer/flow_sample.hpp"

namespace pliant {

/// The bodies of a run. For now every rank holds all of them and moves them alike: the flow samples are the same bits
/// on all ranks, so no exchange is needed.
class Bodies {
 public:
  /// Reads the meshes and sets up the potentials. Throws InputError with the problems of all bodies.
  Bodies(const CaseConfig& config, const Grid& grid);

  std::size_t size() const { return bodies_.size(); }
  const std::vector<DeformableBody>& all() const { return bodies_; }

  /// The state of the bodies that this rank answers for; all ranks together give each body once.
  std::vector<BodyBlob> save() const;
  /// Takes back what `save` gave, whichever rank is handed a body. Collective. Throws InputError, on all ranks, if the
  /// bytes are not of these bodies.
  void restore(std::vector<BodyBlob> blobs);

  /// Moves every body over a fluid step. Collective. Throws RunError, on all ranks, if a motion breaks down.
  void advance(const FlowSampler& flow, double step);

  /// The columns of a body's table, and its line for now.
  std::vector<std::string> columns(std::size_t body) const;
  std::vector<double> row(std::size_t body, Moment moment) const;
  /// What the body's surface file shows now; the arrays are the body's own.
  SurfaceSnapshot snapshot(std::size_t body) const;

 private:
  FluidConfig fluid_;
  Communicator ranks_;
  std::vector<DeformableBody> bodies_;
};

}  // namespace pliant
