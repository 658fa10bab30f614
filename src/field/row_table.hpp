#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace pliant {

/// A table of doubles that is shared out over the ranks by rows: a field by planes, the values along a side by lines.
/// What it looks like as a whole does not depend on the number of ranks.
struct RowTable {
  std::string name;
  std::uint64_t rows = 0;   ///< of the whole table
  std::uint64_t first = 0;  ///< this rank's rows are first .. first + count - 1
  std::uint64_t count = 0;
  std::size_t row_size = 0;  ///< doubles in a row

  std::size_t size() const { return static_cast<std::size_t>(count) * row_size; }  ///< doubles of this rank
};

}  // namespace pliant
