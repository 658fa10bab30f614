#pragma once
#include <cstddef>
#include <vector>

namespace pliant {

/// The state of one body in a checkpoint. Only the bodies know what the bytes mean; files keep them by number.
struct BodyBlob {
  long id = 0;  ///< the body's number in the whole case, from 0
  std::vector<std::byte> bytes;
};

}  // namespace pliant
