#include <fmt/format.h>
#include <mpi.h>

#include <cstdio>
#include <span>

#include "mesh/geometry.hpp"
#include "mpi/transfer/sphere_in_flow.hpp"

// What passes the surface of a fixed sphere, by faces and markers a face: the tables of bench/markers.md.
namespace {

using namespace pliant;

double longest_edge(int frequency, double diameter) {
  const auto surface = make_icosphere(frequency, diameter / 2);
  const auto lengths = edge_lengths(surface.mesh, surface.positions);
  return *std::max_element(lengths.begin(), lengths.end());
}

void measure(double diameter, int frequency, int parts, int iterations) {
  test::SphereInFlow flow;
  flow.diameter = diameter;
  flow.cells = static_cast<int>(2.5 * diameter);
  flow.iterations = iterations;
  const auto leak = test::measure_leak(flow, frequency, parts, 40);
  if (!Communicator().is_root()) return;
  const int n = parts == 0 ? refinement_for(longest_edge(frequency, diameter), 1.0) : parts;
  if (!std::isfinite(leak.rms)) {
    fmt::print("| {} | {} | {} | {} | {} | {:.2f} | unstable |\n", diameter, 20 * frequency * frequency, parts,
               iterations, leak.markers, longest_edge(frequency, diameter) / n);
    return;
  }
  fmt::print("| {} | {} | {} | {} | {} | {:.2f} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | {:.4f} |\n", diameter,
             20 * frequency * frequency, parts == 0 ? "rule" : std::to_string(parts), iterations, leak.markers,
             longest_edge(frequency, diameter) / n, leak.rms_at_markers, leak.rms, leak.largest, leak.through,
             leak.inside);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const std::string_view part = argc > 1 ? argv[1] : "table";
  if (part == "table")
    for (const double diameter : {12.0, 24.0})
      for (const int frequency : {4, 8, 16})
        for (const int parts : {0, 1, 2, 3, 4})
          if (frequency * parts <= 32) measure(diameter, frequency, parts, 1);
  if (part == "iterations")
    for (const int iterations : {2, 4})
      for (const int parts : {0, 1, 2, 4}) measure(24, 4, parts, iterations);
  if (part == "scan")
    for (const double diameter : {10, 12, 14, 16, 18, 20, 22, 24, 26, 28})
      for (const int parts : {1, 2, 4}) measure(diameter, 8, parts, 1);
  MPI_Finalize();
}
