#include "transfer/mls_sampler.hpp"

#include <fmt/format.h>

#include <vector>

#include "core/error.hpp"
#include "parallel/agree.hpp"
#include "transfer/probe_points.hpp"

namespace pliant {
namespace {

constexpr std::size_t n_numbers = 13;  // velocity, gradient, pressure

}  // namespace

MlsSampler::MlsSampler(const Grid& grid, SampledFields fields, double density)
    : shape_(grid), fields_(fields), density_(density), router_(grid) {}

void MlsSampler::sample(std::span<const Vec3> points, std::span<FlowSample> samples) const {
  const auto outside = router_.first_outside(points);
  agree(shape_.grid().ranks(), outside == points.size()
                                   ? ""
                                   : fmt::format("the flow was asked for at ({}, {}, {}), which is outside the box",
                                                 points[outside].x, points[outside].y, points[outside].z));
  router_.route(points);
  evaluate(router_.held());
  numbers_.resize(n_numbers * points.size());
  router_.collect(held_numbers_, static_cast<int>(n_numbers), numbers_);
  for (std::size_t n = 0; n < points.size(); ++n) {
    const double* in = numbers_.data() + n_numbers * n;
    samples[n].velocity = {in[0], in[1], in[2]};
    for (int i = 0; i < 3; ++i) samples[n].gradient[i] = {in[3 + 3 * i], in[4 + 3 * i], in[5 + 3 * i]};
    samples[n].pressure = in[12];
  }
}

void MlsSampler::evaluate(std::span<const Vec3> points) const {
  held_numbers_.assign(n_numbers * points.size(), 0.0);
  const ProbedFields fields{fields_.u->view(), fields_.v->view(), fields_.w->view(), fields_.p->view()};
  for_each_probe_batch(shape_, fields, points, [&](const ProbedPoints& batch) {
    ProbeBatch found;
    probe_all(fields, batch.stencils, batch.slopes, batch.count, found);
    for (int l = 0; l < batch.count; ++l) {
      double* out = held_numbers_.data() + n_numbers * batch.indices[static_cast<std::size_t>(l)];
      for (int c = 0; c < 3; ++c) {
        if (!(c == 2 ? batch.has_face[l] : batch.has_center[l])) continue;
        out[c] = found.velocity[c][l];
        for (int d = 0; d < 3; ++d) out[3 + 3 * c + d] = found.gradient[c][d][l];
      }
      if (batch.has_center[l]) out[12] = density_ * found.pressure[l];
    }
  });
}

}  // namespace pliant
