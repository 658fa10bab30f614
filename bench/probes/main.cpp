#include <fmt/format.h>
#include <mpi.h>

#include <cstdio>

#include "loads/momentum_balance.hpp"
#include "mpi/transfer/sphere_in_flow.hpp"
#include "transfer/mls_sampler.hpp"
#include "unit/loads/sampled_loads.hpp"

// Probe loads on a fixed sphere against the momentum balance of the same flow: the table of bench/markers.md.
namespace {

using namespace pliant;

Vec3 sum(const std::vector<Vec3>& forces) {
  Vec3 total;
  for (Vec3 f : forces) total += f;
  return total;
}

void measure(const test::SphereInFlow& c, int frequency, int steps, double retraction) {
  const Grid grid = test::make_grid(c);
  auto solver = test::make_solver(c, grid);
  auto surface = make_icosphere(frequency, c.diameter / 2);
  for (Vec3& x : surface.positions) x += test::center_of(c);
  const std::vector<Vec3> zero(surface.positions.size());
  const MarkerLayout layout(surface.mesh, refinement_for(surface.mesh, surface.positions, grid.dx()));
  MarkerSet markers;
  layout.place_inside(surface.positions, zero, retraction, markers);
  DirectForcing forcing(grid, 1.0, c.iterations);
  forcing.place(markers.positions, markers.areas, markers.velocities);
  for (int n = 0; n < steps; ++n) test::advance(solver, forcing, c.courant);

  std::vector<Vec3> forces(markers.positions.size());
  forcing.add_forces(forces);
  const InnerFluid inner{1.0, enclosed_moments(surface.mesh, surface.positions), {solver.bulk_forcing(), 0, 0}};
  const double exact = momentum_balance({sum(forces), {}}, inner, {}, {}).force.x;

  const auto& flow = solver.state();
  const MlsSampler sampler(grid, {&flow.u, &flow.v, &flow.w, &flow.p}, 1.0);
  SurfaceSites sites;
  set_sites(surface.mesh, surface.positions, zero, zero, sites);
  const double coefficient = exact / (M_PI / 8 * c.diameter * c.diameter);
  for (const double h : {1.0, 1.5, 2.0, 3.0}) {
    fmt::print("| {} | {} | {} | {:.3f} | {}", c.reynolds, c.diameter, retraction, coefficient, h);
    for (const ProbeForm form : {ProbeForm::gradient, ProbeForm::one_sided, ProbeForm::quadratic}) {
      const double offset = retraction > 0 ? 0 : forced_surface_offset;
      const ProbeSettings settings{form, Wetting::outside, h, offset, 1.0, solver.parameters().viscosity, {}};
      fmt::print(" | {:.2f}", sum(loads_of(sites, settings, sampler).forces).x / exact);
    }
    fmt::print(" |\n");
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  for (const double reynolds : {20.0, 100.0})
    for (const double diameter : {12.0, 16.0, 28.0})
      for (const double retraction : {0.0, marker_retraction}) {
        test::SphereInFlow flow;
        flow.diameter = diameter;
        flow.reynolds = reynolds;
        flow.courant = 0.2;
        flow.cells = static_cast<int>(2.5 * diameter);
        measure(flow, 8, static_cast<int>(diameter / flow.courant), retraction);
      }
  MPI_Finalize();
}
