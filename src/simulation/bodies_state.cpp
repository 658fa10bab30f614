#include <fmt/format.h>

#include "core/byte_stream.hpp"
#include "core/error.hpp"
#include "simulation/bodies.hpp"

namespace pliant {
namespace {

// All blobs of all ranks on every rank, in the order of the ranks.
std::vector<std::byte> gather(const std::vector<BodyBlob>& blobs, const Communicator& ranks) {
  ByteWriter out;
  for (const auto& blob : blobs) {
    out.write(blob.id);
    out.write(blob.bytes);
  }
  const auto mine = out.take();
  const int size = static_cast<int>(mine.size());
  std::vector<int> sizes(static_cast<std::size_t>(ranks.size())), places(sizes.size());
  check_mpi(MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, ranks.handle()), "MPI_Allgather");
  for (std::size_t r = 1; r < sizes.size(); ++r) places[r] = places[r - 1] + sizes[r - 1];
  std::vector<std::byte> all(static_cast<std::size_t>(places.back() + sizes.back()));
  check_mpi(
      MPI_Allgatherv(mine.data(), size, MPI_BYTE, all.data(), sizes.data(), places.data(), MPI_BYTE, ranks.handle()),
      "MPI_Allgatherv");
  return all;
}

void restore_body(DeformableBody& body, const std::vector<std::byte>& bytes) {
  ByteReader in(bytes);
  for (auto* values : {&body.positions, &body.velocities, &body.forces}) {
    const auto size = values->size();
    in.read(*values);
    if (values->size() != size) throw ByteStreamError(fmt::format("{} vertices instead of {}", values->size(), size));
  }
  in.expect_end();
}

}  // namespace

std::vector<BodyBlob> Bodies::save() const {
  std::vector<BodyBlob> blobs;
  for (std::size_t b = static_cast<std::size_t>(ranks_.rank()); b < bodies_.size();
       b += static_cast<std::size_t>(ranks_.size())) {
    ByteWriter out;
    out.write(bodies_[b].positions);
    out.write(bodies_[b].velocities);
    out.write(bodies_[b].forces);
    blobs.push_back({static_cast<long>(b), out.take()});
  }
  return blobs;
}

void Bodies::restore(std::vector<BodyBlob> blobs) {
  const auto all = gather(blobs, ranks_);
  ByteReader in(all);
  std::size_t count = 0;
  for (; in.remaining() > 0; ++count) {
    const auto id = static_cast<std::size_t>(in.read<long>());
    const auto bytes = in.read_vector<std::byte>();
    if (id >= bodies_.size()) throw InputError(fmt::format("the case has no body of number {}", id));
    try {
      restore_body(bodies_[id], bytes);
    } catch (const ByteStreamError& error) {
      throw InputError(fmt::format("body '{}': its saved state has {}", bodies_[id].name, error.what()));
    }
  }
  if (count != bodies_.size())
    throw InputError(fmt::format("the state of {} bodies was saved, the case has {}", count, bodies_.size()));
}

}  // namespace pliant
