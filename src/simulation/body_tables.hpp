#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "coupling/bodies.hpp"
#include "io/csv_writer.hpp"
#include "io/field_writer.hpp"

namespace pliant {

/// The tables OUT/bodies/<name>.csv, one a [[body]]; copies share one, a line each.
class BodyTables {
 public:
  using MakeTable =
      std::function<std::unique_ptr<CsvWriter>(const std::string& file, std::vector<std::string> columns)>;

  /// `make` is called on the root. Collective. Throws CollectiveError.
  BodyTables(const Bodies& bodies, const Communicator& ranks, const MakeTable& make);

  /// A line for every body of all ranks. Collective. Throws CollectiveError.
  void write(Moment moment, const Bodies& bodies);
  /// The kinetic and potential energy of all copies in these lines, by kind; 0 of bodies that do not deform. On every
  /// rank.
  const std::vector<double>& energies() const { return energies_; }

  /// On the root.
  const std::vector<std::unique_ptr<CsvWriter>>& tables() const { return tables_; }

 private:
  Communicator ranks_;
  std::vector<std::size_t> widths_;  // by kind
  std::vector<std::vector<std::size_t>> energy_columns_;
  std::vector<double> energies_;
  std::vector<std::unique_ptr<CsvWriter>> tables_;
};

}  // namespace pliant
