#pragma once
#include <span>
#include <string>

#include "structure/deformable_body.hpp"

namespace pliant {

/// Largest frequency omega of small motions about the present positions: omega^2 is the largest eigenvalue in modulus
/// of M^-1/2 K M^-1/2, K the derivative of the internal forces, by power iteration with differences of forces along the
/// iterate. Starts from a fixed vector; the estimate comes from below, usually within 1 %. 0 without elastic forces.
/// Slack cords count as taut. Pinned vertices do not move; the masses of all others must be positive: the body's own,
/// or with what they take along.
double find_largest_frequency(const DeformableBody& body, std::span<const double> masses);
inline double find_largest_frequency(const DeformableBody& body) { return find_largest_frequency(body, body.masses); }

/// Largest rate at which inner damping and tethers slow the vertices down at the present positions, 1 / time, in the
/// same way. Their forces are explicit: they shorten the stable step.
double find_largest_damping_rate(const DeformableBody& body, std::span<const double> masses);

/// Longest stable step of advance_vertices for vertices of frequency omega whose drag over mass is at least
/// `drag_rate`, and which explicit damping slows down at `damping_rate` at most:
/// (omega h)^2 < 4 + 2 (drag_rate - damping_rate) h. Without both h < 2 / omega. Infinite if nothing limits it.
double stable_time_step(double omega, double drag_rate, double damping_rate = 0);

/// The same for a body: its stored largest frequency and damping rate, and its damping and the least of the given drags
/// as the drag.
double stable_time_step(const DeformableBody& body, std::span<const double> drag);

/// Fraction of the stability limit that a substep takes: the limit is that of the start, and bodies stiffen as they
/// deform.
inline constexpr double substep_safety = 0.7;

/// Substeps into which a body that is stable up to `limit` divides `time`. Throws RunError if these are more than a
/// million.
int substeps_for(double time, double limit, const std::string& body);

}  // namespace pliant
