#include "potentials/surface_tension.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "mesh/geometry.hpp"
#include "potentials/area_gradient.hpp"

namespace pliant {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

Vector6 force_and_torque(Vec3 force, Vec3 arm) {
  const Vec3 torque = cross(arm, force);
  Vector6 both;
  both << force.x, force.y, force.z, torque.x, torque.y, torque.z;
  return both;
}

std::vector<Vec3> vertex_normals(const ShapeState& shape) {
  std::vector<Vec3> normals(shape.mesh().n_vertices());
  const auto faces = shape.mesh().vertices_of_face();
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int v : faces[f]) normals[v] += shape.face_vector(f);
  for (Vec3& n : normals) n = normalized(n);
  return normals;
}

/// Takes from a field of tangential forces the tangential part of the rigid motion that carries its net force and
/// torque: forces_i -= P_i (a + b x r_i), with P_i the projection on the tangent plane and a, b from a symmetric 6 x 6
/// system.
void remove_net_force_and_torque(std::span<const Vec3> positions, std::span<const Vec3> normals,
                                 std::span<Vec3> forces) {
  const Vec3 centre = mean_position(positions);
  Vector6 net = Vector6::Zero();
  Matrix6 response = Matrix6::Zero();
  for (std::size_t v = 0; v < forces.size(); ++v) {
    const Vec3 arm = positions[v] - centre, n = normals[v];
    net += force_and_torque(forces[v], arm);
    // P = I - n n^T, so the response is that of the full rigid motion minus a rank-one part along n.
    const Vector6 along_normal = force_and_torque(n, arm);
    response.noalias() -= along_normal * along_normal.transpose();
    const Eigen::Vector3d r(arm.x, arm.y, arm.z);
    Eigen::Matrix3d arm_cross;
    arm_cross << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
    response.topLeftCorner<3, 3>() += Eigen::Matrix3d::Identity();
    response.bottomLeftCorner<3, 3>() += arm_cross;
    response.topRightCorner<3, 3>() -= arm_cross;
    response.bottomRightCorner<3, 3>() += r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose();
  }
  const Vector6 motion = response.ldlt().solve(net);
  const Vec3 shift{motion[0], motion[1], motion[2]}, turn{motion[3], motion[4], motion[5]};
  for (std::size_t v = 0; v < forces.size(); ++v) {
    const Vec3 rigid = shift + cross(turn, positions[v] - centre);
    forces[v] -= rigid - dot(rigid, normals[v]) * normals[v];
  }
}

}  // namespace

double SurfaceTension::balanced_control(double sigma) { return sigma / std::sqrt(3.0); }

double SurfaceTension::energy(const ShapeState& shape) const { return sigma * shape.area(); }

void SurfaceTension::add_forces(const ShapeState& shape, std::span<Vec3> forces) const {
  const auto faces = shape.mesh().vertices_of_face();
  const auto positions = shape.positions();
  const auto add_tension = [&](std::span<Vec3> target) {
    for (std::size_t f = 0; f < faces.size(); ++f)
      add_face_tension(faces[f], positions, shape.inverse_length(f) * shape.face_vector(f), sigma, target);
  };
  if (mesh_control == 0) return add_tension(forces);

  std::vector<Vec3> tension(positions.size()), tangential(positions.size());
  add_tension(tension);
  for (const auto& [a, b] : shape.mesh().vertices_of_edge()) {
    const Vec3 pull = mesh_control * (positions[b] - positions[a]);
    tangential[a] += pull;
    tangential[b] -= pull;
  }
  // The exact force has no net force and torque. So what replaces its tangential part must not add any: correct the
  // difference, springs minus tension, and add it to the exact force.
  const auto normals = vertex_normals(shape);
  for (std::size_t v = 0; v < tangential.size(); ++v) {
    const Vec3 change = tangential[v] - tension[v];
    tangential[v] = change - dot(change, normals[v]) * normals[v];
  }
  remove_net_force_and_torque(positions, normals, tangential);
  for (std::size_t v = 0; v < tangential.size(); ++v) forces[v] += tension[v] + tangential[v];
}

}  // namespace pliant
