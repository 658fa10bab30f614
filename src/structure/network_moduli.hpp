#pragma once
#include <array>
#include <optional>
#include <vector>

#include "config/case_config.hpp"
#include "mesh/surface.hpp"

namespace pliant {

/// Quadratic form of a thin sheet along the axes 1 and 2 of its plane: of the strains e_11, e_22, 2 e_12, or of the
/// curvatures.
struct SheetStiffness {
  double c11 = 0, c22 = 0, c12 = 0, c66 = 0, c16 = 0, c26 = 0;

  /// Moduli of the isotropic sheet that is as stiff on average over all directions.
  double area() const { return 0.25 * (c11 + c22 + 2 * c12); }
  double shear() const { return 0.125 * (c11 + c22 - 2 * c12 + 4 * c66); }
  double young() const { return 4 * area() * shear() / (area() + shear()); }
  double poisson() const { return (area() - shear()) / (area() + shear()); }
  /// Under a pull along an axis; the sheet may shear and shrink as it likes.
  double young_along() const { return determinant() / (c22 * c66 - c26 * c26); }
  double young_across() const { return determinant() / (c11 * c66 - c16 * c16); }
  /// Stiffness against being rolled up, mean over all directions.
  double rolling() const { return (3 * c11 + 3 * c22 + 2 * c12 + 4 * c66) / 8; }

 private:
  double determinant() const {
    return c11 * (c22 * c66 - c26 * c26) - c12 * (c12 * c66 - c16 * c26) + c16 * (c12 * c26 - c22 * c16);
  }
};

/// What a body's constants are meant to give: those of its material or law, or what equal springs and hinges give on
/// equilateral faces. Empty: nothing is asked for.
struct SheetModuli {
  std::optional<double> area, shear, young, poisson, young_across, bending;
};
SheetModuli asked_moduli(const BodyConfig& body);

/// A nearly flat part of a surface, laid out in the x-y plane: the whole of it if it is flat, else what lies around a
/// vertex within 30 degrees, at its distance from it (which keeps the areas of a sphere). Axis 1 is x, along the fibre
/// if the body has one.
struct FlatPatch {
  Surface surface;
  std::optional<Vec3> fibre;
};
/// Throws InputError if the faces are too large for the curvature of the surface.
std::vector<FlatPatch> flat_patches(const BodyConfig& body, const Surface& surface);

/// Stiffness of a patch in its plane, from the energy when its border is strained evenly and the inside finds its
/// balance; and against bending, when the border and the vertices next to it are bent evenly. Small strains.
SheetStiffness plane_stiffness(const BodyConfig& body, const FlatPatch& patch);
SheetStiffness bending_stiffness(const BodyConfig& body, const FlatPatch& patch);

/// The area modulus of a sphere from its swelling under a small pressure, p = 4 K eps / R. Empty if the surface is no
/// sphere.
std::optional<double> inflation_modulus(const BodyConfig& body, const Surface& surface);

/// All of these; stiffnesses are means over the patches.
struct MeasuredModuli {
  SheetModuli asked;
  SheetStiffness plane, bending;
  std::optional<double> inflation;
  int n_patches = 0, n_vertices = 0;  ///< of all patches together
};
/// Throws InputError if the body has no such energies, or is stressed at rest.
MeasuredModuli find_moduli(const BodyConfig& body, const Surface& surface);

}  // namespace pliant
