#include "parallel/pass_to_root.hpp"

#include <exception>
#include <string>

#include "parallel/agree.hpp"

namespace pliant {

void pass_to_root(const Communicator& ranks, const std::vector<double>& mine,
                  const std::function<void(const std::vector<double>&)>& take) {
  constexpr int tag = 72;
  std::vector<int> counts(static_cast<std::size_t>(ranks.size()));
  const int count = static_cast<int>(mine.size());
  check_mpi(MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, ranks.handle()), "MPI_Gather");
  if (!ranks.is_root()) {
    if (count > 0) check_mpi(MPI_Send(mine.data(), count, MPI_DOUBLE, 0, tag, ranks.handle()), "MPI_Send");
    agree(ranks, "");
    return;
  }
  std::string problem;
  const auto try_to_take = [&](const std::vector<double>& numbers) {
    try {
      if (problem.empty() && !numbers.empty()) take(numbers);
    } catch (const std::exception& error) { problem = error.what(); }
  };
  try_to_take(mine);
  std::vector<double> received;
  for (int r = 1; r < ranks.size(); ++r) {
    const int expected = counts[static_cast<std::size_t>(r)];
    if (expected == 0) continue;
    received.resize(static_cast<std::size_t>(expected));
    check_mpi(MPI_Recv(received.data(), expected, MPI_DOUBLE, r, tag, ranks.handle(), MPI_STATUS_IGNORE), "MPI_Recv");
    try_to_take(received);
  }
  agree(ranks, problem);
}

}  // namespace pliant
