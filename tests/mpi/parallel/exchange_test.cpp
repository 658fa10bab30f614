#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/error.hpp"
#include "parallel/pass_to_root.hpp"
#include "parallel/sparse_exchange.hpp"

namespace pliant {
namespace {

/// How many items go from one rank to another: none for some pairs, and none at all from rank 2.
int n_items(int from, int to) { return from == 2 ? 0 : (3 * from + to) % 4; }
double item(int from, int to, int i, int c) { return 1000 * from + 100 * to + 10 * i + c; }

/// What goes from this rank to all, or comes to it from all.
std::vector<double> items(const Communicator& ranks, bool sent, int width) {
  std::vector<double> numbers;
  for (int r = 0; r < ranks.size(); ++r) {
    const int from = sent ? ranks.rank() : r, to = sent ? r : ranks.rank();
    for (int i = 0; i < n_items(from, to); ++i)
      for (int c = 0; c < width; ++c) numbers.push_back(item(from, to, i, c));
  }
  return numbers;
}

TEST(SparseExchange, BringsItemsInTheOrderOfTheRanksAndBack) {
  const Communicator ranks;
  std::vector<int> counts;
  for (int r = 0; r < ranks.size(); ++r) counts.push_back(n_items(ranks.rank(), r));
  SparseExchange exchange(ranks);
  exchange.plan(counts);
  for (const int width : {1, 3}) {
    const auto sent = items(ranks, true, width), expected = items(ranks, false, width);
    EXPECT_EQ(exchange.n_sent() * static_cast<std::size_t>(width), sent.size());
    EXPECT_EQ(exchange.n_received() * static_cast<std::size_t>(width), expected.size());
    std::vector<double> received, back;
    exchange.forward(sent, width, received);
    EXPECT_EQ(received, expected);
    exchange.backward(received, width, back);
    EXPECT_EQ(back, sent);
  }
}

TEST(SparseExchange, MayBePlannedAnewAndMayHaveNothingToDo) {
  const Communicator ranks;
  SparseExchange exchange(ranks);
  std::vector<double> received{1, 2, 3};
  exchange.forward({}, 2, received);
  EXPECT_TRUE(received.empty());
  // A ring: one item to the next rank.
  std::vector<int> counts(static_cast<std::size_t>(ranks.size()), 0);
  counts[static_cast<std::size_t>((ranks.rank() + 1) % ranks.size())] = 1;
  exchange.plan(counts);
  exchange.forward(std::vector<double>{1.0 * ranks.rank()}, 1, received);
  EXPECT_EQ(received, (std::vector<double>{1.0 * ((ranks.rank() + ranks.size() - 1) % ranks.size())}));
}

TEST(SparseExchange, BringsBytes) {
  const Communicator ranks;
  std::vector<std::vector<std::byte>> bytes;
  for (int r = 0; r < ranks.size(); ++r)
    bytes.emplace_back(static_cast<std::size_t>(5 * n_items(ranks.rank(), r)), std::byte(16 * ranks.rank() + r));
  const auto received = exchange_bytes(ranks, bytes);
  ASSERT_EQ(received.size(), bytes.size());
  for (int r = 0; r < ranks.size(); ++r)
    EXPECT_EQ(received[static_cast<std::size_t>(r)],
              std::vector<std::byte>(static_cast<std::size_t>(5 * n_items(r, ranks.rank())),
                                     std::byte(16 * r + ranks.rank())));
}

TEST(PassToRoot, HandsOverOneRankAfterTheOther) {
  const Communicator ranks;
  // Rank 1 has nothing and the root is not called for it.
  std::vector<double> mine;
  if (ranks.rank() != 1) mine.assign(static_cast<std::size_t>(2 + ranks.rank()), 1.0 * ranks.rank());
  std::vector<std::vector<double>> taken;
  pass_to_root(ranks, mine, [&](const std::vector<double>& numbers) { taken.push_back(numbers); });
  if (!ranks.is_root()) {
    EXPECT_TRUE(taken.empty());
    return;
  }
  std::vector<std::vector<double>> expected;
  for (int r = 0; r < ranks.size(); ++r)
    if (r != 1) expected.emplace_back(static_cast<std::size_t>(2 + r), 1.0 * r);
  EXPECT_EQ(taken, expected);
}

TEST(PassToRoot, AFailureOfTheRootIsTheFailureOfAll) {
  const Communicator ranks;
  int calls = 0;
  const std::vector<double> mine(4, 1.0 * ranks.rank());
  try {
    pass_to_root(ranks, mine, [&](const std::vector<double>&) {
      ++calls;
      throw std::runtime_error("the disk is full");
    });
    ADD_FAILURE() << "must throw";
  } catch (const CollectiveError& error) { EXPECT_STREQ(error.what(), "the disk is full"); }
  EXPECT_EQ(calls, ranks.is_root() ? 1 : 0) << "what comes after a failure is not taken";
  // No message is left behind for the next one.
  long sum = 0;
  pass_to_root(ranks, std::vector<double>{1.0 + ranks.rank()},
               [&](const std::vector<double>& numbers) { sum += std::lround(numbers.at(0)); });
  if (ranks.is_root()) { EXPECT_EQ(sum, ranks.size() * (ranks.size() + 1) / 2); }
}

}  // namespace
}  // namespace pliant
