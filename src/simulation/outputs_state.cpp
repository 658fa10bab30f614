#include "simulation/outputs_state.hpp"

#include "core/byte_stream.hpp"

namespace pliant {
namespace {

template <class Number>
void write(ByteWriter& out, const std::map<std::string, Number>& numbers) {
  out.write(static_cast<std::uint64_t>(numbers.size()));
  for (const auto& [name, number] : numbers) {
    out.write(name);
    out.write(number);
  }
}

template <class Number>
void read(ByteReader& in, std::map<std::string, Number>& numbers) {
  const auto count = in.read<std::uint64_t>();
  for (std::uint64_t n = 0; n < count; ++n) {
    const auto name = in.read_text();
    in.read(numbers[name]);
  }
}

}  // namespace

std::vector<std::byte> OutputsState::encode() const {
  ByteWriter out;
  write(out, tables);
  write(out, series);
  for (const long step : {last_history, last_fields, last_surfaces}) out.write(static_cast<std::int64_t>(step));
  return out.take();
}

OutputsState OutputsState::decode(std::span<const std::byte> bytes) {
  OutputsState state;
  ByteReader in(bytes);
  read(in, state.tables);
  read(in, state.series);
  for (long* step : {&state.last_history, &state.last_fields, &state.last_surfaces})
    *step = static_cast<long>(in.read<std::int64_t>());
  in.expect_end();
  return state;
}

}  // namespace pliant
