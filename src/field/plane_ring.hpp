#pragma once
#include "field/field.hpp"

namespace pliant {

/// The few planes of a quantity that a sweep holds at a time: plane k stands where plane k + count stood. Rows are laid
/// out as in a Field.
template <class Location>
class PlaneRing {
 public:
  PlaneRing(const Grid& grid, int count);

  /// k >= -count.
  Plane<Location> operator[](int k) const {
    return {origin_ + static_cast<std::ptrdiff_t>((k + count_) % count_) * plane_, row_};
  }
  std::size_t bytes() const { return bytes_; }

 private:
  int count_;
  std::ptrdiff_t row_ = 0, plane_ = 0;
  std::size_t bytes_ = 0;
  AlignedDoubles memory_;
  double* origin_ = nullptr;
};

}  // namespace pliant
