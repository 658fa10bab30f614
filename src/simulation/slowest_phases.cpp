#include "simulation/slowest_phases.hpp"

#include <string>

namespace pliant {

PhaseTimer::Seconds slowest_of(const Communicator& ranks, const PhaseTimer::Seconds& mine) {
  std::string names;
  for (const auto& [phase, seconds] : mine) names += phase + '\n';
  names = ranks.broadcast(names);
  PhaseTimer::Seconds slowest;
  for (std::size_t begin = 0; begin < names.size();) {
    const auto end = names.find('\n', begin);
    const auto phase = names.substr(begin, end - begin);
    const auto found = mine.find(phase);
    slowest[phase] = ranks.max(found != mine.end() ? found->second : 0.0);
    begin = end + 1;
  }
  return slowest;
}

}  // namespace pliant
