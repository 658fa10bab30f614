#pragma once
#include <array>
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

/// A network that is stiffer along a fibre than across it: the stiffness of an edge at an angle phi to the fibre,
/// projected on the surface, is that of an isotropic network of modulus E(phi) = sum of h_n cos(2 n phi).
///
/// Of equilateral faces that have an edge along the fibre, or one across it, Young's moduli along and across come out
/// exactly with E(0) = E1, E(30) = 8 E1 E2 / (9 E2 - E1), E(60) = 8 E1 E2 / (9 E1 - E2), E(90) = E2, from which the
/// four harmonics follow. With edges in all directions alike both are too large by 0.5 % for E1 / E2 = 1.5, 4.5 %
/// for 3.
struct FibreStiffness {
  Vec3 direction;
  std::array<double, 4> harmonics;
};
/// The ratio of the moduli must lie in 1/4 .. 4; from 5 on edges would push.
FibreStiffness fibre_stiffness(Vec3 direction, double young_along, double young_across);
/// van_gelder_stiffness with that modulus on each edge. Where the fibre stands on the surface, the mean counts.
std::vector<double> fibre_network_stiffness(const TriangleMesh& mesh, std::span<const Vec3> reference,
                                            const FibreStiffness& fibre, double thickness);

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
