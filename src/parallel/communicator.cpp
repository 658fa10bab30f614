#include "parallel/communicator.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace pliant {

void check_mpi(int code, const char* what) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = {};
  int length = 0;
  MPI_Error_string(code, text, &length);
  throw RunError(fmt::format("MPI failed in {}: {}", what, text));
}

Communicator::Communicator(MPI_Comm comm) : comm_(comm) {
  check_mpi(MPI_Comm_rank(comm, &rank_), "MPI_Comm_rank");
  check_mpi(MPI_Comm_size(comm, &size_), "MPI_Comm_size");
}

namespace {
template <class T>
T reduce(T value, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  T result{};
  check_mpi(MPI_Allreduce(&value, &result, 1, type, op, comm), "MPI_Allreduce");
  return result;
}
}  // namespace

double Communicator::sum(double value) const { return reduce(value, MPI_DOUBLE, MPI_SUM, comm_); }
double Communicator::max(double value) const { return reduce(value, MPI_DOUBLE, MPI_MAX, comm_); }
double Communicator::min(double value) const { return reduce(value, MPI_DOUBLE, MPI_MIN, comm_); }
long Communicator::sum(long value) const { return reduce(value, MPI_LONG, MPI_SUM, comm_); }
int Communicator::max(int value) const { return reduce(value, MPI_INT, MPI_MAX, comm_); }

void Communicator::sum(std::span<double> values) const {
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, comm_),
            "MPI_Allreduce");
}

void Communicator::barrier() const { check_mpi(MPI_Barrier(comm_), "MPI_Barrier"); }

std::string Communicator::broadcast(std::string text) const {
  int length = static_cast<int>(text.size());
  check_mpi(MPI_Bcast(&length, 1, MPI_INT, 0, comm_), "MPI_Bcast");
  text.resize(static_cast<std::size_t>(length));
  check_mpi(MPI_Bcast(text.data(), length, MPI_CHAR, 0, comm_), "MPI_Bcast");
  return text;
}

}  // namespace pliant
