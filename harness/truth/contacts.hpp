// Impacts and dry friction in closed form. SI units; Coulomb friction, Newton restitution.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace plumb::truth {

// --- impacts ---

/// Height of the n-th apex (n from 1) of a ball dropped through `fall`: fall e^(2n).
[[nodiscard]] double bounce_apex(double fall, double restitution, int n);
/// Time from the release to the n-th impact (n from 1): t1 (1 + 2 (e + ... + e^(n-1))), t1 = sqrt(2 fall / g).
[[nodiscard]] double bounce_impact(double g, double fall, double restitution, int n);

/// Velocities after two bodies meet head on.
struct HeadOn {
  double a, b;
};
[[nodiscard]] HeadOn head_on(double mass_a, double velocity_a, double mass_b, double velocity_b, double restitution);

/// Velocities, relative to the runner's, of a row of equal spheres after one runs into the rest at rest.
/// One impact after the other, elastic: the last one takes all.
[[nodiscard]] std::vector<double> sequential_row(std::size_t spheres);
/// Newton's law at all contacts at once: the first contact parts by e, the others, at rest before, do not part.
[[nodiscard]] std::vector<double> simultaneous_row(std::size_t spheres, double restitution);

/// Two equal spheres, frictionless, of which one was at rest: velocities relative to the runner's, whose direction is
/// x. angle: of the line of centres from it, rad, in the x y plane.
struct GlancingImpact {
  Eigen::Vector3d runner, target;
};
[[nodiscard]] GlancingImpact glancing_impact(double angle, double restitution);

/// A solid sphere without spin that strikes a plane: tangential and normal speed and spin afterwards. The tangential
/// impulse is the smaller of what stops the slip, 2 m v / 7, and mu (1 + e) m v_n.
struct ObliqueImpact {
  double tangential, normal, spin;
};
[[nodiscard]] ObliqueImpact oblique_impact(double radius, double tangential, double normal, double friction,
                                           double restitution);

/// Normal velocity and spin of a body of mass m and inertia I (about the axis that it turns about) that strikes a
/// frictionless plane with the speed v on a point at the horizontal distance `lever` from its centre.
struct LeverImpact {
  double velocity;  ///< of the centre, away from the plane
  double spin;
};
[[nodiscard]] LeverImpact lever_impact(double mass, double inertia, double lever, double speed, double restitution);

/// The same, but the point sticks where it lands and the body turns about it, without rebound: the angular momentum
/// about the point is kept. height: of the centre above the point.
struct StickingImpact {
  double sideways, vertical, spin;
};
[[nodiscard]] StickingImpact sticking_impact(double mass, double inertia, double lever, double height, double speed);

/// Velocity after a sphere strikes something immovable whose surface normal is n.
[[nodiscard]] Eigen::Vector3d reflect(const Eigen::Vector3d& velocity, const Eigen::Vector3d& n, double restitution);

// --- friction ---

/// Distance that a block slides down an incline from rest; 0 when the friction holds it.
[[nodiscard]] double incline_slide(double g, double slope, double friction, double t);

/// A round body (I = k m r^2: 2/5 sphere, 1/2 cylinder, 2/3 shell) that slides without spin at first.
struct SlideToRoll {
  double speed, time, distance;  ///< when it begins to roll
};
[[nodiscard]] SlideToRoll slide_to_roll(double g, double friction, double k, double velocity, double surface_spin = 0);

/// Acceleration of a round body down an incline, and of its surface's turning (alpha r).
struct RollDown {
  double acceleration, turning;
};
[[nodiscard]] RollDown roll_down(double g, double slope, double friction, double k);

/// A cube that spins flat on the ground and stops: I = m a^2 / 6, torque mu m g lever. lever: sqrt(1/2) a when the
/// weight rests on the four corners, (sqrt 2 + asinh 1) / 6 a when it is spread evenly.
struct SpinStop {
  double time, angle;
};
[[nodiscard]] SpinStop spin_stop(double g, double friction, double side, double lever, double spin);
[[nodiscard]] double corner_lever(double side);
[[nodiscard]] double uniform_lever(double side);

/// A block set down at rest on a belt of the given speed: how long it slips, and the way of the belt under it
/// meanwhile.
struct BeltSlip {
  double time, slip;
};
[[nodiscard]] BeltSlip belt_slip(double g, double friction, double speed);

/// A box on which balls rest, pushed without the balls slipping: accelerations of both. All balls roll on the box.
struct LoadedBox {
  double box, ball;  ///< m/s2; 0 0 when the push is below the friction
};
[[nodiscard]] LoadedBox pushed_box(double g, double box_mass, double balls_mass, double friction_ground, double push);

}  // namespace plumb::truth
