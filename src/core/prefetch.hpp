#pragma once
#include <array>
#include <cstddef>

namespace pliant {

/// Begins to load the cache line that holds an address, which need not be valid.
[[gnu::always_inline]] inline void prefetch(const void* address) {
  __builtin_prefetch(address);
  // g++ 12 takes a function that does no more than prefetch for one without effect and drops its calls. Not this one.
  asm volatile("");
}

/// Rows that a sweep will want soon, from memory or from the outer caches. A row kernel begins to load them bit by bit
/// while it works: all at once they would wait for each other, and the kernel behind them.
class RowsAhead {
 public:
  static constexpr std::size_t most = 18;

  RowsAhead() = default;
  /// Nothing but this row, which may be at hand.
  explicit RowsAhead(const double* row) { rows_.fill(row); }
  void add(const double* row) { rows_[n_++] = row; }
  const double* operator[](std::size_t r) const { return rows_[r]; }

 private:
  std::array<const double*, most> rows_{};
  std::size_t n_ = 0;
};

}  // namespace pliant
