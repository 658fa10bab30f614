#include "io/write_checkpoint.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/checksum.hpp"
#include "io/posix_file.hpp"
#include "io/shared_file.hpp"
#include "parallel/agree.hpp"

namespace pliant {
namespace {

// What the ranks before this one hold.
long sum_before(const Communicator& ranks, long value) {
  long sum = 0;
  check_mpi(MPI_Exscan(&value, &sum, 1, MPI_LONG, MPI_SUM, ranks.handle()), "MPI_Exscan");
  return ranks.rank() == 0 ? 0 : sum;
}

long total_size(const std::vector<BodyBlob>& bodies) {
  std::size_t size = 0;
  for (const auto& body : bodies) size += body.bytes.size();
  return static_cast<long>(size);
}

CheckpointDirectory plan(const CheckpointHead& head, const std::vector<RowTable>& tables, long n_bodies,
                         long body_bytes) {
  CheckpointDirectory directory;
  directory.head = head;
  for (const auto& table : tables)
    directory.tables.push_back({table.name, 0, table.rows, table.row_size * sizeof(double)});
  directory.bodies = {"bodies", 0, static_cast<std::uint64_t>(n_bodies), sizeof(BodyEntry)};
  directory.body_bytes = static_cast<std::uint64_t>(body_bytes);
  directory.set_offsets();
  return directory;
}

// This rank's rows of a table, each with its checksum behind it.
std::vector<std::byte> seal_rows(const CheckpointTable& table, std::uint64_t first, std::span<const std::byte> rows) {
  const auto row_bytes = static_cast<std::size_t>(table.row_bytes), stride = static_cast<std::size_t>(table.stride());
  const std::size_t count = row_bytes > 0 ? rows.size() / row_bytes : 0;
  std::vector<std::byte> sealed(count * stride);
  for (std::size_t n = 0; n < count; ++n) {
    const auto row = rows.subspan(n * row_bytes, row_bytes);
    const std::uint64_t sum = row_checksum(table.name, first + n, row);
    std::byte* to = std::copy(row.begin(), row.end(), sealed.data() + n * stride);
    std::memcpy(to, &sum, sizeof sum);
  }
  return sealed;
}

void write_rows(SharedFile& file, const CheckpointTable& table, std::uint64_t first, std::span<const std::byte> rows) {
  const auto sealed = seal_rows(table, first, rows);
  file.write(table.offset + first * table.stride(), std::span<const std::byte>(sealed),
             static_cast<std::size_t>(table.stride()));
}

void write_bodies(SharedFile& file, const CheckpointDirectory& directory, const std::vector<BodyBlob>& bodies,
                  const Communicator& ranks) {
  std::uint64_t at = directory.bodies.end() + static_cast<std::uint64_t>(sum_before(ranks, total_size(bodies)));
  const std::uint64_t first_byte = at;
  std::vector<BodyEntry> entries;
  std::vector<std::byte> all;
  for (const auto& body : bodies) {
    entries.push_back({body.id, at, body.bytes.size(), checksum(body.bytes)});
    at += body.bytes.size();
    all.insert(all.end(), body.bytes.begin(), body.bytes.end());
  }
  const auto first = static_cast<std::uint64_t>(sum_before(ranks, static_cast<long>(bodies.size())));
  write_rows(file, directory.bodies, first, std::as_bytes(std::span(entries)));
  // MPI counts in int.
  constexpr std::size_t piece = std::size_t{1} << 30;
  const int n_pieces = ranks.max(static_cast<int>((all.size() + piece - 1) / piece));
  for (int n = 0; n < n_pieces; ++n) {
    const std::size_t begin = std::min(all.size(), static_cast<std::size_t>(n) * piece);
    const auto part = std::span<const std::byte>(all).subspan(begin, std::min(piece, all.size() - begin));
    file.write(first_byte + begin, part, 1);
  }
}

void write_file(const std::filesystem::path& path, const CheckpointHead& head, const FlowSolver& flow,
                const std::vector<BodyBlob>& bodies, const std::vector<StoredTable>& more) {
  const auto& ranks = flow.grid().ranks();
  auto tables = flow.state_tables();
  const std::size_t n_of_flow = tables.size();
  for (const auto& table : more) tables.push_back(table.shape);
  // All ranks go by the root's layout, whose head alone holds the state of the outputs.
  auto directory = plan(head, tables, ranks.sum(static_cast<long>(bodies.size())), ranks.sum(total_size(bodies)));
  const auto own = directory.encode();
  const auto encoded = ranks.broadcast({reinterpret_cast<const char*>(own.data()), own.size()});
  const auto bytes = std::as_bytes(std::span(encoded.data(), encoded.size()));
  constexpr auto preamble = CheckpointDirectory::preamble_size;
  directory = CheckpointDirectory::decode(bytes.first(preamble), bytes.subspan(preamble));

  do_on_root(ranks, [&] {
    PosixFile file(path);
    file.append(encoded);
    file.close();
    set_space_aside(path, directory.file_size());
  });
  SharedFile file(path, ranks);
  for (std::size_t t = 0; t < tables.size(); ++t) {
    std::vector<double> values(tables[t].size());
    if (t < n_of_flow) flow.save_table(t, values);
    else more[t - n_of_flow].save(values);
    write_rows(file, directory.tables[t], tables[t].first, std::as_bytes(std::span(values)));
  }
  write_bodies(file, directory, bodies, ranks);
  file.sync();
  file.close();
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const CheckpointHead& head, const FlowSolver& flow,
                      const std::vector<BodyBlob>& bodies, const std::vector<StoredTable>& more) {
  const auto& ranks = flow.grid().ranks();
  const auto temporary = temporary_name(path);
  try {
    do_on_root(ranks, [&] { std::filesystem::create_directories(path.parent_path()); });
    write_file(temporary, head, flow, bodies, more);
    do_on_root(ranks, [&] {
      bring_to_disk(temporary);
      rename_into_place(temporary, path);
      bring_to_disk(path.parent_path());
    });
  } catch (const RunError&) {
    if (ranks.is_root()) remove_quietly(temporary);
    throw;
  }
}

}  // namespace pliant
