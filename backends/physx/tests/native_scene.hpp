// A scene as a program in plain PhysX.
#pragma once

#include <PxPhysicsAPI.h>

#include <array>

#include "scenes.hpp"

namespace scenes {

/// PhysX is started once in a process.
inline physx::PxPhysics& native_physics() {
  static physx::PxDefaultAllocator allocator;
  static physx::PxDefaultErrorCallback errors;
  static physx::PxFoundation* foundation = PxCreateFoundation(PX_PHYSICS_VERSION, allocator, errors);
  static physx::PxPhysics* started = PxCreatePhysics(PX_PHYSICS_VERSION, *foundation, physx::PxTolerancesScale());
  return *started;
}

struct NativeScene {
  explicit NativeScene(const Scene& scene) {
    physx::PxSceneDesc desc(native_physics().getTolerancesScale());
    desc.gravity = {0, -9.81f, 0};
    desc.cpuDispatcher = dispatcher = physx::PxDefaultCpuDispatcherCreate(0);
    desc.filterShader = filter;
    world = native_physics().createScene(desc);
    const float root = static_cast<float>(std::sqrt(kPlumbFriction));
    material = native_physics().createMaterial(root, root, 0);
    material->setFrictionCombineMode(physx::PxCombineMode::eMULTIPLY);
    for (const Item& item : scene.items) add(item);
    for (const Joint& joint : scene.joints) add(joint);
  }
  NativeScene(const NativeScene&) = delete;
  NativeScene& operator=(const NativeScene&) = delete;
  ~NativeScene() {
    world->release();
    dispatcher->release();
    material->release();
  }

  void step(double dt) {
    world->simulate(static_cast<float>(dt));
    world->fetchResults(true);
  }

  /// Position, orientation x y z w, velocity, angular velocity.
  std::array<double, 13> state(std::size_t i) const {
    const physx::PxTransform at = bodies[i]->getGlobalPose();
    physx::PxVec3 v(0), w(0);
    if (const auto* body = bodies[i]->is<physx::PxRigidDynamic>()) {
      v = body->getLinearVelocity();
      w = body->getAngularVelocity();
    }
    return {at.p.x, at.p.y, at.p.z, at.q.x, at.q.y, at.q.z, at.q.w, v.x, v.y, v.z, w.x, w.y, w.z};
  }

  static physx::PxFilterFlags filter(physx::PxFilterObjectAttributes, physx::PxFilterData,
                                     physx::PxFilterObjectAttributes, physx::PxFilterData, physx::PxPairFlags& flags,
                                     const void*, physx::PxU32) {
    flags = physx::PxPairFlag::eCONTACT_DEFAULT;
    return physx::PxFilterFlag::eDEFAULT;
  }
  static physx::PxVec3 vector(const PlumbVec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  }
  static physx::PxQuat quaternion(const PlumbQuat& q) {
    const double n = 1 / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return {static_cast<float>(n * q.x), static_cast<float>(n * q.y), static_cast<float>(n * q.z),
            static_cast<float>(n * q.w)};
  }

  void add(const Item& item) {
    const physx::PxTransform at(vector(item.pose.position), quaternion(item.pose.orientation));
    physx::PxRigidDynamic* moves = nullptr;
    if (item.is_static) {
      bodies.push_back(native_physics().createRigidStatic(at));
    } else {
      moves = native_physics().createRigidDynamic(at);
      bodies.push_back(moves);
    }
    if (item.is_sphere)
      physx::PxRigidActorExt::createExclusiveShape(*bodies.back(),
                                                   physx::PxSphereGeometry(static_cast<float>(item.half.x)), *material);
    else
      physx::PxRigidActorExt::createExclusiveShape(*bodies.back(), physx::PxBoxGeometry(vector(item.half)), *material);
    if (moves != nullptr) {
      moves->setMass(static_cast<float>(item.mass));
      moves->setMassSpaceInertiaTensor(vector(inertia(item)));
      moves->setAngularDamping(0);
      moves->setSleepThreshold(0);
      moves->setLinearVelocity(vector(item.velocity));
      moves->setAngularVelocity(vector(item.spin));
      moves->setRigidBodyFlag(physx::PxRigidBodyFlag::eENABLE_GYROSCOPIC_FORCES, true);
    }
    world->addActor(*bodies.back());
  }

  /// A scene's hinge turns about z.
  void add(const Joint& joint) {
    physx::PxRigidActor* a = joint.a < 0 ? nullptr : bodies[static_cast<std::size_t>(joint.a)];
    physx::PxRigidActor* b = bodies[static_cast<std::size_t>(joint.b)];
    const physx::PxQuat turn = joint.is_hinge ? quaternion(x_to_z()) : physx::PxQuat(physx::PxIdentity);
    const physx::PxTransform in_a(vector(joint.in_a), turn), in_b(vector(joint.in_b), turn);
    if (joint.is_hinge)
      PxRevoluteJointCreate(native_physics(), a, in_a, b, in_b);
    else
      PxSphericalJointCreate(native_physics(), a, in_a, b, in_b);
  }

  physx::PxDefaultCpuDispatcher* dispatcher = nullptr;
  physx::PxMaterial* material = nullptr;
  physx::PxScene* world = nullptr;
  std::vector<physx::PxRigidActor*> bodies;
};

}  // namespace scenes
