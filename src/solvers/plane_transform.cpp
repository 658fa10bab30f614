#include "solvers/plane_transform.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.hpp"

namespace pliant {
namespace {

double eigenvalue(double angle) {
  const double s = std::sin(0.5 * angle);
  return -4 * s * s;
}

fftw_plan checked(fftw_plan plan) {
  if (plan == nullptr) throw RunError("FFTW could not plan the transform of a plane");
  return plan;
}

}  // namespace

PlaneTransform::PlaneTransform(int nx, int ny, std::ptrdiff_t stride, Kind x, Kind y, TransformPlanning planning,
                               double* plane) {
  using std::numbers::pi;
  const bool fourier_x = x == Kind::fourier, fourier_y = y == Kind::fourier;
  width_ = fourier_x ? 2 * (nx / 2 + 1) : nx;
  normalisation_ = 1.0 / ((fourier_x ? 1.0 : 2.0) * nx * (fourier_y ? 1.0 : 2.0) * ny);
  for (int i = 0; i < width_; ++i)
    eigenvalues_x_.push_back(eigenvalue(fourier_x ? 2 * pi * (i / 2) / nx : pi * i / nx));
  for (int j = 0; j < ny; ++j) {
    const int mode = fourier_y && j > ny / 2 ? ny - j : j;
    eigenvalues_y_.push_back(eigenvalue((fourier_y ? 2 * pi : pi) * mode / ny));
    fold_.push_back(mode);
  }

  const unsigned flags = planning == TransformPlanning::measure ? FFTW_MEASURE : FFTW_ESTIMATE;
  const int pitch = static_cast<int>(stride);
  auto* modes = reinterpret_cast<fftw_complex*>(plane);
  real_rows_ = !fourier_x;

  if (fourier_x && fourier_y) {
    const int n[2] = {ny, nx}, reals[2] = {ny, pitch}, complexes[2] = {ny, pitch / 2};
    forward_.x = checked(fftw_plan_many_dft_r2c(2, n, 1, plane, reals, 1, 0, modes, complexes, 1, 0, flags));
    backward_.x = checked(fftw_plan_many_dft_c2r(2, n, 1, modes, complexes, 1, 0, plane, reals, 1, 0, flags));
    return;
  }
  if (fourier_x) {
    forward_.x =
        checked(fftw_plan_many_dft_r2c(1, &nx, ny, plane, nullptr, 1, pitch, modes, nullptr, 1, pitch / 2, flags));
    backward_.x =
        checked(fftw_plan_many_dft_c2r(1, &nx, ny, modes, nullptr, 1, pitch / 2, plane, nullptr, 1, pitch, flags));
  } else {
    const fftw_r2r_kind there = FFTW_REDFT10, back = FFTW_REDFT01;
    forward_.x =
        checked(fftw_plan_many_r2r(1, &nx, ny, plane, nullptr, 1, pitch, plane, nullptr, 1, pitch, &there, flags));
    backward_.x =
        checked(fftw_plan_many_r2r(1, &nx, ny, plane, nullptr, 1, pitch, plane, nullptr, 1, pitch, &back, flags));
  }
  // Columns are real numbers here (or the parts of complex ones, with real transforms): all at once, interleaved.
  const fftw_r2r_kind there = fourier_y ? FFTW_R2HC : FFTW_REDFT10, back = fourier_y ? FFTW_HC2R : FFTW_REDFT01;
  forward_.y =
      checked(fftw_plan_many_r2r(1, &ny, width_, plane, nullptr, pitch, 1, plane, nullptr, pitch, 1, &there, flags));
  backward_.y =
      checked(fftw_plan_many_r2r(1, &ny, width_, plane, nullptr, pitch, 1, plane, nullptr, pitch, 1, &back, flags));
}

PlaneTransform::~PlaneTransform() { destroy(); }

PlaneTransform::PlaneTransform(PlaneTransform&& other) noexcept
    : width_(other.width_),
      normalisation_(other.normalisation_),
      real_rows_(other.real_rows_),
      forward_(std::exchange(other.forward_, {})),
      backward_(std::exchange(other.backward_, {})),
      eigenvalues_x_(std::move(other.eigenvalues_x_)),
      eigenvalues_y_(std::move(other.eigenvalues_y_)),
      fold_(std::move(other.fold_)) {}

void PlaneTransform::destroy() {
  for (fftw_plan plan : {forward_.x, forward_.y, backward_.x, backward_.y})
    if (plan != nullptr) fftw_destroy_plan(plan);
}

void PlaneTransform::forward(double* plane) const {
  auto* modes = reinterpret_cast<fftw_complex*>(plane);
  if (real_rows_) fftw_execute_r2r(forward_.x, plane, plane);
  else fftw_execute_dft_r2c(forward_.x, plane, modes);
  if (forward_.y != nullptr) fftw_execute_r2r(forward_.y, plane, plane);
}

void PlaneTransform::backward(double* plane) const {
  auto* modes = reinterpret_cast<fftw_complex*>(plane);
  if (backward_.y != nullptr) fftw_execute_r2r(backward_.y, plane, plane);
  if (real_rows_) fftw_execute_r2r(backward_.x, plane, plane);
  else fftw_execute_dft_c2r(backward_.x, modes, plane);
}

}  // namespace pliant
