#include "flow/flow_record.hpp"

#include <algorithm>

#include "core/byte_stream.hpp"

namespace pliant {
namespace {

constexpr std::size_t n_fields = 4;

// A field with all its ghosts is one piece of memory.
template <class Location, class Value>
std::span<Value> all_of(const Field<Location>& shape, View<Location, Value> f) {
  Value* begin = &f(-1, -1, -1);
  return {begin, &f(shape.nx(), shape.ny(), shape.nz()) + 1};
}

template <class Location>
void save_field(const Field<Location>& field, std::vector<double>& kept) {
  const auto all = all_of(field, field.view());
  kept.assign(all.begin(), all.end());
}

template <class Location>
void restore_field(const std::vector<double>& kept, Field<Location>& field) {
  std::copy(kept.begin(), kept.end(), all_of(field, field.view()).begin());
}

template <class Location, class Copy>
void for_rows_of(const Field<Location>& shape, View<Location> f, Copy copy) {
  for (int k = 0; k < shape.nz(); ++k)
    for (int j = 0; j < shape.ny(); ++j) copy(f.at_row(j, k), shape.nx());
}

template <class Copy>
void for_rows_of_table(FlowState& state, std::size_t t, Copy copy) {
  if (t == 0) for_rows_of(state.u, state.u.view(), copy);
  else if (t == 1) for_rows_of(state.v, state.v.view(), copy);
  else if (t == 2) for_rows_of(state.w, state.w.view(), copy);
  else for_rows_of(state.p, state.p.view(), copy);
}

}  // namespace

void FlowRecord::save(FlowSnapshot& snapshot) const {
  const FlowState& now = state;
  save_field(now.u, snapshot.u);
  save_field(now.v, snapshot.v);
  save_field(now.w, snapshot.w);
  save_field(now.p, snapshot.p);
  open.save(snapshot.open);
  snapshot.time = time;
  snapshot.forcing = forcing;
  snapshot.rate = rate;
}

void FlowRecord::restore(const FlowSnapshot& snapshot) {
  restore_field(snapshot.u, state.u);
  restore_field(snapshot.v, state.v);
  restore_field(snapshot.w, state.w);
  restore_field(snapshot.p, state.p);
  open.restore(snapshot.open);
  time = snapshot.time;
  forcing = snapshot.forcing;
  rate = snapshot.rate;
}

std::vector<RowTable> FlowRecord::tables() const {
  const auto slab = grid.slab();
  std::vector<RowTable> tables;
  for (const char* name : {"u", "v", "w", "p"})
    tables.push_back({name, static_cast<std::uint64_t>(grid.cells()[2]), static_cast<std::uint64_t>(slab.begin),
                      static_cast<std::uint64_t>(slab.count),
                      static_cast<std::size_t>(grid.nx()) * static_cast<std::size_t>(grid.ny())});
  const auto sides = open.tables();
  tables.insert(tables.end(), sides.begin(), sides.end());
  return tables;
}

void FlowRecord::save_table(std::size_t t, std::span<double> values) const {
  if (t >= n_fields) return open.save_table(t - n_fields, values.data());
  double* to = values.data();
  for_rows_of_table(state, t, [&](const double* row, int n) { to = std::copy_n(row, n, to); });
}

void FlowRecord::load_table(std::size_t t, std::span<const double> values) {
  if (t >= n_fields) return open.load_table(t - n_fields, values.data());
  const double* from = values.data();
  for_rows_of_table(state, t, [&](double* row, int n) {
    std::copy_n(from, n, row);
    from += n;
  });
}

std::vector<std::byte> FlowRecord::numbers() const {
  ByteWriter out;
  out.write(time);
  out.write(forcing);
  out.write(rate);
  out.write(open.mean_outwards());
  return out.take();
}

void FlowRecord::finish_loading(std::span<const std::byte> numbers) {
  ByteReader in(numbers);
  const auto new_time = in.read<double>(), new_forcing = in.read<double>(), new_rate = in.read<double>();
  const auto means = in.read_vector<double>();
  in.expect_end();
  if (means.size() != open.mean_outwards().size())
    throw ByteStreamError("the flow has " + std::to_string(open.mean_outwards().size()) + " open sides, not " +
                          std::to_string(means.size()));
  open.finish_loading(means);
  time = new_time;
  forcing = new_forcing;
  rate = new_rate;
}

}  // namespace pliant
