#pragma once
#include <fftw3.h>

#include <cstddef>
#include <vector>

#include "field/field.hpp"

namespace pliant {

/// How much effort FFTW spends on choosing its plans. `estimate` gives the same plans, and so the same bits, in every
/// run; `measure` may be faster and may differ from run to run.
enum class TransformPlanning { estimate, measure };

/// The transforms of one x-y plane that diagonalise the second difference: Fourier where periodic, cosine (zero
/// gradient at half a cell from the sides) where bounded. On rows of `stride` doubles that begin on 64-byte lines;
/// modes need two doubles more than nx a row if x is periodic.
///
/// Rows and groups of columns pass through small buffers: out of place FFTW's estimated plans are nearly as fast as
/// measured ones, in place up to twice slower (bench/README.md).
class PlaneTransform {
 public:
  enum class Kind { fourier, cosine };

  PlaneTransform(int nx, int ny, std::ptrdiff_t stride, Kind x, Kind y, TransformPlanning planning);
  ~PlaneTransform();
  PlaneTransform(PlaneTransform&&) noexcept;
  PlaneTransform(const PlaneTransform&) = delete;
  PlaneTransform& operator=(const PlaneTransform&) = delete;

  /// In place.
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
  struct Plans {
    fftw_plan row = nullptr;
    fftw_plan wide = nullptr, narrow = nullptr;  // columns: groups of group_ and of last_ doubles
  };
  void make_column_plans(Kind y, unsigned flags, double* plane);
  void columns(const Plans& plans, double* plane) const;
  void columns(fftw_plan plan, double* plane, int width) const;
  void destroy();

  int nx_ = 0, ny_ = 0;
  std::ptrdiff_t stride_ = 0;
  int width_ = 0;
  double normalisation_ = 1;
  bool real_rows_ = false;        // x is a real-to-real transform
  bool complex_columns_ = false;  // both directions are Fourier
  int groups_ = 0, group_ = 0, last_ = 0;
  Plans forward_, backward_;
  AlignedDoubles rows_, columns_;
  std::vector<double> eigenvalues_x_, eigenvalues_y_;
  std::vector<int> fold_;
};

}  // namespace pliant
