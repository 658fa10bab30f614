#include "simulation/phase_average.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/field_writer.hpp"
#include "simulation/cycles.hpp"

namespace pliant {
namespace {

std::size_t numbers_of_cell(bool with_vorticity) { return with_vorticity ? 7 : 4; }

}  // namespace

double phase_average_bytes_per_cell(const OutputConfig& config) {
  if (!config.phase_average) return 0;
  constexpr int kept = 1;  // bins, for the way back
  return 8.0 * (config.phase_average->bins + kept) * static_cast<double>(numbers_of_cell(config.fields.vorticity));
}

PhaseAverage::PhaseAverage(const PhaseAverageConfig& config, double period, bool with_vorticity, const Grid& grid,
                           const BoundaryConfig& boundary, double density)
    : config_(config),
      period_(period),
      n_numbers_(numbers_of_cell(with_vorticity)),
      grid_(grid),
      centered_(grid, boundary),
      density_(density),
      sums_(static_cast<std::size_t>(config.bins), Sums(n_numbers_ * cell(0, 0, grid.nz()), 0.0)),
      weights_(static_cast<std::size_t>(config.bins), 0.0),
      kept_weights_(weights_) {}

std::size_t PhaseAverage::cell(int i, int j, int k) const {
  return static_cast<std::size_t>(i) +
         static_cast<std::size_t>(grid_.nx()) *
             (static_cast<std::size_t>(j) + static_cast<std::size_t>(grid_.ny()) * static_cast<std::size_t>(k));
}

void PhaseAverage::add(double time, const FlowState& state) {
  const double weight = time - std::max(last_time_, config_.from);
  last_time_ = time;
  if (!(weight > 0)) return;
  const auto bin =
      std::min(static_cast<std::size_t>(cycle_time(time, period_).phase * config_.bins + 1e-9), weights_.size() - 1);
  auto& sums = sums_[bin];
  if (is_keeping_) kept_sums_.try_emplace(bin, sums);
  weights_[bin] += weight;
  double* at = sums.data();
  const auto put = [&](Vec3 v) {
    for (int d = 0; d < 3; ++d) *at++ += weight * v[d];
  };
  const auto p = state.p.view();
  for (int k = 0; k < grid_.nz(); ++k)
    for (int j = 0; j < grid_.ny(); ++j)
      for (int i = 0; i < grid_.nx(); ++i) {
        put(centered_.velocity(state, i, j, k));
        *at++ += weight * density_ * p(i, j, k);
        if (n_numbers_ > 4) put(centered_.vorticity(state, i, j, k));
      }
}

Vec3 PhaseAverage::mean(std::size_t bin, std::size_t cell, std::size_t first) const {
  const double* at = sums_[bin].data() + n_numbers_ * cell + first;
  return Vec3{at[0], at[1], at[2]} / weights_[bin];
}

void PhaseAverage::write_files(const std::filesystem::path& output) const {
  FieldWriter writer(output, "phase_average", "phase_average", grid_);
  for (std::size_t bin = 0; bin < weights_.size(); ++bin) {
    if (!(weights_[bin] > 0)) continue;
    const auto vector = [this, bin](std::size_t first) {
      return [this, bin, first](int i, int j, int k, double* out) {
        const Vec3 v = mean(bin, cell(i, j, k), first);
        for (int d = 0; d < 3; ++d) out[d] = v[d];
      };
    };
    std::vector<CellQuantity> quantities{{"velocity", 3, vector(0)},
                                         {"pressure", 1, [this, bin](int i, int j, int k, double* out) {
                                            *out = sums_[bin][n_numbers_ * cell(i, j, k) + 3] / weights_[bin];
                                          }}};
    if (n_numbers_ > 4) quantities.push_back({"vorticity", 3, vector(4)});
    const double middle = (static_cast<double>(bin) + 0.5) / config_.bins * period_;
    writer.write(quantities, {static_cast<long>(bin), middle});
  }
}

void PhaseAverage::keep() {
  is_keeping_ = true;
  kept_sums_.clear();
  kept_weights_ = weights_;
  kept_time_ = last_time_;
}

void PhaseAverage::roll_back() {
  for (auto& [bin, sums] : kept_sums_) sums_[bin] = sums;
  kept_sums_.clear();
  weights_ = kept_weights_;
  last_time_ = kept_time_;
}

void PhaseAverage::write(ByteWriter& out) const {
  out.write(period_);
  out.write(static_cast<std::uint64_t>(n_numbers_));
  out.write(weights_);
  out.write(last_time_);
}

bool PhaseAverage::read(ByteReader& in) {
  const auto period = in.read<double>();
  const auto n_numbers = in.read<std::uint64_t>();
  const auto weights = in.read_vector<double>();
  const auto last_time = in.read<double>();
  if (period != period_ || n_numbers != n_numbers_ || weights.size() != weights_.size()) return false;
  weights_ = weights;
  last_time_ = last_time;
  return true;
}

std::vector<StoredTable> PhaseAverage::tables() {
  std::vector<StoredTable> tables;
  for (std::size_t bin = 0; bin < sums_.size(); ++bin) {
    RowTable shape;
    shape.name = fmt::format("phase_average_{}", bin);
    shape.rows = static_cast<std::uint64_t>(grid_.cells()[2]);
    shape.first = static_cast<std::uint64_t>(grid_.slab().begin);
    shape.count = static_cast<std::uint64_t>(grid_.nz());
    shape.row_size = n_numbers_ * cell(0, 0, 1);
    tables.push_back(
        {std::move(shape),
         [this, bin](std::span<double> to) { std::copy(sums_[bin].begin(), sums_[bin].end(), to.begin()); },
         [this, bin](std::span<const double> from) { std::copy(from.begin(), from.end(), sums_[bin].begin()); }});
  }
  return tables;
}

}  // namespace pliant
