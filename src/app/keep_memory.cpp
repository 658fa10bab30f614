#include "app/keep_memory.hpp"

#include <cstdlib>  // tells which C library this is

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace pliant {

void keep_freed_memory() {
#ifdef __GLIBC__
  // Larger pieces, such as fields, are mapped for themselves, and 32 MiB is the most that all versions allow here.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

}  // namespace pliant
