#pragma once
#include <functional>
#include <string>

#include "parallel/communicator.hpp"

namespace pliant {

/// Makes a failure of one rank the failure of all: if any rank hands in a problem (a text that is not empty), every
/// rank throws CollectiveError with the text of the lowest such rank. Collective; without it the other ranks would wait
/// for ever.
void agree(const Communicator& ranks, const std::string& problem);

/// Does something on the root alone. If it throws there, every rank throws CollectiveError with the same text.
/// Collective.
void do_on_root(const Communicator& ranks, const std::function<void()>& work);

}  // namespace pliant
