#pragma once
#include "loads/probe_loads.hpp"
#include "transfer/flow_sample.hpp"

namespace pliant {

/// The loads that the probes of `sites` find in a flow.
inline ProbeLoads loads_of(const SurfaceSites& sites, const ProbeSettings& settings, const FlowSampler& flow) {
  std::vector<Vec3> points;
  probe_points(sites, settings, points);
  std::vector<FlowSample> samples(points.size());
  flow.sample(points, samples);
  ProbeLoads loads;
  evaluate_probes(sites, settings, samples, loads);
  return loads;
}

}  // namespace pliant
