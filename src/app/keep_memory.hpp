#pragma once

namespace pliant {

/// Has the C library keep the memory that the program frees, as far as it can be told to. Every step asks anew for
/// arrays of megabytes; given back to the system in between, each costs its page faults again.
void keep_freed_memory();

}  // namespace pliant
