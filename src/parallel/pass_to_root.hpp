#pragma once
#include <functional>
#include <vector>

#include "parallel/communicator.hpp"

namespace pliant {

/// Hands the numbers of each rank to the root, one rank after the other in their order, so that the root never holds
/// those of all: `take` is called on the root, once a rank that has any. If it throws, the rest is still taken from the
/// ranks, and then every rank throws CollectiveError. Collective.
void pass_to_root(const Communicator& ranks, const std::vector<double>& mine,
                  const std::function<void(const std::vector<double>&)>& take);

}  // namespace pliant
