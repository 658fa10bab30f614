#pragma once
#include <mpi.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace pliant {

/// Throws RunError with MPI's own text when an MPI call reports a failure.
void check_mpi(int code, const char* what);

/// What a rank has sent to others in exchanges of planes and lines.
struct Traffic {
  long messages = 0;
  long bytes = 0;
};

/// The ranks of a run. A thin value over an MPI communicator; copies refer to the same ranks and count together.
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

  /// For those who send by themselves, through handle(): so much has gone to another rank.
  void count_message(std::size_t doubles) const {
    ++traffic_->messages;
    traffic_->bytes += static_cast<long>(doubles * sizeof(double));
  }
  Traffic traffic() const { return *traffic_; }

 private:
  MPI_Comm comm_;
  int rank_ = 0;
  int size_ = 1;
  std::shared_ptr<Traffic> traffic_ = std::make_shared<Traffic>();
};

}  // namespace pliant
