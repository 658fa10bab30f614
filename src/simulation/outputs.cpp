#include "simulation/outputs.hpp"

#include <algorithm>

#include "io/agree.hpp"

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
                             row.bulk_forcing};
  values.insert(values.end(), row.patch_flow_rates.begin(), row.patch_flow_rates.end());
  return values;
}

std::vector<std::string> history_columns(const BoundaryConfig& boundary) {
  std::vector<std::string> columns{"step",           "time",   "dt",     "cfl",    "divergence",
                                   "kinetic_energy", "bulk_u", "bulk_v", "bulk_w", "bulk_forcing"};
  for (const auto& side : boundary)
    if (const auto* patches = patches_of(side))
      for (const auto& patch : *patches) columns.push_back("flow_" + patch.name);
  return columns;
}

}  // namespace

Outputs::Outputs(const std::filesystem::path& folder, const CaseConfig& config, const Grid& grid, const Bodies& bodies)
    : ranks_(grid.ranks()),
      history_(config.output.history),
      fields_due_(config.output.fields),
      surfaces_due_(config.output.surfaces),
      fields_(folder, grid) {
  for (const auto& body : bodies.all()) {
    const auto faces = body.mesh.vertices_of_face();
    surfaces_.emplace_back(folder, body.name, std::vector<Face>(faces.begin(), faces.end()), ranks_);
  }
  do_on_root(ranks_, [&] {
    history_table_.emplace(folder / "history.csv", history_columns(config.boundary));
    if (bodies.size() > 0) std::filesystem::create_directories(folder / "bodies");
    for (std::size_t b = 0; b < bodies.size(); ++b)
      body_tables_.push_back(
          std::make_unique<CsvWriter>(folder / "bodies" / (bodies.all()[b].name + ".csv"), bodies.columns(b)));
  });
}

double Outputs::next_time(double time) const {
  return std::min(fields_due_.next_time(time), surfaces_due_.next_time(time));
}

void Outputs::write_history(Moment moment, const HistoryRow& row, const Bodies& bodies) {
  if (moment.step == last_history_) return;
  last_history_ = moment.step;
  do_on_root(ranks_, [&] {
    history_table_->write_row(to_row(moment, row));
    for (std::size_t b = 0; b < bodies.size(); ++b) body_tables_[b]->write_row(bodies.row(b, moment));
  });
}

bool Outputs::write_snapshots(Moment moment, const FlowSolver& flow, const Bodies& bodies, Urgency urgency) {
  const auto is_due = [&](const Schedule& schedule) {
    return urgency == Urgency::last ? schedule.is_wanted() : schedule.is_due(moment.step, moment.time);
  };
  const bool fields = is_due(fields_due_) && last_fields_ != moment.step;
  const bool surfaces = is_due(surfaces_due_) && last_surfaces_ != moment.step && bodies.size() > 0;
  if (fields) write_fields(moment, flow);
  if (surfaces) write_surfaces(moment, bodies);
  return fields || surfaces;
}

void Outputs::write_evidence(Moment moment, const FlowSolver& flow, const Bodies& bodies) {
  if (last_fields_ != moment.step) write_fields(moment, flow);
  if (last_surfaces_ != moment.step) write_surfaces(moment, bodies);
}

void Outputs::write_fields(Moment moment, const FlowSolver& flow) {
  fields_.write(flow.state(), flow.parameters().density, moment);
  last_fields_ = moment.step;
}

void Outputs::write_surfaces(Moment moment, const Bodies& bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b) surfaces_[b].write(bodies.snapshot(b), moment);
  last_surfaces_ = moment.step;
}

}  // namespace pliant
