#pragma once
#include "transfer/flow_sample.hpp"
#include "unit/structure/body_of.hpp"

namespace pliant {

/// u = velocity + gradient x, p = pressure + pressure_gradient . x
struct LinearFlow : FlowSampler {
  Vec3 velocity;
  Mat3 gradient;
  double pressure = 0;
  Vec3 pressure_gradient;

  void sample(std::span<const Vec3> points, std::span<FlowSample> samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i)
      samples[i] = {velocity + gradient * points[i], gradient, pressure + dot(pressure_gradient, points[i])};
  }
};

/// u = (rate z, 0, 0)
inline LinearFlow make_shear(double rate) {
  LinearFlow flow;
  flow.gradient[0].z = rate;
  return flow;
}

inline BodyConfig sphere_config(int frequency, TractionForm form) {
  BodyConfig config;
  config.name = "sphere";
  config.surface = SphereSurface{frequency, 1.0};
  config.traction.form = form;
  return config;
}

}  // namespace pliant
