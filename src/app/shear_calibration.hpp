#pragma once
#include <string>
#include <vector>

#include "app/maffettone_minale.hpp"
#include "config/case_config.hpp"

namespace pliant {

/// A body's shape at one moment of a shear run: semi-axes L and B over the radius at rest, angle in degrees.
struct ShapeSample {
  double time = 0, major = 1, minor = 1, width = 1, angle = 0;
};

/// What a shear run says about the elastic constants of a body (paper, section 3.1).
struct ShearCalibration {
  std::string body;
  double shear_rate = 0;  ///< gamma, from the walls
  double radius = 0;      ///< R, of the sphere of the body's volume
  ShapeSample mean;       ///< over the window
  double window_begin = 0, window_end = 0;
  double drift = 0;  ///< of D = (L - B)/(L + B) from the first to the second half of the window, over its mean
  CapillaryFit fit;  ///< of L and B to the Maffettone-Minale model
  double surface_tension = 0;  ///< mu gamma R / Ca
  DropShape model;             ///< at the fitted Ca
};

/// The shear rate that the walls of z drive along x. Throws InputError when the case is no such shear.
double shear_rate(const CaseConfig& config);

/// Averages the samples over [window_begin, end] by time and fits. Throws RunError when the window holds fewer than two
/// samples, or when the shape is beyond the model.
ShearCalibration calibrate_shear(const std::vector<ShapeSample>& samples, double window_begin, double viscosity,
                                 double rate, double radius);

}  // namespace pliant
