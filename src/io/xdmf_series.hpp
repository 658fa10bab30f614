#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace pliant {

/// An XDMF file that lists the snapshots of one quantity over time: the file that ParaView opens.
/// Not collective: the root alone has one.
class XdmfSeries {
 public:
  /// `path` is the .xdmf file; the grids refer to HDF5 files relative to its folder.
  XdmfSeries(std::filesystem::path path, std::string name);

  /// Adds a snapshot and rewrites the file in one piece. `body` is the XML between <Grid> and </Grid> without the time.
  /// Throws RunError.
  void add(double time, std::string body);

  std::size_t size() const { return snapshots_.size(); }
  const std::filesystem::path& path() const { return path_; }
  /// Continues the series that is there after its first `count` snapshots; the file then lists no others. Throws
  /// RunError if it has fewer.
  void resume(std::size_t count);

 private:
  void write() const;
  struct Snapshot {
    double time;
    std::string body;
  };
  std::filesystem::path path_;
  std::string name_;
  std::vector<Snapshot> snapshots_;
};

/// What XML needs in place of its own signs, for names that come from a user.
std::string escape_xml(const std::string& text);

/// An XDMF reference to a data set: dimensions "4 3", "Float" or "Int", bytes a number, "fields/a.h5:/velocity".
std::string xdmf_item(const std::string& dimensions, const char* type, int bytes, const std::string& place);

}  // namespace pliant
