#pragma once

/// The one place that knows how a loop over cells or markers runs. Bodies take indices and hold only views and plain
/// values, so that another machine's loops can stand here.
namespace pliant {

/// body(i) for i = 0 .. n-1, in any order and many at once: a body writes only what no other i reads or writes.
template <class Body>
inline void for_each(int n, Body body) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) body(i);
}

/// body(j) for the rows of a plane, or any outer index, in ascending order.
template <class Body>
inline void for_rows(int n, Body&& body) {
  for (int j = 0; j < n; ++j) body(j);
}

/// body(k) for planes in ascending order: a sweep, in which a plane may use what its forerunner left.
template <class Body>
inline void sweep_up(int n, Body&& body) {
  for (int k = 0; k < n; ++k) body(k);
}

/// body(k) for planes in descending order.
template <class Body>
inline void sweep_down(int n, Body&& body) {
  for (int k = n - 1; k >= 0; --k) body(k);
}

}  // namespace pliant
