#pragma once
#include "app/bench_command.hpp"
#include "app/bench_markers.hpp"

namespace pliant {

inline constexpr int most_bench_markers = 100'000'000;

/// What `pliant bench transfer` is asked to time.
struct TransferBenchOptions {
  int markers = 100'000;
  std::array<int, 3> cells{128, 128, 128};
  StretchingLaw stretching = StretchingLaw::uniform;
  BenchBoundary boundary = BenchBoundary::channel;
  MarkerOrder order = MarkerOrder::natural;
  int repeats = 7;  ///< each times every part once, in turn; the median is reported
  ReportFormat format = ReportFormat::text;
};

/// Times the transfer between flow and markers by the closed form and by generic 4 x 4 solves, and prints ns per marker
/// from rank 0: the time of the slowest rank over the markers of all. Collective over MPI_COMM_WORLD. Returns the exit
/// code of the program. Throws InputError if the box is too small.
int run_bench_transfer(const TransferBenchOptions& options);

}  // namespace pliant
