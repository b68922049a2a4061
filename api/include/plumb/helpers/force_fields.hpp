// Fields of force over batches of bodies: gravity zones, wind, buoyancy; and explosions.
//
// One round a step: gather(), add what acts, apply(), then the world's step. State is read in three batches and forces
// are written in two, however many fields there are.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::helpers {

/// A sphere in which a field acts; radius 0: everywhere.
struct Zone {
  PlumbVec3 centre{};
  double radius = 0;  ///< m, >= 0
};

/// The same acceleration for all within.
struct DirectionalGravity {
  Zone zone;
  PlumbVec3 acceleration{0, -9.81, 0};  ///< m/s2
};

/// Towards a point: strength (m/s2, at reference_distance) times (reference_distance / distance)^exponent.
struct PointGravity {
  Zone zone;  ///< pulls to its centre
  double strength = 9.81;
  double reference_distance = 1;  ///< m, > 0; nearer than that it is `strength`
  double exponent = 2;            ///< 2: Newton, 0: the same at every distance, -1: a spring
};

/// Drag of the air, quadratic in the speed against it: 1/2 density coefficient area |v| v.
struct Wind {
  Zone zone;
  PlumbVec3 velocity{};  ///< m/s
  double density = 1.2;  ///< kg/m3
  double drag_area = 1;  ///< m2: drag coefficient times area, of each body
};

/// A surface of triangles, closed and counter-clockwise seen from outside, that displaces water. Body frame, m.
struct Hull {
  std::vector<PlumbVec3> vertices;
  std::vector<std::uint32_t> indices;
};
[[nodiscard]] Hull box_hull(const PlumbVec3& half_extents);
/// A prism of `sides` sides that has a cylinder's volume, along local y.
[[nodiscard]] Hull cylinder_hull(double radius, double half_height, std::uint32_t sides = 32);

/// What lies below a plane, and where its middle is (world, m).
struct Submerged {
  double volume = 0;  ///< m3
  PlumbVec3 centroid{};
};
/// Below the plane through `point` with the unit normal `up`. The spherical cap in closed form.
[[nodiscard]] Submerged submerged_sphere(const PlumbVec3& centre, double radius, const PlumbVec3& point,
                                         const PlumbVec3& up);
/// Triangles clipped at the plane and summed as tetrahedra whose apex lies in it, so that the cut needs no lid. Any
/// closed surface.
[[nodiscard]] Submerged submerged_hull(const Hull& hull, const PlumbPose& pose, const PlumbVec3& point,
                                       const PlumbVec3& up);

struct Water {
  PlumbVec3 point{};          ///< on the surface
  PlumbVec3 up{0, 1, 0};      ///< unit
  double density = 1000;      ///< kg/m3
  double gravity = 9.81;      ///< m/s2, against up
  PlumbVec3 flow{};           ///< m/s
  double linear_drag = 0.5;   ///< 1/s, of the displaced mass against the flow
  double angular_drag = 0.5;  ///< 1/s, of the body's inertia times the share below
};

class ForceFields {
 public:
  static constexpr PlumbNeeds needs = PLUMB_NEED_FORCES;

  /// world outlives this; bodies are dynamic. Throws Error where the world did not declare PLUMB_NEED_FORCES.
  ForceFields(IPhysicsWorld& world, std::span<const PlumbBody> bodies);

  /// Reads where the bodies are and begins with no force.
  void gather();
  void add(const DirectionalGravity& field);
  void add(const PointGravity& field);
  void add(const Wind& field);
  /// `index` is that of the body among those given; its shape is what displaces water.
  void float_sphere(std::size_t index, double radius, const Water& water);
  void float_hull(std::size_t index, const Hull& hull, const Water& water);
  /// Writes the sum for the next step.
  void apply();

  /// Sum so far: of a body, N at its centre of mass.
  [[nodiscard]] const PlumbVec3& force(std::size_t index) const { return forces_[index]; }

 private:
  void add_water(std::size_t index, const Submerged& below, double volume, const Water& water);
  [[nodiscard]] bool within(const Zone& zone, std::size_t index) const;

  IPhysicsWorld& world_;
  std::vector<PlumbBody> bodies_;
  std::vector<double> masses_;  // rows of PLUMB_FIELD_MASS
  std::vector<PlumbPose> poses_;
  std::vector<double> velocities_;  // rows of PLUMB_FIELD_VELOCITY
  std::vector<PlumbVec3> centres_, forces_, torques_;
};

struct Explosion {
  PlumbVec3 centre{};
  double radius = 5;     ///< m, > 0: nothing beyond
  double impulse = 100;  ///< N s at the centre, falls to 0 at the radius linearly
  bool line_of_sight =
      false;  ///< spares bodies behind others, by a ray to each centre of mass; needs PLUMB_NEED_QUERIES
};
/// Pushes bodies away from the centre, each at its centre of mass, in one batch. A body at the centre goes up. Returns
/// how many were hit. Throws Error when the world lacks PLUMB_NEED_FORCES, or rays that are asked for.
std::size_t explode(IPhysicsWorld& world, std::span<const PlumbBody> bodies, const Explosion& explosion);

}  // namespace plumb::helpers
