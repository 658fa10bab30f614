#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace pliant {

/// How far the output files of a run have grown: what a run that continues cuts them back to. Files are named by their
/// paths in the output folder.
struct OutputsState {
  std::map<std::string, std::int64_t> tables;                    ///< bytes of each CSV file
  std::map<std::string, std::uint64_t> series;                   ///< snapshots of each XDMF file
  long last_history = -1, last_fields = -1, last_surfaces = -1;  ///< steps; -1: none yet

  std::vector<std::byte> encode() const;
  /// Throws ByteStreamError.
  static OutputsState decode(std::span<const std::byte> bytes);
};

}  // namespace pliant
