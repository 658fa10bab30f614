#pragma once
#include <mpi.h>

#include <span>
#include <string>
#include <vector>

namespace pliant {

/// Throws RunError with MPI's own text when an MPI call reports a failure.
void check_mpi(int code, const char* what);

/// The ranks of a run. A thin value over an MPI communicator; copies refer to the same ranks.
class Communicator {
 public:
  explicit Communicator(MPI_Comm comm = MPI_COMM_WORLD);

  MPI_Comm handle() const { return comm_; }
  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }

  double sum(double value) const;
  double max(double value) const;
  double min(double value) const;
  long sum(long value) const;
  int max(int value) const;
  /// Element by element over the ranks, in place.
  void sum(std::span<double> values) const;
  void barrier() const;
  /// The root's text on every rank.
  std::string broadcast(std::string text) const;

 private:
  MPI_Comm comm_;
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace pliant
