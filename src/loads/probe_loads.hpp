#pragma once
#include <span>
#include <vector>

#include "loads/surface_sites.hpp"
#include "transfer/flow_sample.hpp"

namespace pliant {

/// How the viscous traction at the surface follows from the flow at the end of a probe.
enum class ProbeForm {
  gradient,   ///< mu (grad u + grad u^T) n at the probe's end (the paper): first order in h
  one_sided,  ///< mu ((u - V)/(h - s_0) - dn/dt), the velocity linear near the surface: first order in h
  quadratic,  ///< the velocity quadratic, the pressure linear near the surface: second order in h
};

/// Where a flow that direct forcing holds takes the velocity of the surface: so many spacings outside the markers. The
/// force is spread over about a cell, and with u rising by mu u' = integral of f through that layer, the velocity that
/// markers find, a mean over the layer, is met outside its middle (W.-P. Breugem, J. Comput. Phys. 231, 2012). Measured
/// 0.20 to 0.31 on a resolved sphere: bench/markers.md. Markers that stand inside a closed body (marker_retraction)
/// meet the flow's surface at its own: 0 then.
inline constexpr double forced_surface_offset = 0.25;

/// Which sides of a surface the fluid touches: closed bodies are wetted outside, membranes on both sides.
enum class Wetting { outside, both_sides };

/// What the probes of a body need to know.
struct ProbeSettings {
  ProbeForm form = ProbeForm::one_sided;
  Wetting wetting = Wetting::outside;
  double length = 0;       ///< h, of a probe; above the offset
  double offset = 0;       ///< s_0: the velocity of the flow is V so far outside the surface; 0 for a sharp surface
  double density = 1.0;    ///< of the fluid
  double viscosity = 1.0;  ///< dynamic
  Vec3 body_force;         ///< uniform force per unit mass g that acts on the fluid and is balanced within its pressure
};

/// Stresses on one side of a surface, by face.
struct SideLoads {
  std::vector<double> pressure;  ///< at the surface
  std::vector<Vec3> shear;       ///< tangential part of the viscous traction on the surface
};

/// Loads on a surface, by face. `inner` is empty unless both sides are wetted; it is the side that normals point away
/// from.
struct ProbeLoads {
  SideLoads outer, inner;
  std::vector<Vec3> forces;  ///< of all sides, area included
};

/// Where the flow must be sampled: by side (outer, inner), then, for `quadratic`, by distance (h, 2 h), then by face.
/// Probes that leave the box are for the sampler to find.
void probe_points(const SurfaceSites& sites, const ProbeSettings& settings, std::vector<Vec3>& points);

/// Loads from the flow at the points of probe_points. With n the normal into the fluid of a side, V the surface's
/// velocity, a its acceleration, s its stretch rate, and u, p the flow at the distance h (numerics: section
/// "Hydrodynamic loads"):
///
///   force on the side = (-p_surface n + t) A, summed over the sides;
///   gradient, one_sided:  p_surface = p + rho h (a - g).n   (from dp/dn = -rho (a - g).n, viscous part neglected)
///   quadratic:            p_surface = 2 p(h) - p(2 h)
///   gradient:             t = mu (grad u + grad u^T) n
///   one_sided:            t = mu ((u - V)/(h - s_0) - dn/dt)
///   quadratic:            t = mu (T u_n - dn/dt - 2 s n),  u_n = 2 (u - V)/(h - s_0) - grad u n,  T = 1 - n n^T
///
/// dn/dt takes out the turning of the surface: without it a rigidly rotating fluid would exert a stress. `one_sided`
/// counts the normal viscous stress of a stretching surface by half. The last form uses that the stress of an
/// incompressible fluid at a surface is mu (du/dn + n (n.du/dn) - dn/dt), n.du/dn = -s.
void evaluate_probes(const SurfaceSites& sites, const ProbeSettings& settings, std::span<const FlowSample> samples,
                     ProbeLoads& loads);

}  // namespace pliant
