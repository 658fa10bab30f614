#pragma once

namespace pliant {

/// exp of n numbers in place, a multiple of eight at a 64-byte boundary. A number's result does not depend on its place
/// or its neighbours.
void exponentials(double* x, int n);

}  // namespace pliant
