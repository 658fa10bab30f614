#include "simulation/body_tables.hpp"

#include "parallel/agree.hpp"
#include "parallel/pass_to_root.hpp"
#include "simulation/body_rows.hpp"

namespace pliant {

BodyTables::BodyTables(const Bodies& bodies, const Communicator& ranks, const MakeTable& make) : ranks_(ranks) {
  std::vector<std::vector<std::string>> columns;
  for (std::size_t k = 0; k < bodies.kinds().size(); ++k) {
    columns.push_back(body_columns(bodies.kinds()[k], bodies.count(k)));
    widths_.push_back(columns.back().size());
    energy_columns_.emplace_back();
    for (std::size_t c = 0; c < columns.back().size(); ++c)
      if (const auto& name = columns.back()[c]; name == "kinetic_energy" || name.starts_with("energy_"))
        energy_columns_.back().push_back(c);
    columns.back().insert(columns.back().begin(), {"step", "time"});
  }
  do_on_root(ranks_, [&] {
    for (std::size_t k = 0; k < columns.size(); ++k)
      tables_.push_back(make("bodies/" + bodies.kinds()[k].config.name + ".csv", columns[k]));
  });
}

// Each line travels with the number of its kind in front.
void BodyTables::write(Moment moment, const Bodies& bodies) {
  if (widths_.empty()) return;
  std::vector<double> mine;
  energies_.assign(widths_.size(), 0.0);
  for (const Body& body : bodies.own()) {
    const auto row = body_row(body, bodies.kind_of(body), bodies.is_on(body), body.id - bodies.first_id(body.kind),
                              bodies.count(body.kind));
    for (const auto c : energy_columns_[body.kind]) energies_[body.kind] += row[c];
    mine.push_back(static_cast<double>(body.kind));
    mine.insert(mine.end(), row.begin(), row.end());
  }
  ranks_.sum(energies_);
  pass_to_root(ranks_, mine, [&](const std::vector<double>& numbers) {
    for (std::size_t at = 0; at < numbers.size();) {
      const auto kind = static_cast<std::size_t>(numbers[at]);
      const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(at) + 1;
      std::vector<double> line{static_cast<double>(moment.step), moment.time};
      line.insert(line.end(), begin, begin + static_cast<std::ptrdiff_t>(widths_[kind]));
      tables_[kind]->write_row(line);
      at += 1 + widths_[kind];
    }
  });
}

}  // namespace pliant
