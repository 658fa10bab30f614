#pragma once
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "parallel/communicator.hpp"

namespace pliant {

/// The planes k = -1 .. nz of one field as messages see them: contiguous blocks of `size` doubles.
struct PlaneStack {
  double* first;          ///< start of plane k = 0, ghosts of the plane included
  std::ptrdiff_t stride;  ///< doubles from plane to plane
  std::size_t size;       ///< doubles of a plane that travel
};

/// Which ghost planes an exchange fills.
enum class GhostPlanes { lower, upper, both };

/// Exchanges the planes at the ends of the slabs between neighbours in z. Built once; allocates nothing in a
/// step but the first that accumulates.
class SlabHalo {
 public:
  enum class Ends { bounded, periodic };
  SlabHalo(const Communicator& ranks, Ends ends, int planes);

  /// Owner to ghost, for all stacks at once. Collective. Ghost planes outside a bounded box are left as they are.
  void fill(std::initializer_list<PlaneStack> stacks, GhostPlanes which = GhostPlanes::both) const;
  /// Ghost to owner: adds what stands in the ghost planes to the planes they are copies of, first that of the rank
  /// below, then that of the rank above. Collective. The ghost planes keep what they hold.
  void accumulate(std::initializer_list<PlaneStack> stacks);

 private:
  Communicator ranks_;
  int below_, above_;  // MPI_PROC_NULL at a bounded end
  int planes_;
  std::vector<double> incoming_;  // made when first wanted
};

}  // namespace pliant
