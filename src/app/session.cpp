#include "app/session.hpp"

#include <mpi.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "core/error.hpp"

namespace pliant {
namespace {
constexpr std::chrono::seconds patience{20};

bool done_in_time(MPI_Request& request, std::chrono::steady_clock::time_point deadline) {
  int done = 0;
  while (true) {
    if (MPI_Test(&request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS) return false;
    if (done) return true;
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}
}  // namespace

Session::Session(int& argc, char**& argv) {
  if (MPI_Init(&argc, &argv) != MPI_SUCCESS) {
    std::fputs("pliant: MPI could not be started\n", stderr);
    std::exit(exit_run_error);
  }
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
}

int Session::end_together(int code) {
  int worst = code;
  MPI_Request request = MPI_REQUEST_NULL;
  const int started = MPI_Iallreduce(&code, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD, &request);
  // A rank that is through with a good result has nothing to fear from waiting: another may still be writing.
  const auto limit = code == exit_success ? std::chrono::hours(24) : std::chrono::hours(0);
  const auto deadline = std::chrono::steady_clock::now() + limit + patience;
  if (started != MPI_SUCCESS || !done_in_time(request, deadline)) {
    std::fputs("pliant: other ranks did not come to the end of the run; aborting all\n", stderr);
    MPI_Abort(MPI_COMM_WORLD, code == exit_success ? exit_run_error : code);
  }
  // HDF5 1.10 crashes in MPI_Finalize if a file could not be closed for want of space, and would hide the exit code.
  if (worst == exit_run_error) {
    std::fflush(nullptr);
    std::_Exit(worst);
  }
  if (MPI_Finalize() != MPI_SUCCESS && worst == exit_success) worst = exit_run_error;
  return worst;
}

std::string mpi_library() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = "";
  int length = 0;
  if (MPI_Get_library_version(text, &length) != MPI_SUCCESS) return "unknown";
  const std::string full(text, static_cast<std::size_t>(length));
  return full.substr(0, full.find(','));
}

}  // namespace pliant
