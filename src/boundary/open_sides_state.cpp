#include <algorithm>

#include "boundary/open_sides.hpp"

namespace pliant {

void OpenSides::save(Snapshot& snapshot) const {
  snapshot.values.clear();
  for (const Side& side : sides_)
    for (const auto& values : side.values) snapshot.values.insert(snapshot.values.end(), values.begin(), values.end());
  snapshot.mean_outwards = mean_outwards();
}

void OpenSides::restore(const Snapshot& snapshot) {
  // In place: the ghost rules point into these values.
  auto from = snapshot.values.begin();
  for (Side& side : sides_)
    for (auto& values : side.values) {
      std::copy_n(from, values.size(), values.begin());
      from += static_cast<std::ptrdiff_t>(values.size());
    }
  for (std::size_t s = 0; s < sides_.size(); ++s) sides_[s].mean_outward = snapshot.mean_outwards[s];
}

std::vector<RowTable> OpenSides::tables() const {
  std::vector<RowTable> tables;
  const auto slab = grid_.slab();
  for (const Side& side : sides_)
    for (int c = 0; c < 3; ++c) {
      RowTable table;
      table.name = {"xyz"[side.direction()], "-+"[side.number % 2], ' ', "uvw"[c]};
      table.row_size = static_cast<std::size_t>(side.na);
      // Sides of x and y are cut into slabs as the fields are; those of z belong to one rank.
      const bool is_cut = side.direction() != 2;
      table.rows = static_cast<std::uint64_t>(is_cut ? grid_.cells()[2] : side.nb);
      table.first = static_cast<std::uint64_t>(is_cut ? slab.begin : 0);
      table.count = static_cast<std::uint64_t>(side.here ? side.nb : 0);
      tables.push_back(std::move(table));
    }
  return tables;
}

void OpenSides::save_table(std::size_t t, double* values) const {
  const Side& side = sides_[t / 3];
  if (!side.here) return;
  for (int b = 0; b < side.nb; ++b) values = std::copy_n(side.values[t % 3].data() + side.index(0, b), side.na, values);
}

void OpenSides::load_table(std::size_t t, const double* values) {
  Side& side = sides_[t / 3];
  if (!side.here) return;
  for (int b = 0; b < side.nb; ++b, values += side.na)
    std::copy_n(values, side.na, side.values[t % 3].data() + side.index(0, b));
}

std::vector<double> OpenSides::mean_outwards() const {
  std::vector<double> means;
  for (const Side& side : sides_) means.push_back(side.mean_outward);
  return means;
}

void OpenSides::finish_loading(const std::vector<double>& means) {
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    extend(sides_[s]);
    sides_[s].mean_outward = means.at(s);
  }
}

}  // namespace pliant
