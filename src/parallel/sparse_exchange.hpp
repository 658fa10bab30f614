#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "parallel/communicator.hpp"

namespace pliant {

/// Items that go from every rank to some others. Ranks that have nothing for each other send no message; the order of
/// what arrives is that of the ranks it comes from, so results are the same bits at every run.
class SparseExchange {
 public:
  explicit SparseExchange(const Communicator& ranks);

  /// Takes how many items go to each rank, and learns how many come. Collective.
  void plan(std::span<const int> n_to_rank);

  std::size_t n_sent() const { return static_cast<std::size_t>(send_begin_.back()); }
  std::size_t n_received() const { return static_cast<std::size_t>(receive_begin_.back()); }

  /// Items of `width` numbers each: `sent` by rank of destination, `received` by rank of origin. Collective.
  void forward(std::span<const double> sent, int width, std::vector<double>& received) const;
  /// The way back: what belongs to received items goes to where they came from. Collective.
  void backward(std::span<const double> received, int width, std::vector<double>& sent) const;

 private:
  void move(const std::vector<int>& from_begin, std::span<const double> from, const std::vector<int>& to_begin,
            int width, std::span<double> to) const;

  Communicator ranks_;
  std::vector<int> send_begin_, receive_begin_;  // items, by rank, and the end
};

/// Sends bytes[r] to every rank r; returns what has come from each. Collective.
std::vector<std::vector<std::byte>> exchange_bytes(const Communicator& ranks,
                                                   const std::vector<std::vector<std::byte>>& bytes);

}  // namespace pliant
