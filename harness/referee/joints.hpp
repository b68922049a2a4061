// How far a joint has drifted from what its descriptor demands (metric 9), from the poses of its bodies alone.
#pragma once

#include <array>

#include "plumb/physics_world.hpp"
#include "referee/pose.hpp"

namespace plumb::referee {

/// Coordinates of frame b seen from frame a: translations along a's axes (m), then the angles of turning about x, then
/// the new y, then the new z (rad): R = Rx Ry Rz. With one or two free rotations the angles are those of the axes that
/// the locks keep square, from -pi to pi and without a singular place; with one it is the plain angle about its axis.
/// Of a swing-twist joint they are the twist about x and the y and z of the swing's vector.
[[nodiscard]] std::array<double, 6> joint_coordinates(const PlumbJointDesc& joint, const Pose& body_a,
                                                      const Pose& body_b);

struct JointError {
  double position = 0;        ///< m: how far the origins are from where the joint allows them
  double angle = 0;           ///< rad: how far the frames are turned in ways that the joint locks
  double limit_position = 0;  ///< m: how far beyond an enabled limit
  double limit_angle = 0;     ///< rad, likewise
};

/// body_a: identity for the world. By type:
///  - ball: |gap of the origins|; hinge: that, and the angle between the x axes; fixed: that, and the whole angle;
///  - slider: distance of b's origin from a's x axis, and the whole angle; universal: gap, and how far a's x and b's y
///  are
///    from square; distance: |distance - rest_length|, unless limits[0] or the spring holds it instead;
///  - swing-twist: gap; its cone counts as a limit, beyond which it is by the angle along a meridian;
///  - generic: norm of the locked translations; with all rotations locked the whole angle, with two the angle
///    between the axes of the third, with one how far two axes are from square.
/// Limits count on the axes that the joint leaves free. Of a hinge axis 3 is the angle about x.
[[nodiscard]] JointError joint_error(const PlumbJointDesc& joint, const Pose& body_a, const Pose& body_b);

}  // namespace plumb::referee
