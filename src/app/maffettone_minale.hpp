#pragma once

namespace pliant {

/// The steady shape of a drop in simple shear in units of its radius at rest.
struct DropShape {
  double major = 1;     ///< L, in the plane of shear
  double minor = 1;     ///< B, in the plane of shear
  double vortical = 1;  ///< W, along the vorticity
  double angle = 45;    ///< of the major axis from the flow direction, degrees
};

/// The model of Maffettone and Minale (1998) for the capillary number mu gamma R / sigma; `viscosity_ratio` is inner
/// over outer. Volume is conserved: L B W = 1.
DropShape maffettone_minale(double capillary, double viscosity_ratio = 1.0);

struct CapillaryFit {
  double capillary = 0;
  double residual = 0;  ///< root mean square of the differences in L and B
};

/// The capillary number whose L and B come closest to the measured ones (least squares; unit radius at rest).
/// Throws RunError when the shape is beyond the model (no minimum for capillary numbers below 2).
CapillaryFit fit_capillary(double major, double minor, double viscosity_ratio = 1.0);

}  // namespace pliant
