#include "parallel/sparse_exchange.hpp"

#include <algorithm>

namespace pliant {
namespace {

constexpr int message_tag = 71;

template <class T>
void move_items(const Communicator& ranks, const std::vector<int>& from_begin, const T* from,
                const std::vector<int>& to_begin, T* to, MPI_Datatype type, int width) {
  std::vector<MPI_Request> requests;
  const auto self = static_cast<std::size_t>(ranks.rank());
  for (int r = 0; r < ranks.size(); ++r) {
    const auto at = static_cast<std::size_t>(r);
    const int count = (to_begin[at + 1] - to_begin[at]) * width;
    if (count == 0 || at == self) continue;
    check_mpi(MPI_Irecv(to + static_cast<std::ptrdiff_t>(to_begin[at]) * width, count, type, r, message_tag,
                        ranks.handle(), &requests.emplace_back()),
              "MPI_Irecv");
  }
  for (int r = 0; r < ranks.size(); ++r) {
    const auto at = static_cast<std::size_t>(r);
    const int count = (from_begin[at + 1] - from_begin[at]) * width;
    if (count == 0 || at == self) continue;
    check_mpi(MPI_Isend(from + static_cast<std::ptrdiff_t>(from_begin[at]) * width, count, type, r, message_tag,
                        ranks.handle(), &requests.emplace_back()),
              "MPI_Isend");
  }
  std::copy(from + static_cast<std::ptrdiff_t>(from_begin[self]) * width,
            from + static_cast<std::ptrdiff_t>(from_begin[self + 1]) * width,
            to + static_cast<std::ptrdiff_t>(to_begin[self]) * width);
  check_mpi(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
}

// Counts of what goes to each rank turned into where it begins, and the same of what comes.
void learn_places(const Communicator& ranks, std::span<const int> n_to_rank, std::vector<int>& send_begin,
                  std::vector<int>& receive_begin) {
  const auto n = static_cast<std::size_t>(ranks.size());
  std::vector<int> n_from_rank(n_to_rank.begin(), n_to_rank.end());
  if (n > 1)
    check_mpi(MPI_Alltoall(n_to_rank.data(), 1, MPI_INT, n_from_rank.data(), 1, MPI_INT, ranks.handle()),
              "MPI_Alltoall");
  send_begin.assign(n + 1, 0);
  receive_begin.assign(n + 1, 0);
  for (std::size_t r = 0; r < n; ++r) {
    send_begin[r + 1] = send_begin[r] + n_to_rank[r];
    receive_begin[r + 1] = receive_begin[r] + n_from_rank[r];
  }
}

}  // namespace

SparseExchange::SparseExchange(const Communicator& ranks)
    : ranks_(ranks),
      send_begin_(static_cast<std::size_t>(ranks.size()) + 1, 0),
      receive_begin_(static_cast<std::size_t>(ranks.size()) + 1, 0) {}

void SparseExchange::plan(std::span<const int> n_to_rank) {
  learn_places(ranks_, n_to_rank, send_begin_, receive_begin_);
}

void SparseExchange::move(const std::vector<int>& from_begin, std::span<const double> from,
                          const std::vector<int>& to_begin, int width, std::span<double> to) const {
  move_items(ranks_, from_begin, from.data(), to_begin, to.data(), MPI_DOUBLE, width);
}

void SparseExchange::forward(std::span<const double> sent, int width, std::vector<double>& received) const {
  received.resize(n_received() * static_cast<std::size_t>(width));
  move(send_begin_, sent, receive_begin_, width, received);
}

void SparseExchange::backward(std::span<const double> received, int width, std::vector<double>& sent) const {
  sent.resize(n_sent() * static_cast<std::size_t>(width));
  move(receive_begin_, received, send_begin_, width, sent);
}

std::vector<std::vector<std::byte>> exchange_bytes(const Communicator& ranks,
                                                   const std::vector<std::vector<std::byte>>& bytes) {
  std::vector<int> counts;
  std::vector<std::byte> sent;
  for (const auto& part : bytes) {
    counts.push_back(static_cast<int>(part.size()));
    sent.insert(sent.end(), part.begin(), part.end());
  }
  std::vector<int> send_begin, receive_begin;
  learn_places(ranks, counts, send_begin, receive_begin);
  std::vector<std::byte> received(static_cast<std::size_t>(receive_begin.back()));
  move_items(ranks, send_begin, sent.data(), receive_begin, received.data(), MPI_BYTE, 1);
  std::vector<std::vector<std::byte>> result;
  for (std::size_t r = 0; r + 1 < receive_begin.size(); ++r)
    result.emplace_back(received.begin() + receive_begin[r], received.begin() + receive_begin[r + 1]);
  return result;
}

}  // namespace pliant
