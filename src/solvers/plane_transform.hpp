#pragma once
#include <fftw3.h>

#include <cstddef>
#include <vector>

namespace pliant {

/// How much effort FFTW spends on choosing its plans. `estimate` gives the same plans, and so the same bits, in every
/// run; `measure` may be faster and may differ from run to run.
enum class TransformPlanning { estimate, measure };

/// The transforms of one x-y plane that diagonalise the second difference: Fourier where periodic, cosine (zero
/// gradient at half a cell from the sides) where bounded. In place, on rows of `stride` doubles that begin on 64-byte
/// lines; modes need two doubles more than nx a row if x is periodic.
class PlaneTransform {
 public:
  enum class Kind { fourier, cosine };

  /// `plane` is scratch for planning and is overwritten.
  PlaneTransform(int nx, int ny, std::ptrdiff_t stride, Kind x, Kind y, TransformPlanning planning, double* plane);
  ~PlaneTransform();
  PlaneTransform(PlaneTransform&&) noexcept;
  PlaneTransform(const PlaneTransform&) = delete;
  PlaneTransform& operator=(const PlaneTransform&) = delete;

  void forward(double* plane) const;
  void backward(double* plane) const;  ///< the inverse, times 1 / normalisation()
  double normalisation() const { return normalisation_; }

  /// Doubles of a row of modes.
  int mode_width() const { return width_; }
  /// Eigenvalue of the second difference with unit spacing at mode double i of a row / at row j.
  const std::vector<double>& eigenvalues_x() const { return eigenvalues_x_; }
  const std::vector<double>& eigenvalues_y() const { return eigenvalues_y_; }
  /// Row j has the eigenvalue of row fold()[j]; folded rows count from 0 without gaps.
  const std::vector<int>& fold() const { return fold_; }

 private:
  struct Plan {
    fftw_plan x = nullptr, y = nullptr;  // x alone does both directions if y is null
  };
  void destroy();

  int width_ = 0;
  double normalisation_ = 1;
  bool real_rows_ = false;  // x is a real-to-real transform
  Plan forward_, backward_;
  std::vector<double> eigenvalues_x_, eigenvalues_y_;
  std::vector<int> fold_;
};

}  // namespace pliant
