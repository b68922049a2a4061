// What readers of robots' files share: a link becomes a body with a shape, a joint's axes become a frame.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "convert/imported.hpp"
#include "referee/pose.hpp"
#include "scene/model.hpp"

namespace plumb::harness {

/// One shape of a link, in the link's frame.
struct LinkShape {
  SceneShape shape;  ///< a plane or a mesh: only of a link that does not move
  referee::Pose pose;
  PlumbMaterial material{};
};

struct LinkMass {
  double mass = 0;                                ///< kg; 0: from the shapes, of density 1000
  referee::Vec3 centre = referee::Vec3::Zero();   ///< in the link's frame
  referee::Mat3 inertia = referee::Mat3::Zero();  ///< about the centre, in the link's axes
};

struct Link {
  std::string name;
  referee::Pose pose;  ///< in the world of the scene
  bool moves = true;
  LinkMass mass;
  std::vector<LinkShape> shapes;
  PlumbFilter filter{};
};

/// One axis of a joint, of b seen from a.
struct JointAxis {
  referee::Vec3 direction = referee::Vec3::UnitX();         ///< world
  std::optional<std::array<double, 2>> limits;              ///< m or rad
  double friction = 0;                                      ///< N or N m that it takes to move it
  double damping = 0;                                       ///< N s/m or N m s/rad
  double stiffness = 0, rest = 0;                           ///< N/m or N m/rad, about a place, m or rad
  double effort = std::numeric_limits<double>::infinity();  ///< most that its motor gives, N or N m
};

[[nodiscard]] SceneShape sphere_shape(double radius);
[[nodiscard]] SceneShape box_shape_of(const referee::Vec3& half_extents);
[[nodiscard]] SceneShape capsule_shape(double radius, double half_height);
[[nodiscard]] SceneShape cylinder_shape(double radius, double half_height);
[[nodiscard]] SceneShape plane_shape();
/// A hull of points on the ellipsoid.
[[nodiscard]] SceneShape ellipsoid_shape(const referee::Vec3& radii);
/// Of what moves the convex hull; else all triangles. Throws UsageError for what is flat and moves.
[[nodiscard]] SceneShape surface_shape(const Model& model, bool moves, const std::string& name, Remarks& remarks);

/// Adds the link as a body, its planes and meshes beside others as bodies of their own. Returns the body's index.
std::size_t add_link(Imported& imported, const Link& link);

/// A frame with the origin there, x along the first direction, y as near as may be to the second.
[[nodiscard]] referee::Pose frame_of(const referee::Vec3& origin, const referee::Vec3& x,
                                     const referee::Vec3& y = referee::Vec3::Zero());

struct JointPlace {
  PlumbJointType type;
  std::optional<std::size_t> body_a;  ///< by index; none: the world
  std::size_t body_b;
  referee::Pose world;    ///< where both frames are at the start
  std::size_t first = 3;  ///< the scene's axis, 0 to 5, of the first that is given
};
/// Adds a joint with these axes, one after the other from the first on.
void add_joint(Imported& imported, const std::string& name, const JointPlace& place,
               const std::vector<JointAxis>& axes);

/// Limits, friction and effort of an axis, 0 to 5, of the joint that was added last.
void set_axis(Imported& imported, std::size_t axis, const JointAxis& from);

}  // namespace plumb::harness
