#pragma once
#include <span>

#include "core/mat3.hpp"
#include "core/vec3.hpp"

namespace pliant {

/// The flow at one point.
struct FlowSample {
  Vec3 velocity;
  Mat3 gradient;  ///< gradient[i][j] = d u_i / d x_j
  double pressure = 0;
};

/// Anything that can tell the flow at points: the solver's fields, or a formula in tests.
class FlowSampler {
 public:
  virtual ~FlowSampler() = default;
  /// Fills samples[i] with the flow at points[i]. Collective over the ranks of the run; every rank asks for points of
  /// its own, or none.
  virtual void sample(std::span<const Vec3> points, std::span<FlowSample> samples) const = 0;
};

}  // namespace pliant
