#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/error.hpp"
#include "io/posix_file.hpp"

namespace pliant {

std::filesystem::path temporary_name(const std::filesystem::path& path) {
  auto name = path;
  name += ".tmp";
  return name;
}

void write_file_atomically(const std::filesystem::path& path, std::string_view text) {
  const auto temporary = temporary_name(path);
  try {
    PosixFile file(temporary);
    file.append(text);
    file.close();
    rename_into_place(temporary, path);
  } catch (...) {
    remove_quietly(temporary);
    throw;
  }
}

void rename_into_place(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  std::error_code code;
  std::filesystem::rename(temporary, path, code);
  if (code)
    throw RunError(fmt::format("cannot rename {} to {}: {}", temporary.string(), path.string(), code.message()));
}

void bring_to_disk(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  // Some file systems know no such thing for folders.
  const bool good = descriptor >= 0 && (::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS);
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!good) throw RunError(fmt::format("cannot bring {} to the disk: {}", path.string(), std::strerror(reason)));
}

void remove_quietly(const std::filesystem::path& path) {
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
}

}  // namespace pliant
