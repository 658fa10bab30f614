// GCC 12 takes the undefined operands of its own AVX-512 intrinsics for uninitialised variables.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "coupling/tight_walls.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "boundary/fill_ghosts.hpp"
#include "boundary/periodic_ghosts.hpp"
#include "core/lanes.hpp"
#include "core/loops.hpp"
#include "coupling/wall_links.hpp"
#include "transfer/velocity_copies.hpp"

namespace pliant {
namespace {

// Fluxes that follow from others, or from the sides of the box, cannot be chosen: eigenvalues of the response below
// this, over those in a fluid without pressure. A plate around two orifices of a tank has a hundredth, what closes a
// part of the box has zero but for rounding.
constexpr double least_response = 1e-8;

// sum_i ax u_i (p_i - p_{i+1}) + ay v_i (p_i - n_i) + az w_i (p_i - t_i): a row's part of sum_c phi div(u) dV.
double row_sum(int nx, const double* p, const double* n, const double* t, const double* u, const double* v,
               const double* w, double ax, double ay, double az) {
  Lanes lanes{};
  const int whole = nx / n_lanes * n_lanes;
  for (int i = 0; i < whole; i += n_lanes) {
    const Lanes here = load_lanes(p + i);
    lanes += ax * load_lanes(u + i) * (here - load_lanes(p + i + 1)) +
             ay * load_lanes(v + i) * (here - load_lanes(n + i)) + az * load_lanes(w + i) * (here - load_lanes(t + i));
  }
  double rest = 0;
  for (int i = whole; i < nx; ++i)
    rest += ax * u[i] * (p[i] - p[i + 1]) + ay * v[i] * (p[i] - n[i]) + az * w[i] * (p[i] - t[i]);
  return sum(lanes) + rest;
}

// What enters through the lower sides of the box; through the upper ones it is in the sums over rows.
double lower_sides(const Grid& grid, ConstView<Center> phi, ConstView<FaceX> u, ConstView<FaceY> v,
                   ConstView<FaceZ> w) {
  const int nx = grid.nx(), ny = grid.ny(), nz = grid.nz();
  double sum = 0;
  for (int k = 0; k < nz; ++k) {
    const double dz = grid.dz_c()[k];
    if (!grid.is_periodic(0))
      for (int j = 0; j < ny; ++j) sum -= grid.dy() * dz * u(-1, j, k) * phi(0, j, k);
    if (!grid.is_periodic(1))
      for (int i = 0; i < nx; ++i) sum -= grid.dx() * dz * v(i, -1, k) * phi(i, 0, k);
  }
  if (grid.has_bottom())
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) sum -= grid.dx() * grid.dy() * w(i, j, -1) * phi(i, j, 0);
  return sum;
}

// Of a face of a cell across an axis, in plane k of the box.
double area_of(const Grid& grid, int axis, int k) {
  const double dz = grid.global_dz_c()[k];
  return axis == 0 ? grid.dy() * dz : axis == 1 ? grid.dx() * dz : grid.dx() * grid.dy();
}

template <class Location>
double volume_of(const Grid& grid, int k) {
  const double dz = std::is_same_v<Location, FaceZ> ? grid.dz_f()[k] : grid.dz_c()[k];
  return grid.dx() * grid.dy() * dz;
}

// From weights to g: over the volumes of the nodes.
template <class Nodes, class Location>
void keep_nodes(const Grid& grid, View<Location> f, Nodes& nodes) {
  for (int k = 0; k < grid.nz(); ++k)
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i) {
        double& value = f(i, j, k);
        if (value == 0) continue;
        const double weight = value;
        value /= volume_of<Location>(grid, k);
        nodes.push_back({&value - f.origin, value, weight});
      }
}

template <class Nodes, class Location>
double flux_through(const Nodes& nodes, ConstView<Location> f) {
  double sum = 0;
  for (const auto& node : nodes) sum += node.weighted * f.origin[node.offset];
  return sum;
}

template <class Nodes, class Location>
void subtract(const Nodes& nodes, double factor, View<Location> f) {
  for (const auto& node : nodes) f.origin[node.offset] -= factor * node.g;
}

}  // namespace

// What it takes to find a part, used again for the next.
struct TightWalls::Workspace {
  explicit Workspace(const Grid& grid)
      : copies(grid),
        halo(grid.ranks(), grid.is_periodic(2) ? SlabHalo::Ends::periodic : SlabHalo::Ends::bounded, grid.nz()),
        u(grid),
        v(grid),
        w(grid) {}
  void clear(const Grid& grid) {
    u = Field<FaceX>(grid);
    v = Field<FaceY>(grid);
    w = Field<FaceZ>(grid);
  }
  VelocityCopies copies;
  SlabHalo halo;
  Field<FaceX> u;
  Field<FaceY> v;
  Field<FaceZ> w;
};

TightWalls::TightWalls(FlowSolver& flow, const Bodies& bodies)
    : grid_(flow.grid()), density_(flow.parameters().density) {
  Workspace work(grid_);
  for (std::size_t k = 0; k < bodies.kinds().size(); ++k) {
    const auto& kind = bodies.kinds()[k];
    for (long id = bodies.first_id(k); id < bodies.first_id(k) + bodies.count(k); ++id)
      for (std::size_t n = 0; n < kind.tight_parts.size(); ++n) {
        Part part(grid_);
        part.kind = k;
        part.body = id;
        add_part(flow, bodies.find(id), kind.tight_parts[n], part, work);
        parts_.push_back(std::move(part));
      }
  }
  const auto n = static_cast<Eigen::Index>(parts_.size());
  response_.resize(n, n);
  free_.resize(n);
  for (Eigen::Index s = 0; s < n; ++s) {
    const Part& part = parts_[static_cast<std::size_t>(s)];
    work.clear(grid_);
    subtract(part.u, -1, work.u.view());
    subtract(part.v, -1, work.v.view());
    subtract(part.w, -1, work.w.view());
    const auto u = std::as_const(work.u).view();
    const auto v = std::as_const(work.v).view();
    const auto w = std::as_const(work.w).view();
    find_fluxes(u, v, w);
    for (Eigen::Index r = 0; r < n; ++r) response_(r, s) = fluxes_[static_cast<std::size_t>(r)];
    free_[s] = grid_.ranks().sum(flux_through(part.u, u) + flux_through(part.v, v) + flux_through(part.w, w));
  }
  response_ = (0.5 * (response_ + response_.transpose())).eval();
}

void TightWalls::add_part(FlowSolver& flow, const Body* body, std::span<const Face> faces, Part& part,
                          Workspace& work) {
  const auto& ranks = grid_.ranks();
  constexpr std::size_t width = 5;
  std::vector<double> numbers;
  if (body != nullptr)
    for (const auto& link : find_wall_links(grid_, faces, body->surface.positions)) {
      const auto [i, j, k] = link.node;
      numbers.insert(numbers.end(), {1.0 * link.axis, 1.0 * i, 1.0 * j, 1.0 * k, 1.0 * link.sign});
      Vec3 area;
      area[link.axis] = link.sign * area_of(grid_, link.axis, k);
      part.of_unit_pressure.force += area;
      part.of_unit_pressure.torque += cross(link.place - body->pose.center, area);
    }
  numbers.resize(static_cast<std::size_t>(ranks.max(static_cast<int>(numbers.size()))));
  ranks.sum(numbers);  // of all ranks but one they are zero
  work.clear(grid_);
  for (std::size_t n = 0; n < numbers.size(); n += width) {
    const auto at = [&](std::size_t c) { return static_cast<int>(numbers[n + c]); };
    const int k = at(3) - grid_.slab().begin;
    if (k < 0 || k >= grid_.nz()) continue;
    const double weight = at(4) * area_of(grid_, at(0), at(3));
    if (at(0) == 0) work.u.view()(at(1), at(2), k) += weight;
    else if (at(0) == 1) work.v.view()(at(1), at(2), k) += weight;
    else work.w.view()(at(1), at(2), k) += weight;
  }
  keep_nodes(grid_, work.u.view(), part.u);
  keep_nodes(grid_, work.v.view(), part.v);
  keep_nodes(grid_, work.w.view(), part.w);
  work.copies.fill(work.u.view(), work.v.view(), work.w.view());
  flow.find_potential(std::as_const(work.u).view(), std::as_const(work.v).view(), std::as_const(work.w).view(),
                      part.potential.view());
  for (int k = 0; k < grid_.nz(); ++k) fill_periodic_ghosts(part.potential.view(), grid_, k);
  work.halo.fill({plane_stack(part.potential)});
}

bool TightWalls::any(const Bodies& bodies) const {
  return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) { return bodies.is_on(part.kind); });
}

void TightWalls::begin_step() {
  for (Part& part : parts_) part.taken = 0;
}

// The pseudo-inverse, scaled by what the parts would do alone in a fluid without pressure.
void TightWalls::follow(const Bodies& bodies) {
  bool has_changed = is_on_.empty();
  is_on_.resize(parts_.size());
  for (std::size_t r = 0; r < parts_.size(); ++r) {
    has_changed |= is_on_[r] != bodies.is_on(parts_[r].kind);
    is_on_[r] = bodies.is_on(parts_[r].kind);
  }
  if (!has_changed) return;
  const auto n = static_cast<Eigen::Index>(parts_.size());
  Eigen::VectorXd scale(n);
  for (Eigen::Index r = 0; r < n; ++r)
    scale[r] = is_on_[static_cast<std::size_t>(r)] && free_[r] > 0 ? 1 / std::sqrt(free_[r]) : 0;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scale.asDiagonal() * response_ * scale.asDiagonal());
  const Eigen::VectorXd inverse =
      solver.eigenvalues().unaryExpr([](double e) { return e > least_response ? 1 / e : 0.0; });
  const Eigen::MatrixXd modes = scale.asDiagonal() * solver.eigenvectors();
  correction_ = modes * inverse.asDiagonal() * modes.transpose();
}

void TightWalls::find_fluxes(ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w) {
  auto& sums = fluxes_;
  sums.assign(parts_.size(), 0.0);
  const auto counts = [&](std::size_t r) { return is_on_.empty() || is_on_[r]; };
  for (int k = 0; k < grid_.nz(); ++k) {
    const double ax = grid_.dy() * grid_.dz_c()[k], ay = grid_.dx() * grid_.dz_c()[k], az = grid_.dx() * grid_.dy();
    for_rows(grid_.ny(), [&](int j) {
      for (std::size_t r = 0; r < parts_.size(); ++r) {
        if (!counts(r)) continue;
        const auto phi = parts_[r].potential.view();
        sums[r] += row_sum(grid_.nx(), phi.at_row(j, k), phi.at_row(j + 1, k), phi.at_row(j, k + 1), u.at_row(j, k),
                           v.at_row(j, k), w.at_row(j, k), ax, ay, az);
      }
    });
  }
  for (std::size_t r = 0; r < parts_.size(); ++r) {
    if (!counts(r)) continue;
    const Part& part = parts_[r];
    sums[r] += lower_sides(grid_, part.potential.view(), u, v, w) + flux_through(part.u, u) + flux_through(part.v, v) +
               flux_through(part.w, w);
  }
  grid_.ranks().sum(sums);
}

void TightWalls::apply(const Bodies& bodies, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
  follow(bodies);
  find_fluxes(u, v, w);
  for (std::size_t s = 0; s < parts_.size(); ++s) {
    if (!is_on_[s]) continue;
    double factor = 0;
    for (std::size_t r = 0; r < parts_.size(); ++r)
      factor += correction_(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(r)) * fluxes_[r];
    Part& part = parts_[s];
    subtract(part.u, factor, u);
    subtract(part.v, factor, v);
    subtract(part.w, factor, w);
    part.taken += factor;
  }
}

RigidLoad TightWalls::load_on(const Body& body, double step) const {
  RigidLoad load;
  for (const Part& part : parts_) {
    if (part.body != body.id) continue;
    const double factor = density_ * part.taken / step;
    load.force += factor * part.of_unit_pressure.force;
    load.torque += factor * part.of_unit_pressure.torque;
  }
  return load;
}

}  // namespace pliant
