// What a rigid body may do on a given surface: where a polytope can stand, and where a sphere first touches triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

namespace plumb::truth {

/// A way in which a convex polytope stands on a level plane.
struct Stand {
  Eigen::Vector3d down;  ///< outward unit normal of the face that it stands on, body frame
  double height;         ///< of its centre of mass above the plane, m
};

/// A face of a polytope: the corners p with normal . p = offset.
struct HalfSpace {
  Eigen::Vector3d normal;  ///< unit, outward
  double offset;           ///< m
};

/// All ways in which it stands without being held: on the faces over which its centre of mass lies, edges excluded.
/// Corners within `flat` (m) of a face's plane belong to the face.
[[nodiscard]] std::vector<Stand> stable_stands(std::span<const Eigen::Vector3d> corners,
                                               std::span<const HalfSpace> faces, const Eigen::Vector3d& centre,
                                               double flat);

using Triangle = std::array<Eigen::Vector3d, 3>;

struct SphereTouch {
  double distance;         ///< that the centre went before it touched, m
  Eigen::Vector3d normal;  ///< unit, from the surface to the centre
};

/// Where a sphere whose centre goes from `start` along the unit vector `direction` first touches the surface, within
/// `reach`; none when it does not. A sphere that overlaps the surface at the start and moves on into it touches at
/// once. Each triangle's face, edges and corners, grown by the radius, against the ray of the centre (Ericson,
/// Real-Time Collision Detection, 5.5.6).
[[nodiscard]] std::optional<SphereTouch> first_touch(std::span<const Triangle> surface, const Eigen::Vector3d& start,
                                                     const Eigen::Vector3d& direction, double radius, double reach);

}  // namespace plumb::truth
