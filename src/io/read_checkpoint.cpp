#include "io/read_checkpoint.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/byte_stream.hpp"
#include "core/error.hpp"
#include "io/checksum.hpp"
#include "parallel/agree.hpp"

namespace pliant {
namespace {

struct Share {
  std::uint64_t first, count;
};

Share share_of(std::uint64_t rows, const Communicator& ranks) {
  const auto n = static_cast<std::uint64_t>(ranks.size()), rank = static_cast<std::uint64_t>(ranks.rank());
  const auto first = rows / n * rank + std::min(rank, rows % n);
  return {first, rows / n + (rank < rows % n ? 1 : 0)};
}

}  // namespace

// What one rank throws becomes what all throw.
template <class Work>
void CheckpointReader::together(Work work) const {
  std::string problem;
  try {
    work();
  } catch (const std::exception& error) { problem = error.what(); }
  try {
    agree(ranks_, problem);
  } catch (const CollectiveError& error) { throw CheckpointRefused(error.what()); }
}

CheckpointReader::CheckpointReader(const std::filesystem::path& path, const Communicator& ranks) : ranks_(ranks) {
  try {
    together([&] {
      descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
      struct stat status {};
      if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0)
        throw CheckpointRefused(fmt::format("cannot be opened: {}", std::strerror(errno)));
      if (!S_ISREG(status.st_mode)) throw CheckpointRefused("is not a file");
      const auto size = static_cast<std::uint64_t>(status.st_size);
      std::vector<std::byte> preamble(std::min(static_cast<std::size_t>(size), CheckpointDirectory::preamble_size));
      read_at(0, preamble);
      const auto directory_size = CheckpointDirectory::check_preamble(preamble, size);
      if (directory_size > size - preamble.size()) throw CheckpointRefused("is damaged: its directory is cut");
      std::vector<std::byte> directory(directory_size);
      read_at(preamble.size(), directory);
      directory_ = CheckpointDirectory::decode(preamble, directory);
    });
  } catch (...) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw;
  }
}

CheckpointReader::~CheckpointReader() { ::close(descriptor_); }

void CheckpointReader::read_at(std::uint64_t offset, std::span<std::byte> bytes) const {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto got = ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw CheckpointRefused(fmt::format("cannot be read: {}", std::strerror(errno)));
    if (got == 0) throw CheckpointRefused("is damaged: it ends too early");
    done += static_cast<std::size_t>(got);
  }
}

std::vector<std::byte> CheckpointReader::read_rows(const CheckpointTable& table, std::uint64_t first,
                                                   std::uint64_t count) const {
  const auto row_bytes = static_cast<std::size_t>(table.row_bytes);
  std::vector<std::byte> rows(row_bytes * static_cast<std::size_t>(count));
  std::vector<std::byte> sealed(static_cast<std::size_t>(table.stride()));
  for (std::uint64_t n = 0; n < count; ++n) {
    read_at(table.offset + (first + n) * table.stride(), sealed);
    std::uint64_t sum = 0;
    std::memcpy(&sum, sealed.data() + row_bytes, sizeof sum);
    const auto row = std::span<const std::byte>(sealed).first(row_bytes);
    if (sum != row_checksum(table.name, first + n, row))
      throw CheckpointRefused(
          fmt::format("is damaged: row {} of {} does not match its checksum", first + n, table.name));
    std::copy(row.begin(), row.end(),
              rows.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(n) * row_bytes));
  }
  return rows;
}

std::vector<BodyBlob> CheckpointReader::read_my_bodies() const {
  const auto share = share_of(directory_.bodies.rows, ranks_);
  const auto rows = read_rows(directory_.bodies, share.first, share.count);
  std::vector<BodyBlob> bodies;
  for (std::uint64_t n = 0; n < share.count; ++n) {
    BodyEntry entry;
    std::memcpy(&entry, rows.data() + static_cast<std::size_t>(n) * sizeof entry, sizeof entry);
    BodyBlob body{static_cast<long>(entry.id), std::vector<std::byte>(static_cast<std::size_t>(entry.size))};
    read_at(entry.offset, body.bytes);
    if (checksum(body.bytes) != entry.sum)
      throw CheckpointRefused(fmt::format("is damaged: body {} does not match its checksum", entry.id));
    bodies.push_back(std::move(body));
  }
  return bodies;
}

void CheckpointReader::verify() {
  together([&] {
    for (const auto& table : directory_.tables) {
      const auto share = share_of(table.rows, ranks_);
      for (std::uint64_t n = 0; n < share.count; ++n) read_rows(table, share.first + n, 1);
    }
    read_my_bodies();
  });
}

std::vector<double> CheckpointReader::read_table(const CheckpointTable& kept, const RowTable& mine) const {
  if (kept.name != mine.name || kept.rows != mine.rows || kept.row_bytes != mine.row_size * sizeof(double))
    throw CheckpointRefused(fmt::format("is of another flow: its table {} has {} rows of {} bytes, not {} {} of {}",
                                        kept.name, kept.rows, kept.row_bytes, mine.name, mine.rows,
                                        mine.row_size * sizeof(double)));
  const auto rows = read_rows(kept, mine.first, mine.count);
  std::vector<double> values(mine.size());
  std::memcpy(values.data(), rows.data(), rows.size());
  return values;
}

void CheckpointReader::restore(const std::vector<StoredTable>& more) {
  together([&] {
    for (const auto& table : more) {
      const auto kept = std::find_if(directory_.tables.begin(), directory_.tables.end(),
                                     [&](const auto& one) { return one.name == table.shape.name; });
      if (kept == directory_.tables.end()) throw CheckpointRefused(fmt::format("has no table {}", table.shape.name));
      table.load(read_table(*kept, table.shape));
    }
  });
}

void CheckpointReader::restore(FlowSolver& flow) {
  together([&] {
    const auto tables = flow.state_tables();
    if (tables.size() > directory_.tables.size()) throw CheckpointRefused("is of another kind of flow");
    for (std::size_t t = 0; t < tables.size(); ++t) flow.load_table(t, read_table(directory_.tables[t], tables[t]));
  });
  try {
    // The numbers are the same on all ranks, so all of them come through or none.
    flow.finish_loading(directory_.head.flow);
  } catch (const ByteStreamError& error) {
    throw CheckpointRefused(fmt::format("is of another kind of flow: {}", error.what()));
  }
}

std::vector<BodyBlob> CheckpointReader::read_bodies() {
  std::vector<BodyBlob> bodies;
  together([&] { bodies = read_my_bodies(); });
  return bodies;
}

}  // namespace pliant
