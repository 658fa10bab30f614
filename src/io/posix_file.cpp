#include "io/posix_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.hpp"

namespace pliant {
namespace {
[[noreturn]] void fail(const char* action, const std::filesystem::path& path, int code) {
  throw RunError(fmt::format("cannot {} {}: {}", action, path.string(), std::strerror(code)));
}
}  // namespace

PosixFile::PosixFile(std::filesystem::path path) : path_(std::move(path)) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("create", path_, errno);
}

PosixFile::PosixFile(std::filesystem::path path, std::int64_t size) : path_(std::move(path)), size_(size) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail("open", path_, errno);
  try {
    const auto present = ::lseek(descriptor_, 0, SEEK_END);
    if (present < 0) fail("find the end of", path_, errno);
    if (present < size_)
      throw RunError(fmt::format("{} has {} bytes, but had {} before", path_.string(), present, size_));
    if (::ftruncate(descriptor_, size_) != 0 || ::lseek(descriptor_, size_, SEEK_SET) != size_)
      fail("cut back", path_, errno);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

PosixFile::~PosixFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void PosixFile::append(std::string_view text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const auto written = ::write(descriptor_, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const int code = written < 0 ? errno : ENOSPC;
      // Half a line would make the whole file unreadable to a strict reader.
      if (::ftruncate(descriptor_, size_) == 0) ::lseek(descriptor_, size_, SEEK_SET);
      fail("write", path_, code);
    }
    done += static_cast<std::size_t>(written);
  }
  size_ += static_cast<std::int64_t>(text.size());
}

void PosixFile::close() {
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (descriptor >= 0 && ::close(descriptor) != 0) fail("finish writing", path_, errno);
}

}  // namespace pliant
