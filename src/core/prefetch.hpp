#pragma once

namespace pliant {

/// Begins to load the cache line that holds an address, which need not be valid.
[[gnu::always_inline]] inline void prefetch(const void* address) {
  __builtin_prefetch(address);
  // g++ 12 takes a function that does no more than prefetch for one without effect and drops its calls. Not this one.
  asm volatile("");
}

}  // namespace pliant
