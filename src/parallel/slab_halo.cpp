#include "parallel/slab_halo.hpp"

#include <array>
#include <cstring>

#include "core/error.hpp"

namespace pliant {
namespace {

constexpr std::size_t most = 8;  // fields in one exchange

void add(double* to, const double* from, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) to[i] += from[i];
}

}  // namespace

SlabHalo::SlabHalo(const Communicator& ranks, Ends ends, int planes) : ranks_(ranks), planes_(planes) {
  const int n = ranks.size(), r = ranks.rank();
  below_ = r > 0 ? r - 1 : ends == Ends::periodic ? n - 1 : MPI_PROC_NULL;
  above_ = r < n - 1 ? r + 1 : ends == Ends::periodic ? 0 : MPI_PROC_NULL;
}

void SlabHalo::fill(std::initializer_list<PlaneStack> stacks, GhostPlanes which) const {
  const bool lower = which != GhostPlanes::upper, upper = which != GhostPlanes::lower;
  if (below_ == ranks_.rank()) {  // a single rank, periodic
    for (const auto& s : stacks) {
      if (lower) std::memcpy(s.first - s.stride, s.first + (planes_ - 1) * s.stride, s.size * sizeof(double));
      if (upper) std::memcpy(s.first + planes_ * s.stride, s.first, s.size * sizeof(double));
    }
    return;
  }
  if (stacks.size() > most) throw RunError("SlabHalo::fill: more than 8 fields in one exchange");
  std::array<MPI_Request, 4 * most> requests;
  int n = 0, tag = 0;
  for (const auto& s : stacks) {
    const int count = static_cast<int>(s.size);
    const auto receive = [&](double* into, int from, int t) {
      check_mpi(MPI_Irecv(into, count, MPI_DOUBLE, from, t, ranks_.handle(), &requests[static_cast<std::size_t>(n++)]),
                "MPI_Irecv");
    };
    const auto send = [&](const double* from, int to, int t) {
      if (to != MPI_PROC_NULL) ranks_.count_message(s.size);
      check_mpi(MPI_Isend(from, count, MPI_DOUBLE, to, t, ranks_.handle(), &requests[static_cast<std::size_t>(n++)]),
                "MPI_Isend");
    };
    if (lower) receive(s.first - s.stride, below_, tag);
    if (upper) receive(s.first + planes_ * s.stride, above_, tag + 1);
    if (lower) send(s.first + (planes_ - 1) * s.stride, above_, tag);
    if (upper) send(s.first, below_, tag + 1);
    tag += 2;
  }
  check_mpi(MPI_Waitall(n, requests.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
}

void SlabHalo::accumulate(std::initializer_list<PlaneStack> stacks) {
  if (below_ == ranks_.rank()) {
    for (const auto& s : stacks) {
      add(s.first, s.first + planes_ * s.stride, s.size);
      add(s.first + (planes_ - 1) * s.stride, s.first - s.stride, s.size);
    }
    return;
  }
  if (stacks.size() > most) throw RunError("SlabHalo::accumulate: more than 8 fields in one exchange");
  std::size_t size = 0;
  for (const auto& s : stacks) size += 2 * s.size;
  if (incoming_.size() < size) incoming_.resize(size);
  std::array<MPI_Request, 4 * most> requests;
  int n = 0, tag = 0;
  double* buffer = incoming_.data();
  for (const auto& s : stacks) {
    const int count = static_cast<int>(s.size);
    const auto next = [&] { return &requests[static_cast<std::size_t>(n++)]; };
    for (const int to : {below_, above_})
      if (to != MPI_PROC_NULL) ranks_.count_message(s.size);
    check_mpi(MPI_Irecv(buffer, count, MPI_DOUBLE, below_, tag + 1, ranks_.handle(), next()), "MPI_Irecv");
    check_mpi(MPI_Irecv(buffer + s.size, count, MPI_DOUBLE, above_, tag, ranks_.handle(), next()), "MPI_Irecv");
    check_mpi(MPI_Isend(s.first - s.stride, count, MPI_DOUBLE, below_, tag, ranks_.handle(), next()), "MPI_Isend");
    check_mpi(MPI_Isend(s.first + planes_ * s.stride, count, MPI_DOUBLE, above_, tag + 1, ranks_.handle(), next()),
              "MPI_Isend");
    buffer += 2 * s.size;
    tag += 2;
  }
  check_mpi(MPI_Waitall(n, requests.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
  buffer = incoming_.data();
  for (const auto& s : stacks) {
    if (below_ != MPI_PROC_NULL) add(s.first, buffer, s.size);
    if (above_ != MPI_PROC_NULL) add(s.first + (planes_ - 1) * s.stride, buffer + s.size, s.size);
    buffer += 2 * s.size;
  }
}

}  // namespace pliant
