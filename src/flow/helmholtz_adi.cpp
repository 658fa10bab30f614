#include "flow/helmholtz_adi.hpp"

#include <algorithm>
#include <utility>

namespace pliant {
namespace {

struct Line {
  int unknowns;
  LineEnds ends;
  double low, high;
};

// A quantity on the side itself (kind face) is known there: one unknown fewer, value 0 at the neighbouring nodes.
Line line_of(const SideRule& low, const SideRule& high, int n) {
  if (low.kind == SideRule::Kind::periodic) return {n, LineEnds::periodic, 0, 0};
  if (low.kind == SideRule::Kind::face) return {n - 1, LineEnds::bounded, 0, 0};
  return {n, LineEnds::bounded, low.sign, high.sign};
}

SlabRows z_rows(const Grid& grid, const FieldRules& rules, int component, double a) {
  SlabRows rows;
  const bool on_faces = component == 2;
  const auto dz_c = grid.dz_c(), dz_f = grid.dz_f();
  for (int k = 0; k < grid.nz(); ++k) {
    const bool bottom = grid.has_bottom() && k == 0, top = grid.has_top() && k == grid.nz() - 1;
    double lower = on_faces ? -a / (dz_f[k] * dz_c[k]) : -a / (dz_c[k] * dz_f[k - 1]);
    double upper = on_faces ? -a / (dz_f[k] * dz_c[k + 1]) : -a / (dz_c[k] * dz_f[k]);
    double diagonal = 1 - lower - upper;
    if (on_faces && top) lower = 0, diagonal = 1;  // the face on the side is known
    if (!on_faces && bottom) diagonal += rules[4].sign * lower;
    if (!on_faces && top) diagonal += rules[5].sign * upper;
    rows.lower.push_back(bottom ? 0 : lower);
    rows.upper.push_back(top ? 0 : upper);
    rows.diagonal.push_back(diagonal);
  }
  return rows;
}

SlabTridiagonal::Ends ends_of(const Grid& grid) {
  return grid.is_periodic(2) ? SlabTridiagonal::Ends::periodic : SlabTridiagonal::Ends::bounded;
}

}  // namespace

HelmholtzAdi::HelmholtzAdi(const Grid& grid, const FieldRules& rules, int component, Directions directions,
                           std::ptrdiff_t row_stride)
    : grid_(grid),
      rules_(rules),
      component_(component),
      directions_(directions),
      stride_(row_stride),
      z_(grid.ranks(), ends_of(grid), grid.nz(), LinePlane{grid.nx(), grid.ny(), row_stride},
         SlabTridiagonal::Order::descending),
      work_(2 * static_cast<std::size_t>(grid.nx())) {}

void HelmholtzAdi::set_coefficient(double a) {
  if (a == a_) return;
  a_ = a;
  z_.set_coefficients(z_rows(grid_, rules_, component_, a));
  if (directions_ == Directions::z) return;
  const Line x = line_of(rules_[0], rules_[1], grid_.nx()), y = line_of(rules_[2], rules_[3], grid_.ny());
  x_ = RowHelmholtz(x.unknowns, a / (grid_.dx() * grid_.dx()), x.ends, x.low, x.high);
  y_ = PlaneHelmholtz(y.unknowns, a / (grid_.dy() * grid_.dy()), y.ends, y.low, y.high);
}

// The w faces on the upper side.
bool HelmholtzAdi::is_known_plane(int k) const { return component_ == 2 && grid_.has_top() && k == grid_.nz() - 1; }

void HelmholtzAdi::begin_row(double* row, const double* before, const OldPlanes& old, int j, int k) {
  const int nx = grid_.nx();
  if (is_known_plane(k) || (rules_[2].kind == SideRule::Kind::face && j == grid_.ny() - 1)) std::fill_n(row, nx, 0.0);
  if (rules_[0].kind == SideRule::Kind::face) row[nx - 1] = 0;
  if (directions_ == Directions::z) return eliminate_row(row, before, old, j, k);
  add_x_changes(row, j, k);
  x_.solve(row);
  add_y_changes(row, j, k);
  if (j < y_.unknowns()) y_.forward_row(j, row, row - stride_, nx, work_.data());
}

void HelmholtzAdi::end_plane(double* plane, const double* before, const OldPlanes& old, int k) {
  if (directions_ == Directions::z) return;
  const int nx = grid_.nx(), ny = grid_.ny(), n = y_.unknowns();
  if (n > 0) y_.turn(plane + (n - 1) * stride_, nx, work_.data());
  // A row is wanted by the y line below it, so it enters the z lines one row later.
  for (int j = ny - 1; j >= -1; --j) {
    if (j >= 0 && j < n) y_.backward_row(j, plane + j * stride_, plane + (j + 1) * stride_, nx, work_.data());
    const int done = j + 1;
    if (done < ny) eliminate_row(plane + done * stride_, before + done * stride_, old, done, k);
  }
}

void HelmholtzAdi::eliminate_row(double* row, const double* before, const OldPlanes& old, int j, int k) {
  add_z_changes(row, j, k);
  const std::ptrdiff_t at = j * old.stride;
  z_.eliminate_row_added(k, j, row, before, old.below + at, old.here + at, old.above + at);
}

// The known increments beside the first and last unknown of a line go to its right-hand side.
void HelmholtzAdi::add_x_changes(double* row, int j, int k) const {
  const double factor = a_ / (grid_.dx() * grid_.dx());
  const int last = grid_.nx() - (rules_[1].kind == SideRule::Kind::face ? 2 : 1);
  if (last < 0) return;
  if (changes_.values[0] != nullptr) row[0] += factor * changes_.at(0, j, k);
  if (changes_.values[1] != nullptr) row[last] += factor * changes_.at(1, j, k);
}

void HelmholtzAdi::add_y_changes(double* row, int j, int k) const {
  const double factor = a_ / (grid_.dy() * grid_.dy());
  const int last = grid_.ny() - (rules_[3].kind == SideRule::Kind::face ? 2 : 1);
  if (last < 0) return;
  for (const auto& [at, side] : {std::pair<int, std::size_t>{0, 2}, {last, 3}})
    if (j == at && changes_.values[side] != nullptr)
      for (int i = 0; i < grid_.nx(); ++i) row[i] += factor * changes_.at(side, i, k);
}

void HelmholtzAdi::add_z_changes(double* row, int j, int k) const {
  const bool on_faces = component_ == 2;
  const auto dz_c = grid_.dz_c(), dz_f = grid_.dz_f();
  const auto add = [&](std::size_t side, double factor) {
    for (int i = 0; i < grid_.nx(); ++i) row[i] += factor * changes_.at(side, i, j);
  };
  if (changes_.values[4] != nullptr && grid_.has_bottom() && k == 0 && !is_known_plane(k))
    add(4, on_faces ? a_ / (dz_f[0] * dz_c[0]) : a_ / (dz_c[0] * dz_f[-1]));
  // The face on the upper side has a row of its own in the z lines, which tells its neighbour.
  if (changes_.values[5] != nullptr && grid_.has_top() && k == grid_.nz() - 1)
    add(5, on_faces ? 1.0 : a_ / (dz_c[k] * dz_f[k]));
}

}  // namespace pliant
