#pragma once
#include <filesystem>

#include "core/body_blob.hpp"
#include "flow/flow_solver.hpp"
#include "io/checkpoint_format.hpp"
#include "io/stored_table.hpp"

namespace pliant {

/// A checkpoint that all ranks read, each its own part. All functions are collective, and what one rank finds wrong is
/// a CheckpointRefused on all, whose text continues a sentence that begins with the file's name.
class CheckpointReader {
 public:
  /// Reads preamble and directory.
  CheckpointReader(const std::filesystem::path& path, const Communicator& ranks);
  ~CheckpointReader();
  CheckpointReader(const CheckpointReader&) = delete;
  CheckpointReader& operator=(const CheckpointReader&) = delete;

  const CheckpointHead& head() const { return directory_.head; }

  /// Reads every byte once and compares all checksums; keeps nothing.
  void verify();
  /// Sets the state of the flow, ghosts included.
  void restore(FlowSolver& flow);
  /// Loads tables beside those of the flow.
  void restore(const std::vector<StoredTable>& more);
  /// A share of the bodies for each rank, by their places in the file: all ranks together get each body once.
  std::vector<BodyBlob> read_bodies();

 private:
  template <class Work>
  void together(Work work) const;
  std::vector<double> read_table(const CheckpointTable& kept, const RowTable& mine) const;
  std::vector<std::byte> read_rows(const CheckpointTable& table, std::uint64_t first, std::uint64_t count) const;
  std::vector<BodyBlob> read_my_bodies() const;
  void read_at(std::uint64_t offset, std::span<std::byte> bytes) const;

  Communicator ranks_;
  int descriptor_ = -1;
  CheckpointDirectory directory_;
};

}  // namespace pliant
