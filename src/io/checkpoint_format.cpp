#include "io/checkpoint_format.hpp"

#include <fmt/format.h>

#include <cstring>

#include "core/byte_stream.hpp"
#include "io/checksum.hpp"

namespace pliant {
namespace {

constexpr std::array<char, 8> magic{'P', 'L', 'I', 'A', 'N', 'T', 'C', 'P'};
constexpr std::uint32_t format_version = 3;
constexpr std::uint32_t byte_order = 0x01020304;

struct Preamble {
  std::array<char, 8> magic;
  std::uint32_t version, byte_order;
  std::uint64_t directory_size, file_size;
  std::uint32_t directory_sum, preamble_sum;
};
static_assert(sizeof(Preamble) == CheckpointDirectory::preamble_size);

std::uint32_t sum_of(const Preamble& preamble) {
  return checksum(std::as_bytes(std::span(&preamble, 1)).first(offsetof(Preamble, preamble_sum)));
}

void write(ByteWriter& out, const CheckpointTable& table) {
  out.write(table.name);
  out.write(table.offset);
  out.write(table.rows);
  out.write(table.row_bytes);
}

CheckpointTable read_table(ByteReader& in) {
  CheckpointTable table;
  in.read(table.name);
  in.read(table.offset);
  in.read(table.rows);
  in.read(table.row_bytes);
  return table;
}

std::vector<std::byte> encode_directory(const CheckpointDirectory& directory) {
  ByteWriter out;
  const auto& head = directory.head;
  out.write(static_cast<std::int64_t>(head.step));
  out.write(head.time);
  out.write(head.ranks);
  out.write(head.program);
  out.write(head.case_text);
  out.write(head.run);
  out.write(head.flow);
  out.write(head.outputs);
  out.write(static_cast<std::uint64_t>(directory.tables.size()));
  for (const auto& table : directory.tables) write(out, table);
  write(out, directory.bodies);
  out.write(directory.body_bytes);
  return out.take();
}

}  // namespace

void CheckpointDirectory::set_offsets() {
  std::uint64_t at = preamble_size + encode_directory(*this).size();
  for (auto& table : tables) {
    table.offset = at;
    at = table.end();
  }
  bodies.offset = at;
}

std::vector<std::byte> CheckpointDirectory::encode() const {
  const auto directory = encode_directory(*this);
  Preamble preamble{magic, format_version, byte_order, directory.size(), file_size(), checksum(directory), 0};
  preamble.preamble_sum = sum_of(preamble);
  std::vector<std::byte> bytes(preamble_size + directory.size());
  std::memcpy(bytes.data(), &preamble, preamble_size);
  std::memcpy(bytes.data() + preamble_size, directory.data(), directory.size());
  return bytes;
}

std::size_t CheckpointDirectory::check_preamble(std::span<const std::byte> bytes, std::uint64_t file_size) {
  Preamble preamble{};
  const bool is_long_enough = bytes.size() >= preamble_size;
  if (is_long_enough) std::memcpy(&preamble, bytes.data(), preamble_size);
  if (!is_long_enough || preamble.magic != magic) throw CheckpointRefused("is not a checkpoint of Pliant");
  if (preamble.byte_order != byte_order) throw CheckpointRefused("was written by a machine with another byte order");
  if (preamble.version != format_version)
    throw CheckpointRefused(fmt::format("has version {} of the format of checkpoints; this program reads version {}",
                                        preamble.version, format_version));
  if (preamble.preamble_sum != sum_of(preamble)) throw CheckpointRefused("is damaged: its first bytes have changed");
  if (preamble.file_size != file_size)
    throw CheckpointRefused(fmt::format("is damaged: it has {} bytes instead of {}", file_size, preamble.file_size));
  return static_cast<std::size_t>(preamble.directory_size);
}

CheckpointDirectory CheckpointDirectory::decode(std::span<const std::byte> preamble_bytes,
                                                std::span<const std::byte> bytes) {
  Preamble preamble{};
  std::memcpy(&preamble, preamble_bytes.data(), preamble_size);
  if (checksum(bytes) != preamble.directory_sum) throw CheckpointRefused("is damaged: its directory has changed");
  CheckpointDirectory directory;
  try {
    ByteReader in(bytes);
    auto& head = directory.head;
    head.step = static_cast<long>(in.read<std::int64_t>());
    in.read(head.time);
    in.read(head.ranks);
    in.read(head.program);
    in.read(head.case_text);
    in.read(head.run);
    in.read(head.flow);
    in.read(head.outputs);
    const auto n_tables = in.read<std::uint64_t>();
    for (std::uint64_t t = 0; t < n_tables; ++t) directory.tables.push_back(read_table(in));
    directory.bodies = read_table(in);
    in.read(directory.body_bytes);
    in.expect_end();
  } catch (const ByteStreamError& error) {
    throw CheckpointRefused(fmt::format("has a directory that cannot be read: {}", error.what()));
  }
  if (directory.file_size() != preamble.file_size) throw CheckpointRefused("has a directory that contradicts its size");
  return directory;
}

std::uint64_t row_checksum(const std::string& table, std::uint64_t row, std::span<const std::byte> bytes) {
  const auto name = checksum(std::as_bytes(std::span(table.data(), table.size())));
  return checksum(bytes, checksum(std::as_bytes(std::span(&row, 1)), name));
}

}  // namespace pliant
