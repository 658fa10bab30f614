#include "parallel/agree.hpp"

#include "core/error.hpp"

namespace pliant {

void agree(const Communicator& ranks, const std::string& problem) {
  // One reduction in the good case; the text travels only in the bad one.
  const int last = ranks.max(problem.empty() ? 0 : ranks.size() - ranks.rank());
  if (last == 0) return;
  const int speaker = ranks.size() - last;
  int length = static_cast<int>(problem.size());
  check_mpi(MPI_Bcast(&length, 1, MPI_INT, speaker, ranks.handle()), "MPI_Bcast");
  std::string text = problem;
  text.resize(static_cast<std::size_t>(length));
  check_mpi(MPI_Bcast(text.data(), length, MPI_CHAR, speaker, ranks.handle()), "MPI_Bcast");
  throw CollectiveError(text);
}

void do_on_root(const Communicator& ranks, const std::function<void()>& work) {
  std::string problem;
  if (ranks.is_root()) {
    try {
      work();
    } catch (const std::exception& error) {
      problem = error.what();
      if (problem.empty()) problem = "the root rank failed without saying why";
    }
  }
  agree(ranks, problem);
}

}  // namespace pliant
