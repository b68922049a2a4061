// A scene as a program in plain Bullet.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <array>
#include <memory>

#include "scenes.hpp"

namespace scenes {

/// Bullet multiplies: bodies of .5 make pairs of .25.
inline constexpr double kNativeFriction = 0.5;

struct NativeScene {
  explicit NativeScene(const Scene& scene) {
    world.setGravity(btVector3(0, btScalar(-9.81), 0));
    for (const Item& item : scene.items) add(item);
    for (const Joint& joint : scene.joints) add(joint);
  }
  ~NativeScene() {
    for (auto& joint : joints) world.removeConstraint(joint.get());
    for (auto& body : bodies) world.removeRigidBody(body.get());
  }
  NativeScene(const NativeScene&) = delete;
  NativeScene& operator=(const NativeScene&) = delete;

  void step(double dt) { world.stepSimulation(static_cast<btScalar>(dt), 0); }

  /// Position, orientation x y z w, velocity, angular velocity.
  std::array<double, 13> state(std::size_t i) const {
    const btRigidBody& body = *bodies[i];
    const btVector3 &x = body.getWorldTransform().getOrigin(), &v = body.getLinearVelocity(),
                    &w = body.getAngularVelocity();
    btQuaternion q;
    body.getWorldTransform().getBasis().getRotation(q);
    return {x.x(), x.y(), x.z(), q.x(), q.y(), q.z(), q.w(), v.x(), v.y(), v.z(), w.x(), w.y(), w.z()};
  }

  static btVector3 vector(const PlumbVec3& v) {
    return {static_cast<btScalar>(v.x), static_cast<btScalar>(v.y), static_cast<btScalar>(v.z)};
  }
  static btQuaternion quaternion(const PlumbQuat& q) {
    return {static_cast<btScalar>(q.x), static_cast<btScalar>(q.y), static_cast<btScalar>(q.z),
            static_cast<btScalar>(q.w)};
  }

  void add(const Item& item) {
    if (shaped == nullptr || !same_shape(*shaped, item)) {
      if (item.is_sphere)
        shapes.push_back(std::make_unique<btSphereShape>(static_cast<btScalar>(item.half.x)));
      else
        shapes.push_back(std::make_unique<btBoxShape>(vector(item.half)));
      shaped = &item;
    }
    const btScalar mass = item.is_static ? btScalar(0) : static_cast<btScalar>(item.mass);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shapes.back().get(),
                                                  item.is_static ? btVector3(0, 0, 0) : vector(inertia(item)));
    info.m_startWorldTransform = btTransform(quaternion(item.pose.orientation), vector(item.pose.position));
    info.m_friction = static_cast<btScalar>(kNativeFriction);
    bodies.push_back(std::make_unique<btRigidBody>(info));
    if (!item.is_static) {
      bodies.back()->setActivationState(DISABLE_DEACTIVATION);
      bodies.back()->setLinearVelocity(vector(item.velocity));
      bodies.back()->setAngularVelocity(vector(item.spin));
    }
    world.addRigidBody(bodies.back().get());
  }

  void add(const Joint& joint) {
    btRigidBody& a = joint.a < 0 ? anchor : *bodies[static_cast<std::size_t>(joint.a)];
    btRigidBody& b = *bodies[static_cast<std::size_t>(joint.b)];
    if (joint.is_hinge) {
      // Columns x to -y, y to x would do as well for z: these are the interface's frames with x y z renamed to z x y.
      const btMatrix3x3 renamed = btMatrix3x3(quaternion(x_to_z())) * btMatrix3x3(0, 0, 1, 1, 0, 0, 0, 1, 0);
      joints.push_back(std::make_unique<btHingeConstraint>(a, b, btTransform(renamed, vector(joint.in_a)),
                                                           btTransform(renamed, vector(joint.in_b)), true));
    } else {
      joints.push_back(std::make_unique<btPoint2PointConstraint>(a, b, vector(joint.in_a), vector(joint.in_b)));
    }
    world.addConstraint(joints.back().get(), joint.a >= 0);
  }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  btRigidBody anchor{btScalar(0), nullptr, nullptr};
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  const Item* shaped = nullptr;  ///< the item that the last shape was made for; those that follow share it
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<std::unique_ptr<btTypedConstraint>> joints;
};

}  // namespace scenes
