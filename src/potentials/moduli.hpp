#pragma once
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

/// From the moduli of a thin sheet to the constants of a spring network. E: Young's modulus, h: thickness, nu: Poisson
/// ratio.
namespace pliant {

/// k per edge = E h (areas of the edge's faces) / l0^2 (Van Gelder 1998). Exact for equilateral faces: k = sqrt(3)/2 E
/// h.
std::vector<double> van_gelder_stiffness(const TriangleMesh& mesh, std::span<const Vec3> reference, double young,
                                         double thickness);

/// B = E h^3 / (12 (1 - nu^2)).
double bending_modulus(double young, double thickness, double poisson);

/// k per hinge = B l0^2 / (A1 + A2), 0 at a border. For equilateral faces 2 B / sqrt(3).
std::vector<double> hinge_stiffness(const TriangleMesh& mesh, std::span<const Vec3> reference, double bending_modulus);

/// In-plane moduli of an equilateral network of springs k with rest length = length; its Poisson ratio is 1/3.
struct NetworkModuli {
  double shear;  ///< G = sqrt(3) k / 4
  double area;   ///< K = sqrt(3) k / 2, of area change
  double young;  ///< 4 K G / (K + G) = 2 k / sqrt(3)
};
NetworkModuli equilateral_moduli(double stiffness);

}  // namespace pliant
