#include "io/checksum.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <fstream>

#include "core/error.hpp"

namespace pliant {

std::uint32_t checksum(std::span<const std::byte> bytes, std::uint32_t start) {
  return static_cast<std::uint32_t>(crc32_z(start, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::uint32_t checksum_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 65536> buffer{};
  std::uint32_t sum = 0;
  while (file) {
    file.read(buffer.data(), buffer.size());
    sum = checksum(std::as_bytes(std::span(buffer)).first(static_cast<std::size_t>(file.gcount())), sum);
  }
  if (!file.eof()) throw RunError(fmt::format("cannot read {}", path.string()));
  return sum;
}

}  // namespace pliant
