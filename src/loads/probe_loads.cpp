#include "loads/probe_loads.hpp"

namespace pliant {
namespace {

int n_distances(ProbeForm form) { return form == ProbeForm::quadratic ? 2 : 1; }

/// A site seen from one side: the normal points into that side's fluid.
struct Sided {
  Vec3 normal, normal_rate, velocity, acceleration;
  double stretch_rate;
};

Sided seen_from(const SurfaceSites& sites, std::size_t f, double sign) {
  return {sign * sites.normals[f], sign * sites.normal_rates[f], sites.velocities[f], sites.accelerations[f],
          sites.stretch_rates[f]};
}

Vec3 transposed_times(const Mat3& m, Vec3 a) { return a.x * m[0] + a.y * m[1] + a.z * m[2]; }

Vec3 tangential(Vec3 a, Vec3 normal) { return a - dot(a, normal) * normal; }

Vec3 viscous_traction(const Sided& site, const ProbeSettings& settings, const FlowSample& flow) {
  const Vec3 n = site.normal;
  const double mu = settings.viscosity, distance = settings.length - settings.offset;
  switch (settings.form) {
    case ProbeForm::gradient:
      return mu * (flow.gradient * n + transposed_times(flow.gradient, n));
    case ProbeForm::one_sided:
      return mu * ((flow.velocity - site.velocity) / distance - site.normal_rate);
    case ProbeForm::quadratic:
      break;
  }
  const Vec3 slope = (2 / distance) * (flow.velocity - site.velocity) - flow.gradient * n;
  return mu * (tangential(slope, n) - site.normal_rate - 2 * site.stretch_rate * n);
}

}  // namespace

void probe_points(const SurfaceSites& sites, const ProbeSettings& settings, std::vector<Vec3>& points) {
  points.clear();
  for (double sign : {1.0, -1.0}) {
    if (sign < 0 && settings.wetting == Wetting::outside) break;
    for (int distance = 1; distance <= n_distances(settings.form); ++distance)
      for (std::size_t f = 0; f < sites.size(); ++f)
        points.push_back(sites.positions[f] + (sign * distance * settings.length) * sites.normals[f]);
  }
}

void evaluate_probes(const SurfaceSites& sites, const ProbeSettings& settings, std::span<const FlowSample> samples,
                     ProbeLoads& loads) {
  const std::size_t n = sites.size();
  const bool is_quadratic = settings.form == ProbeForm::quadratic;
  loads.forces.assign(n, Vec3{});
  loads.inner.pressure.clear();
  loads.inner.shear.clear();

  const auto evaluate_side = [&](double sign, std::span<const FlowSample> near, SideLoads& side) {
    side.pressure.resize(n);
    side.shear.resize(n);
    for (std::size_t f = 0; f < n; ++f) {
      const Sided site = seen_from(sites, f, sign);
      const Vec3 traction = viscous_traction(site, settings, near[f]);
      side.pressure[f] = is_quadratic
                             ? 2 * near[f].pressure - near[n + f].pressure
                             : near[f].pressure + settings.density * settings.length *
                                                      dot(site.acceleration - settings.body_force, site.normal);
      side.shear[f] = tangential(traction, site.normal);
      loads.forces[f] += sites.areas[f] * (traction - side.pressure[f] * site.normal);
    }
  };
  const std::size_t of_side = n * static_cast<std::size_t>(n_distances(settings.form));
  evaluate_side(1, samples.first(of_side), loads.outer);
  if (settings.wetting == Wetting::both_sides) evaluate_side(-1, samples.subspan(of_side, of_side), loads.inner);
}

}  // namespace pliant
