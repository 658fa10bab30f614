#pragma once

namespace pliant {

/// exp of eight numbers in place, at a 64-byte boundary. A number's result does not depend on its place or its
/// neighbours.
void exponentials(double* x);

}  // namespace pliant
