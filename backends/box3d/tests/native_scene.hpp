// A scene as a program in plain Box3D.
#pragma once

#include <box3d/box3d.h>

#include <array>
#include <numbers>

#include "scenes.hpp"

namespace scenes {

struct NativeScene {
  explicit NativeScene(const Scene& scene) {
    b3WorldDef def = b3DefaultWorldDef();
    def.gravity = {0, -9.81f, 0};
    def.enableSleep = false;
    world = b3CreateWorld(&def);
    const b3BodyDef ground = b3DefaultBodyDef();
    anchor = b3CreateBody(world, &ground);
    for (const Item& item : scene.items) add(item);
    for (const Joint& joint : scene.joints) add(joint);
  }
  ~NativeScene() { b3DestroyWorld(world); }
  NativeScene(const NativeScene&) = delete;
  NativeScene& operator=(const NativeScene&) = delete;

  void step(double dt) { b3World_Step(world, static_cast<float>(dt), 4); }

  /// Position, orientation x y z w, velocity, angular velocity.
  std::array<double, 13> state(std::size_t i) const {
    const b3WorldTransform at = b3Body_GetTransform(bodies[i]);
    const b3Vec3 v = b3Body_GetLinearVelocity(bodies[i]), w = b3Body_GetAngularVelocity(bodies[i]);
    return {at.p.x, at.p.y, at.p.z, at.q.v.x, at.q.v.y, at.q.v.z, at.q.s, v.x, v.y, v.z, w.x, w.y, w.z};
  }

  static b3Vec3 vector(const PlumbVec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  }
  static b3Quat quaternion(const PlumbQuat& q) {
    const double n = 1 / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return {vector({n * q.x, n * q.y, n * q.z}), static_cast<float>(n * q.w)};
  }

  void add(const Item& item) {
    b3BodyDef def = b3DefaultBodyDef();
    def.type = item.is_static ? b3_staticBody : b3_dynamicBody;
    def.position = vector(item.pose.position);
    def.rotation = quaternion(item.pose.orientation);
    def.linearVelocity = vector(item.velocity);
    def.angularVelocity = vector(item.spin);
    bodies.push_back(b3CreateBody(world, &def));
    b3ShapeDef shape = b3DefaultShapeDef();
    shape.density = 0;
    shape.baseMaterial.friction = static_cast<float>(kPlumbFriction);
    if (item.is_sphere) {
      const b3Sphere sphere{{0, 0, 0}, static_cast<float>(item.half.x)};
      b3CreateSphereShape(bodies.back(), &shape, &sphere);
    } else {
      const b3Vec3 half = vector(item.half);
      const b3BoxHull box = b3MakeBoxHull(half.x, half.y, half.z);
      b3CreateHullShape(bodies.back(), &shape, &box.base);
    }
    if (item.is_static) return;
    const b3Vec3 moments = vector(inertia(item));
    b3MassData mass{};
    mass.mass = static_cast<float>(item.mass);
    mass.inertia = {{moments.x, 0, 0}, {0, moments.y, 0}, {0, 0, moments.z}};
    b3Body_SetMassData(bodies.back(), mass);
  }

  /// A scene's hinge turns about z as Box3D's does. Ours turns about x of a turned frame, which is z turned twice.
  void add(const Joint& joint) {
    const auto join = [&](b3JointDef& base) {
      base.bodyIdA = joint.a < 0 ? anchor : bodies[static_cast<std::size_t>(joint.a)];
      base.bodyIdB = bodies[static_cast<std::size_t>(joint.b)];
      base.localFrameA.p = vector(joint.in_a);
      base.localFrameB.p = vector(joint.in_b);
    };
    if (joint.is_hinge) {
      b3RevoluteJointDef def = b3DefaultRevoluteJointDef();
      join(def.base);
      b3CreateRevoluteJoint(world, &def);
    } else {
      b3SphericalJointDef def = b3DefaultSphericalJointDef();
      join(def.base);
      b3CreateSphericalJoint(world, &def);
    }
  }

  b3WorldId world{};
  b3BodyId anchor{};
  std::vector<b3BodyId> bodies;
};

}  // namespace scenes
