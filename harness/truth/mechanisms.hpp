// Motions of single joints and of mechanisms that are driven. SI units, angles in rad.
#pragma once

namespace plumb::truth {

/// A slender rod hinged at its foot, let go at rest at an angle from upright: when it is level, and how fast it turns
/// then. w^2 = 3 g (cos(start) - cos(angle)) / L.
[[nodiscard]] double toppling_time(double g, double length, double start);
[[nodiscard]] double toppling_speed(double g, double length, double start);

/// A damped spring let go at rest at x0, damping ratio below 1: where it is at t.
[[nodiscard]] double damped_oscillation(double frequency, double damping_ratio, double x0, double t);
/// Natural logarithm of one maximum over the next.
[[nodiscard]] double logarithmic_decrement(double damping_ratio);

/// Angle of the rocker of a four-bar linkage from the line of the ground, at its ground pin, when the crank is at
/// `angle` from that line at its own; the branch on which coupler and rocker meet above. Law of cosines.
[[nodiscard]] double four_bar_rocker(double crank, double coupler, double rocker, double ground, double angle);

/// Turn of the second shaft of a universal joint whose shafts make an angle `bend`, the first one's arm at the start
/// square to the plane of both: tan(second) = tan(first) cos(bend). Counts whole turns.
[[nodiscard]] double universal_turn(double bend, double angle);

}  // namespace plumb::truth
