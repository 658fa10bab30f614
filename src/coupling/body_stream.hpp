#pragma once
#include "core/byte_stream.hpp"
#include "coupling/body.hpp"

namespace pliant {

/// All that distinguishes a body from a fresh copy of its kind, for messages and checkpoints; diagnostics are left out.
void write_body(const Body& body, const BodyKind& kind, ByteWriter& out);
/// The way back, into a copy of the kind. Throws ByteStreamError if the bytes are not of such a body.
void read_body(ByteReader& in, const BodyKind& kind, Body& body);

}  // namespace pliant
