#include "simulation/outputs.hpp"

#include <algorithm>

#include "io/atomic_file.hpp"
#include "parallel/agree.hpp"
#include "simulation/surface_batch.hpp"

namespace pliant {
namespace {

std::vector<double> to_row(Moment moment, const HistoryRow& row) {
  std::vector<double> values{static_cast<double>(moment.step),
                             moment.time,
                             row.dt,
                             row.cfl,
                             row.divergence,
                             row.kinetic_energy,
                             row.bulk_velocity.x,
                             row.bulk_velocity.y,
                             row.bulk_velocity.z,
                             row.bulk_forcing,
                             static_cast<double>(row.coupling_iterations)};
  values.insert(values.end(), row.patch_flow_rates.begin(), row.patch_flow_rates.end());
  return values;
}

std::vector<std::string> history_columns(const CaseConfig& config) {
  std::vector<std::string> columns{"step",   "time",   "dt",     "cfl",          "divergence",         "kinetic_energy",
                                   "bulk_u", "bulk_v", "bulk_w", "bulk_forcing", "coupling_iterations"};
  for (const auto& side : config.boundary)
    if (const auto* patches = patches_of(side))
      for (const auto& patch : *patches) columns.push_back("flow_" + patch.name);
  return columns;
}

}  // namespace

Outputs::Outputs(const std::filesystem::path& folder, const CaseConfig& config, const Grid& grid, const Bodies& bodies,
                 const Cavities& cavities, const OutputsState* resumed)
    : folder_(folder),
      ranks_(grid.ranks()),
      history_(config.output.history),
      fields_due_(config.output.fields, config.output.period),
      surfaces_due_(config.output.surfaces, config.output.period),
      centered_(std::make_shared<CenteredFlow>(grid, config.boundary)),
      with_vorticity_(config.output.fields.vorticity),
      fields_(folder, "fields", "fields", grid) {
  for (const auto& kind : bodies.kinds()) {
    const auto& mesh = kind.prototype.mesh;
    const auto faces = mesh.vertices_of_face();
    surfaces_.emplace_back(folder, kind.config.name, std::vector<Face>(faces.begin(), faces.end()), mesh.n_vertices(),
                           ranks_);
  }
  do_on_root(ranks_, [&] {
    history_table_ = make_table("history.csv", history_columns(config), resumed);
    if (bodies.count() > 0) std::filesystem::create_directories(folder / "bodies");
    if (cavities.any()) std::filesystem::create_directories(folder / "cavities");
    for (std::size_t n = 0; n < cavities.size(); ++n) {
      auto columns = cavities.columns(n);
      columns.insert(columns.begin(), {"step", "time"});
      cavity_tables_.push_back(make_table("cavities/" + cavities.config(n).name + ".csv", std::move(columns), resumed));
    }
    if (resumed != nullptr) resume(*resumed);
  });
  body_tables_.emplace(bodies, ranks_, [&](const std::string& file, std::vector<std::string> columns) {
    return make_table(file, std::move(columns), resumed);
  });
  if (resumed == nullptr) return;
  last_history_ = resumed->last_history;
  last_fields_ = resumed->last_fields;
  last_surfaces_ = resumed->last_surfaces;
}

std::unique_ptr<CsvWriter> Outputs::make_table(const std::string& file, std::vector<std::string> columns,
                                               const OutputsState* resumed) const {
  if (resumed == nullptr || !resumed->tables.contains(file))
    return std::make_unique<CsvWriter>(folder_ / file, std::move(columns));
  return std::make_unique<CsvWriter>(folder_ / file, std::move(columns), resumed->tables.at(file));
}

void Outputs::resume(const OutputsState& state) {
  const auto resume_series = [&](XdmfSeries& series) {
    const auto known = state.series.find(series.path().filename().string());
    series.resume(known == state.series.end() ? 0 : static_cast<std::size_t>(known->second));
  };
  resume_series(fields_.series());
  for (auto& surface : surfaces_) resume_series(surface.series());
}

OutputsState Outputs::state() const {
  OutputsState state;
  if (history_table_) state.tables["history.csv"] = history_table_->size();
  for (const auto& table : body_tables_->tables())
    state.tables["bodies/" + table->path().filename().string()] = table->size();
  for (const auto& table : cavity_tables_)
    state.tables["cavities/" + table->path().filename().string()] = table->size();
  const auto add_series = [&](const XdmfSeries& series) {
    state.series[series.path().filename().string()] = series.size();
  };
  add_series(fields_.series());
  for (const auto& surface : surfaces_) add_series(surface.series());
  state.last_history = last_history_;
  state.last_fields = last_fields_;
  state.last_surfaces = last_surfaces_;
  return state;
}

void Outputs::bring_to_disk() const {
  const auto state = this->state();
  for (const auto& [file, size] : state.tables) pliant::bring_to_disk(folder_ / file);
  for (const auto& [file, count] : state.series)
    if (count > 0) pliant::bring_to_disk(folder_ / file);
}

double Outputs::next_time(double time) const {
  return std::min(fields_due_.next_time(time), surfaces_due_.next_time(time));
}

bool Outputs::write_history(Moment moment, const HistoryRow& row, const Bodies& bodies, const Cavities& cavities) {
  if (moment.step == last_history_) return false;
  last_history_ = moment.step;
  do_on_root(ranks_, [&] {
    history_table_->write_row(to_row(moment, row));
    for (std::size_t n = 0; n < cavity_tables_.size(); ++n) {
      auto line = cavities.row(n);
      line.insert(line.begin(), {static_cast<double>(moment.step), moment.time});
      cavity_tables_[n]->write_row(line);
    }
  });
  body_tables_->write(moment, bodies);
  return true;
}

bool Outputs::is_due(const Schedule& schedule, Moment moment, Urgency urgency) const {
  return urgency == Urgency::last ? schedule.is_wanted() : schedule.is_due(moment.step, moment.time);
}

bool Outputs::has_surfaces_due(Moment moment, Urgency urgency) const {
  return is_due(surfaces_due_, moment, urgency) && last_surfaces_ != moment.step && !surfaces_.empty();
}

bool Outputs::write_snapshots(Moment moment, const FlowSolver& flow, const Bodies& bodies, Urgency urgency) {
  const bool fields = is_due(fields_due_, moment, urgency) && last_fields_ != moment.step;
  const bool surfaces = has_surfaces_due(moment, urgency);
  if (fields) write_fields(moment, flow);
  if (surfaces) write_surfaces(moment, bodies);
  return fields || surfaces;
}

void Outputs::write_evidence(Moment moment, const FlowSolver& flow, const Bodies& bodies) {
  if (last_fields_ != moment.step) write_fields(moment, flow);
  if (last_surfaces_ != moment.step) write_surfaces(moment, bodies);
}

void Outputs::write_fields(Moment moment, const FlowSolver& flow) {
  fields_.write(flow_quantities(flow.state(), flow.parameters().density, centered_, with_vorticity_), moment);
  last_fields_ = moment.step;
}

void Outputs::write_surfaces(Moment moment, const Bodies& bodies) {
  for (std::size_t k = 0; k < surfaces_.size(); ++k) surfaces_[k].write(surface_batch(bodies, k), moment);
  last_surfaces_ = moment.step;
}

}  // namespace pliant
