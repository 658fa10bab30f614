#pragma once
#include "parallel/communicator.hpp"

namespace pliant {

/// The first n ranks of the test; the others have none.
class FirstRanks {
 public:
  explicit FirstRanks(int n) {
    const Communicator world;
    check_mpi(MPI_Comm_split(world.handle(), world.rank() < n ? 0 : MPI_UNDEFINED, world.rank(), &comm_),
              "MPI_Comm_split");
    if (comm_ != MPI_COMM_NULL) check_mpi(MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  }
  ~FirstRanks() {
    if (comm_ != MPI_COMM_NULL) MPI_Comm_free(&comm_);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  FirstRanks(const FirstRanks&) = delete;
  FirstRanks& operator=(const FirstRanks&) = delete;
  bool am_in() const { return comm_ != MPI_COMM_NULL; }
  Communicator ranks() const { return Communicator(comm_); }

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
};

}  // namespace pliant
