#include "simulation/surface_batch.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include "mesh/geometry.hpp"

namespace pliant {
namespace {

void append(std::vector<double>& to, std::span<const Vec3> vectors, std::size_t expected, Vec3 shift = {}) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t n = 0; n < expected; ++n) {
    const Vec3 v = n < vectors.size() ? vectors[n] + shift : Vec3{none, none, none};
    to.insert(to.end(), {v.x, v.y, v.z});
  }
}

void append(std::vector<double>& to, std::span<const double> numbers, std::size_t expected) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t n = 0; n < expected; ++n) to.push_back(n < numbers.size() ? numbers[n] : none);
}

Vec3 into_box(Vec3 mean, const Grid& grid) {
  Vec3 shift;
  for (int d = 0; d < 3; ++d)
    if (grid.is_periodic(d)) shift[d] = -grid.size()[d] * std::floor((mean[d] - grid.origin()[d]) / grid.size()[d]);
  return shift;
}

/// A third of the force on each face to each of its vertices.
std::vector<Vec3> vertex_forces(const Body& body) {
  std::vector<Vec3> forces(body.surface.positions.size());
  const auto faces = body.surface.mesh.vertices_of_face();
  for (std::size_t f = 0; f < body.stresses.forces.size(); ++f)
    for (int v : faces[f]) forces[static_cast<std::size_t>(v)] += body.stresses.forces[f] / 3.0;
  return forces;
}

}  // namespace

SurfaceBatch surface_batch(const Bodies& bodies, std::size_t kind_index) {
  const auto& kind = bodies.kinds()[kind_index];
  const auto vertex = SurfaceCenter::vertex, face = SurfaceCenter::face;
  const bool has_stress = kind.acts_on_flow() && kind.config.traction.form != TractionForm::none;
  const bool has_inner = has_stress && !kind.is_closed();
  const bool has_schedule = kind.config.schedule.has_value();
  SurfaceBatch batch;
  batch.sets = {{"positions", vertex, 3, {}}, {"velocity", vertex, 3, {}}, {"force", vertex, 3, {}}};
  if (has_stress) {
    batch.sets.push_back({"pressure", face, 1, {}});
    batch.sets.push_back({"shear", face, 3, {}});
  }
  if (has_inner) {
    batch.sets.push_back({"inner_pressure", face, 1, {}});
    batch.sets.push_back({"inner_shear", face, 3, {}});
  }
  if (has_schedule) batch.sets.push_back({"on", face, 1, {}});
  for (const Body& body : bodies.own()) {
    if (body.kind != kind_index) continue;
    const auto& surface = body.surface;
    const auto n = surface.positions.size(), n_faces = static_cast<std::size_t>(surface.mesh.n_faces());
    batch.copies.push_back(static_cast<std::int32_t>(body.id - bodies.first_id(kind_index) + 1));
    append(batch.sets[0].values, surface.positions, n, into_box(mean_position(surface.positions), bodies.grid()));
    append(batch.sets[1].values, surface.velocities, n);
    append(batch.sets[2].values, kind.has_pose() ? vertex_forces(body) : surface.forces, n);
    if (has_stress) {
      append(batch.sets[3].values, body.stresses.outer.pressure, n_faces);
      append(batch.sets[4].values, body.stresses.outer.shear, n_faces);
    }
    if (has_inner) {
      append(batch.sets[5].values, body.stresses.inner.pressure, n_faces);
      append(batch.sets[6].values, body.stresses.inner.shear, n_faces);
    }
    if (has_schedule) {
      auto& values = batch.sets.back().values;
      values.insert(values.end(), n_faces, bodies.is_on(body) ? 1.0 : 0.0);
    }
  }
  return batch;
}

}  // namespace pliant
