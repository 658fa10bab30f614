#pragma once
#include <span>

#include "core/mat3.hpp"
#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// What Newton's and Euler's laws need to know of a body in its reference shape.
struct MassProperties {
  double mass = 0;
  Vec3 centroid;      ///< of mass
  Mat3 inertia;       ///< tensor about the centroid, along the axes of the reference
  double volume = 0;  ///< of the material: mass / density
};

/// A solid of uniform density inside a closed surface; exact for the polyhedron.
/// Throws InputError if the surface is open or its normals point inwards, or if the density is not positive.
MassProperties solid_mass_properties(const TriangleMesh& mesh, std::span<const Vec3> positions, double density);

/// A thin shell, open or closed, with its mass on the surface; exact for the flat triangles. The terms of order
/// (thickness / size)^2 that a shell of finite thickness adds to the inertia are left out.
/// Throws InputError if the area, the density or the thickness is not positive.
MassProperties shell_mass_properties(const TriangleMesh& mesh, std::span<const Vec3> positions, double density,
                                     double thickness);

/// Moment of inertia about the line through `point` along `axis`, of any length but 0 (parallel axes).
double inertia_about(const MassProperties& body, Vec3 point, Vec3 axis);

}  // namespace pliant
