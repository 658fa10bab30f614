#pragma once
#include <span>

#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

/// The vertices of a liquid interface are no material: they only say where it is. All that matters is how they move
/// along its normals; along the surface they may go where the mesh stays even.
namespace pliant {

/// Velocity of the centroid of the volume inside a closed surface; that of a translation is found exactly.
Vec3 centroid_velocity(const TriangleMesh& mesh, std::span<const Vec3> positions, std::span<const Vec3> velocities);

/// Leaves the velocity of the centroid, and of the rest what is along the normals (the gradient of the volume). The
/// rate of the volume stays what it was.
void keep_normal_part(const TriangleMesh& mesh, std::span<const Vec3> positions, std::span<Vec3> velocities);

/// Moves every vertex in its tangent plane by a fraction of its way to the centroid of the faces around it.
void even_out(const TriangleMesh& mesh, std::span<Vec3> positions, double fraction);

}  // namespace pliant
