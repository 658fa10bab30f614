#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace pliant {

/// Why a file is not taken as a checkpoint: an end of a sentence that begins with the file's name.
class CheckpointRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a checkpoint holds beside the large tables, the same on all ranks.
struct CheckpointHead {
  long step = 0;
  double time = 0;
  int ranks = 1;               ///< of the run that wrote it
  std::string program;         ///< version and commit, for people
  std::string case_text;       ///< what a run that continues must agree with, as JSON
  std::vector<std::byte> run;  ///< the time loop's own numbers
  std::vector<std::byte> flow;
  std::vector<std::byte> outputs;  ///< how far the output files had grown; counts on the root
};

/// A table of a checkpoint. In the file every row is followed by its checksum, see row_checksum.
struct CheckpointTable {
  std::string name;
  std::uint64_t offset = 0;  ///< of the first row, bytes from the start of the file
  std::uint64_t rows = 0;
  std::uint64_t row_bytes = 0;  ///< without the checksum

  std::uint64_t stride() const { return row_bytes + sizeof(std::uint64_t); }
  std::uint64_t end() const { return offset + rows * stride(); }
};

/// A row of the table of bodies: where a body's bytes stand.
struct BodyEntry {
  std::int64_t id = 0;
  std::uint64_t offset = 0;  ///< from the start of the file
  std::uint64_t size = 0;
  std::uint64_t sum = 0;  ///< checksum of the bytes
};

/// Everything in a checkpoint but the contents of the tables and the bodies' bytes.
///
/// The file is: a preamble of preamble_size bytes (magic text, format version, byte order, sizes, checksums), the
/// directory, the tables, the bodies' bytes. Numbers are in the machine's own representation.
struct CheckpointDirectory {
  CheckpointHead head;
  std::vector<CheckpointTable> tables;
  CheckpointTable bodies;        ///< of BodyEntry
  std::uint64_t body_bytes = 0;  ///< behind the table of bodies

  std::uint64_t file_size() const { return bodies.end() + body_bytes; }
  /// Lays the tables out behind the directory, whose size does not depend on the offsets.
  void set_offsets();
  /// Preamble and directory: the first bytes of the file.
  std::vector<std::byte> encode() const;

  static constexpr std::size_t preamble_size = 40;
  /// The size of the directory that follows this preamble. `file_size` is what the file really has. Throws
  /// CheckpointRefused: not a checkpoint, of another version or machine, damaged, cut.
  static std::size_t check_preamble(std::span<const std::byte> preamble, std::uint64_t file_size);
  /// The directory from its bytes and the preamble before them. Throws CheckpointRefused.
  static CheckpointDirectory decode(std::span<const std::byte> preamble, std::span<const std::byte> directory);
};

/// Checksum of a row with its table's name and number, so that a row in another's place is noticed.
std::uint64_t row_checksum(const std::string& table, std::uint64_t row, std::span<const std::byte> bytes);

}  // namespace pliant
