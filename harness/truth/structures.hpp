// Statics and small motions of stacks, chains and linkages. SI units, angles in rad.
#pragma once

#include <cstddef>
#include <vector>

namespace plumb::truth {

// --- stacks ---

/// Overhang of the tip of `blocks` equal blocks, each shifted by share * length / (2 k) over the one below (k from the
/// top): the harmonic stack, which stands exactly while share <= 1.
[[nodiscard]] double harmonic_overhang(double length, std::size_t blocks, double share = 1);

/// One sphere on three equal ones that touch each other on the ground, at rest without force between the lower three.
/// Equilibrium of the top and of one lower sphere. Forces relative to the weight of one sphere.
struct FourSpheres {
  double critical_friction;  ///< of sphere on sphere, tan(beta / 2) = sqrt 3 - sqrt 2, beta from the vertical
  double ground_friction;    ///< likewise of sphere on ground
  double normal, friction;   ///< between the top and each lower sphere
  double ground;             ///< normal force of the ground on each lower sphere
};
[[nodiscard]] FourSpheres four_spheres();

// --- chains ---

/// Small motions of a hanging chain of equal slender rods with a point mass at its end, about the straight line.
struct ChainMode {
  double frequency;           ///< rad/s
  std::vector<double> shape;  ///< angle of each rod from the vertical, the largest is 1
};
/// All modes, slowest first: generalized eigenvalues of the mass and stiffness in the rods' angles.
[[nodiscard]] std::vector<ChainMode> chain_modes(double g, std::size_t rods, double rod_mass, double rod_length,
                                                 double tip_mass);

/// Equal rods hinged to each other between two points at one height. tan(phi_i) = (N / 2 - i + 1 / 2) m g / H, i
/// from 1.
struct Catenary {
  double horizontal_force;     ///< H, N
  double end_force;            ///< on each end, N
  std::vector<double> slopes;  ///< phi_i, downward positive, one a rod
  std::vector<double> depths;  ///< of the joints 0..N below the ends, m
  [[nodiscard]] double sag() const { return depths[depths.size() / 2]; }
};
[[nodiscard]] Catenary catenary(double g, std::size_t rods, double rod_mass, double rod_length, double span);

// --- linkages ---

/// Distance of the piston from the crank's axis at a crank angle from the line of the piston.
[[nodiscard]] double slider_crank(double crank, double rod, double angle);

/// A slender rod hinged at its end and let go level: speed and time at an angle below the level. w^2 = 3 g sin / L.
[[nodiscard]] double falling_rod_speed(double g, double length, double angle);
[[nodiscard]] double falling_rod_time(double g, double length, double angle);

/// Two equal slender cranks and a coupler, all of one mass: swings as a pendulum of the reduced length 5 a / 6
/// (w0^2 = 6 g / (5 a)).
[[nodiscard]] double parallelogram_period(double g, double crank, double amplitude);

}  // namespace plumb::truth
