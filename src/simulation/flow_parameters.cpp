#include "simulation/flow_parameters.hpp"

#include "signals/make_signal.hpp"

namespace pliant {

FlowParameters flow_parameters(const CaseConfig& config) {
  FlowParameters parameters;
  parameters.density = config.fluid.density;
  parameters.viscosity = config.fluid.viscosity / config.fluid.density;
  parameters.viscous = config.time.viscous;
  parameters.sweeps = config.time.sweeps;
  parameters.boundary = config.boundary;
  parameters.signals = make_signals(config);
  parameters.forcing = config.forcing;
  return parameters;
}

}  // namespace pliant
