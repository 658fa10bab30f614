#include "solvers/plane_transform.hpp"

#include <algorithm>
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

// Doubles of a group of columns: enough to use whole cache lines, few enough to stay in the first cache.
constexpr int widest_group = 32;

}  // namespace

PlaneTransform::PlaneTransform(int nx, int ny, std::ptrdiff_t stride, Kind x, Kind y, TransformPlanning planning)
    : nx_(nx), ny_(ny), stride_(stride) {
  using std::numbers::pi;
  const bool fourier_x = x == Kind::fourier, fourier_y = y == Kind::fourier;
  real_rows_ = !fourier_x;
  complex_columns_ = fourier_x && fourier_y;
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
  const auto plane = allocate_aligned(static_cast<std::size_t>(stride) * static_cast<std::size_t>(ny));
  rows_ = allocate_aligned(static_cast<std::size_t>(width_) + 2);
  auto* row = plane.get();
  if (fourier_x) {
    forward_.row = checked(fftw_plan_dft_r2c_1d(nx, rows_.get(), reinterpret_cast<fftw_complex*>(row), flags));
    backward_.row = checked(fftw_plan_dft_c2r_1d(nx, reinterpret_cast<fftw_complex*>(rows_.get()), row, flags));
  } else {
    forward_.row = checked(fftw_plan_r2r_1d(nx, rows_.get(), row, FFTW_REDFT10, flags));
    backward_.row = checked(fftw_plan_r2r_1d(nx, rows_.get(), row, FFTW_REDFT01, flags));
  }
  group_ = complex_columns_ ? std::min(width_, widest_group) : width_;
  groups_ = (width_ + group_ - 1) / group_;
  last_ = width_ - (groups_ - 1) * group_;
  columns_ = allocate_aligned(static_cast<std::size_t>(group_) * static_cast<std::size_t>(ny));
  make_column_plans(y, flags, plane.get());
}

void PlaneTransform::make_column_plans(Kind y, unsigned flags, double* plane) {
  const auto make = [&](bool forward, int width) {
    if (complex_columns_) {
      auto* from = reinterpret_cast<fftw_complex*>(plane);
      auto* to = reinterpret_cast<fftw_complex*>(columns_.get());
      return checked(fftw_plan_many_dft(1, &ny_, width / 2, from, nullptr, static_cast<int>(stride_) / 2, 1, to,
                                        nullptr, width / 2, 1, forward ? FFTW_FORWARD : FFTW_BACKWARD, flags));
    }
    // Columns are real numbers here, or the parts of complex ones, with real transforms.
    const fftw_r2r_kind kind =
        y == Kind::fourier ? (forward ? FFTW_R2HC : FFTW_HC2R) : (forward ? FFTW_REDFT10 : FFTW_REDFT01);
    return checked(fftw_plan_many_r2r(1, &ny_, width, plane, nullptr, static_cast<int>(stride_), 1, plane, nullptr,
                                      static_cast<int>(stride_), 1, &kind, flags));
  };
  forward_.wide = make(true, group_);
  backward_.wide = make(false, group_);
  forward_.narrow = make(true, last_);
  backward_.narrow = make(false, last_);
}

PlaneTransform::~PlaneTransform() { destroy(); }

PlaneTransform::PlaneTransform(PlaneTransform&& other) noexcept
    : nx_(other.nx_),
      ny_(other.ny_),
      stride_(other.stride_),
      width_(other.width_),
      normalisation_(other.normalisation_),
      real_rows_(other.real_rows_),
      complex_columns_(other.complex_columns_),
      groups_(other.groups_),
      group_(other.group_),
      last_(other.last_),
      forward_(std::exchange(other.forward_, {})),
      backward_(std::exchange(other.backward_, {})),
      rows_(std::move(other.rows_)),
      columns_(std::move(other.columns_)),
      eigenvalues_x_(std::move(other.eigenvalues_x_)),
      eigenvalues_y_(std::move(other.eigenvalues_y_)),
      fold_(std::move(other.fold_)) {}

void PlaneTransform::destroy() {
  for (const Plans& plans : {forward_, backward_})
    for (fftw_plan plan : {plans.row, plans.wide, plans.narrow})
      if (plan != nullptr) fftw_destroy_plan(plan);
}

void PlaneTransform::columns(fftw_plan plan, double* plane, int width) const {
  if (!complex_columns_) return fftw_execute_r2r(plan, plane, plane);
  fftw_execute_dft(plan, reinterpret_cast<fftw_complex*>(plane), reinterpret_cast<fftw_complex*>(columns_.get()));
  for (int j = 0; j < ny_; ++j) std::copy_n(columns_.get() + j * width, width, plane + j * stride_);
}

void PlaneTransform::columns(const Plans& plans, double* plane) const {
  for (int g = 0; g < groups_ - 1; ++g) columns(plans.wide, plane + g * group_, group_);
  columns(plans.narrow, plane + (groups_ - 1) * group_, last_);
}

void PlaneTransform::forward(double* plane) const {
  for (int j = 0; j < ny_; ++j) {
    double* row = plane + j * stride_;
    std::copy_n(row, nx_, rows_.get());
    if (real_rows_) fftw_execute_r2r(forward_.row, rows_.get(), row);
    else fftw_execute_dft_r2c(forward_.row, rows_.get(), reinterpret_cast<fftw_complex*>(row));
  }
  columns(forward_, plane);
}

void PlaneTransform::backward(double* plane) const {
  columns(backward_, plane);
  for (int j = 0; j < ny_; ++j) {
    double* row = plane + j * stride_;
    std::copy_n(row, width_, rows_.get());
    if (real_rows_) fftw_execute_r2r(backward_.row, rows_.get(), row);
    else fftw_execute_dft_c2r(backward_.row, reinterpret_cast<fftw_complex*>(rows_.get()), row);
  }
}

}  // namespace pliant
