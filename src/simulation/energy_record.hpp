#pragma once
#include <string>
#include <vector>

#include "config/value_codec.hpp"
#include "core/byte_stream.hpp"

namespace pliant {

/// The energy of the fluid and of deformable bodies at the first line of the history, at the last, and at most: whether
/// a run without driving gains any.
class EnergyRecord {
 public:
  /// A number for each part, all parts at once; the sum of them is followed as well.
  explicit EnergyRecord(std::vector<std::string> parts);

  void note(const std::vector<double>& energies);
  /// A line for people; empty before anything was noted.
  std::string describe() const;
  Json results() const;

  /// What a checkpoint needs.
  void write(ByteWriter& out) const;
  void read(ByteReader& in);

 private:
  std::vector<std::string> parts_;  // "together" the last
  std::vector<double> first_, last_, most_;
};

}  // namespace pliant
