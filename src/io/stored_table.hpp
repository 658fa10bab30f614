#pragma once
#include <functional>
#include <span>

#include "field/row_table.hpp"

namespace pliant {

/// A table beside those of the flow that goes into a checkpoint and comes back, this rank's rows of it.
struct StoredTable {
  RowTable shape;
  std::function<void(std::span<double>)> save;
  std::function<void(std::span<const double>)> load;
};

}  // namespace pliant
