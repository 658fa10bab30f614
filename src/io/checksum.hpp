#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace pliant {

/// CRC-32 of bytes (zlib's); `start` continues from the checksum of what stood before.
std::uint32_t checksum(std::span<const std::byte> bytes, std::uint32_t start = 0);

/// CRC-32 of a file's contents. Throws RunError if it cannot be read.
std::uint32_t checksum_of_file(const std::filesystem::path& path);

}  // namespace pliant
