#pragma once
#include <array>

#include "config/case_config.hpp"

namespace pliant {

/// The sides of the box in which speed is measured.
enum class BenchBoundary {
  periodic,    ///< all three directions periodic
  channel,     ///< x and y periodic, walls in z
  closed_box,  ///< walls on all six sides
};

enum class ReportFormat { text, json };

BoundaryConfig sides_of(BenchBoundary boundary);

/// What `pliant bench flow` is asked to time.
struct BenchOptions {
  std::array<int, 3> cells{128, 128, 128};
  ViscousMode viscous = ViscousMode::implicit;
  Sweeps sweeps = Sweeps::fused;
  int steps = 20;
  int repeats = 5;  ///< timed repetitions of `steps` steps; the median is reported
  StretchingLaw stretching = StretchingLaw::uniform;
  BenchBoundary boundary = BenchBoundary::channel;
  ReportFormat format = ReportFormat::text;
};

/// Times the flow solver alone and prints ns per cell and step, memory and the share of each phase from rank 0.
/// Collective over MPI_COMM_WORLD. Returns the exit code of the program.
int run_bench_flow(const BenchOptions& options);

}  // namespace pliant
