#include "simulation/energy_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace pliant {

EnergyRecord::EnergyRecord(std::vector<std::string> parts) : parts_(std::move(parts)) { parts_.push_back("together"); }

void EnergyRecord::note(const std::vector<double>& energies) {
  last_ = energies;
  last_.push_back(std::accumulate(energies.begin(), energies.end(), 0.0));
  if (first_.empty()) first_ = most_ = last_;
  for (std::size_t n = 0; n < last_.size(); ++n) most_[n] = std::max(most_[n], last_[n]);
}

std::string EnergyRecord::describe() const {
  std::string text;
  for (std::size_t n = 0; n < first_.size(); ++n)
    text += fmt::format("{} {} {:.4g} at the start, {:.4g} at the end, {:.4g} at most", n == 0 ? "energy:" : ";",
                        parts_[n], first_[n], last_[n], most_[n]);
  return text;
}

Json EnergyRecord::results() const {
  auto all = Json::object();
  for (std::size_t n = 0; n < first_.size(); ++n)
    all[parts_[n]] = {{"first", first_[n]}, {"last", last_[n]}, {"largest", most_[n]}};
  return all;
}

void EnergyRecord::write(ByteWriter& out) const {
  for (const auto* values : {&first_, &last_, &most_}) out.write(*values);
}

void EnergyRecord::read(ByteReader& in) {
  for (auto* values : {&first_, &last_, &most_}) in.read(*values);
}

}  // namespace pliant
