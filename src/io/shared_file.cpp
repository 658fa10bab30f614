#include "io/shared_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.hpp"
#include "parallel/agree.hpp"

namespace pliant {

SharedFile::SharedFile(const std::filesystem::path& path, const Communicator& ranks) : path_(path), ranks_(ranks) {
  const int code = MPI_File_open(ranks.handle(), path_.c_str(), MPI_MODE_WRONLY, MPI_INFO_NULL, &file_);
  if (code != MPI_SUCCESS) file_ = MPI_FILE_NULL;
  check(code, "open");
}

SharedFile::~SharedFile() {
  if (file_ != MPI_FILE_NULL) MPI_File_close(&file_);
}

void SharedFile::write_rows(std::uint64_t offset, const void* values, std::size_t n_rows, std::size_t row_bytes) {
  // Rows as units: MPI counts in int, and a rank may hold more than 2 GB.
  MPI_Datatype row = MPI_DATATYPE_NULL;
  check_mpi(MPI_Type_contiguous(static_cast<int>(row_bytes), MPI_BYTE, &row), "MPI_Type_contiguous");
  check_mpi(MPI_Type_commit(&row), "MPI_Type_commit");
  MPI_Status status;
  int code =
      MPI_File_write_at_all(file_, static_cast<MPI_Offset>(offset), values, static_cast<int>(n_rows), row, &status);
  int written = 0;
  if (code == MPI_SUCCESS) code = MPI_Get_count(&status, row, &written);
  if (code == MPI_SUCCESS && written != static_cast<int>(n_rows)) code = MPI_ERR_NO_SPACE;
  check_mpi(MPI_Type_free(&row), "MPI_Type_free");
  check(code, "write");
}

void SharedFile::sync() { check(MPI_File_sync(file_), "bring to the disk"); }
void SharedFile::close() { check(MPI_File_close(&file_), "finish writing"); }

void SharedFile::check(int code, const char* action) const {
  std::string problem;
  if (code != MPI_SUCCESS) {
    char text[MPI_MAX_ERROR_STRING] = {};
    int length = 0;
    MPI_Error_string(code, text, &length);
    problem = fmt::format("cannot {} {}: {}", action, path_.string(), text);
  }
  agree(ranks_, problem);
}

void set_space_aside(const std::filesystem::path& path, std::uint64_t bytes) {
  const auto fail = [&](const char* action) {
    throw RunError(fmt::format("cannot {} {} ({} bytes): {}", action, path.string(), bytes, std::strerror(errno)));
  };
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) fail("create");
  if (::fallocate(descriptor, 0, 0, static_cast<off_t>(bytes)) != 0 && errno != EOPNOTSUPP && errno != ENOSYS) {
    const int reason = errno;
    ::close(descriptor);
    errno = reason;
    fail("find the disk space for");
  }
  if (::close(descriptor) != 0) fail("finish writing");
}

}  // namespace pliant
