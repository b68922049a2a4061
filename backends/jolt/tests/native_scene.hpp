// A scene as a program in plain Jolt.
#pragma once

#include <Jolt/Jolt.h>

#include <Jolt/Core/Factory.h>
#include <Jolt/Core/JobSystemSingleThreaded.h>
#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/Collision/GroupFilterTable.h>
#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/Constraints/HingeConstraint.h>
#include <Jolt/Physics/Constraints/PointConstraint.h>
#include <Jolt/Physics/PhysicsSystem.h>
#include <Jolt/RegisterTypes.h>

#include <array>

#include "scenes.hpp"

namespace scenes {

struct NativeJolt {
  NativeJolt() {
    if (JPH::Factory::sInstance != nullptr) return;
    JPH::RegisterDefaultAllocator();
    JPH::Factory::sInstance = new JPH::Factory();
    JPH::RegisterTypes();
  }
};

/// 0: bodies that stand; 1: bodies that move.
struct NativeLayers final : JPH::BroadPhaseLayerInterface,
                            JPH::ObjectVsBroadPhaseLayerFilter,
                            JPH::ObjectLayerPairFilter {
  JPH::uint GetNumBroadPhaseLayers() const override { return 2; }
  JPH::BroadPhaseLayer GetBroadPhaseLayer(JPH::ObjectLayer layer) const override {
    return JPH::BroadPhaseLayer(static_cast<JPH::uint8>(layer));
  }
#if defined(JPH_EXTERNAL_PROFILE) || defined(JPH_PROFILE_ENABLED)
  const char* GetBroadPhaseLayerName(JPH::BroadPhaseLayer) const override { return "layer"; }
#endif
  bool ShouldCollide(JPH::ObjectLayer a, JPH::BroadPhaseLayer b) const override {
    return a != 0 || b != JPH::BroadPhaseLayer(0);
  }
  bool ShouldCollide(JPH::ObjectLayer a, JPH::ObjectLayer b) const override { return a != 0 || b != 0; }
};

struct NativeScene {
  explicit NativeScene(const Scene& scene) {
    system.Init(1024, 0, 16384, 16384, layers, layers, layers);
    system.SetGravity({0, -9.81f, 0});
    JPH::PhysicsSettings settings;
    settings.mAllowSleeping = false;
    system.SetPhysicsSettings(settings);
    apart = new JPH::GroupFilterTable(static_cast<JPH::uint>(scene.items.size()));
    for (const Item& item : scene.items) add(item);
    for (const Joint& joint : scene.joints) add(joint);
  }

  void step(double dt) { system.Update(static_cast<float>(dt), 1, &scratch, &jobs); }

  /// Position, orientation x y z w, velocity, angular velocity.
  std::array<double, 13> state(std::size_t i) const {
    const JPH::Body& body = *bodies[i];
    const JPH::RVec3 p = body.GetPosition();
    const JPH::Quat q = body.GetRotation();
    const JPH::Vec3 none = JPH::Vec3::sZero(), v = body.IsStatic() ? none : body.GetLinearVelocity(),
                    w = body.IsStatic() ? none : body.GetAngularVelocity();
    return {p.GetX(), p.GetY(), p.GetZ(), q.GetX(), q.GetY(), q.GetZ(), q.GetW(),
            v.GetX(), v.GetY(), v.GetZ(), w.GetX(), w.GetY(), w.GetZ()};
  }

  static JPH::CollisionGroup::SubGroupID group_of(const JPH::Body& body) {
    return body.GetCollisionGroup().GetSubGroupID();
  }
  static JPH::Vec3 vector(const PlumbVec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  }
  static JPH::Quat quaternion(const PlumbQuat& q) {
    const double n = 1 / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return {static_cast<float>(n * q.x), static_cast<float>(n * q.y), static_cast<float>(n * q.z),
            static_cast<float>(n * q.w)};
  }

  void add(const Item& item) {
    const JPH::Shape* shape =
        item.is_sphere ? static_cast<const JPH::Shape*>(new JPH::SphereShape(static_cast<float>(item.half.x)))
                       : new JPH::BoxShape(vector(item.half));
    JPH::BodyCreationSettings made(shape, JPH::RVec3(vector(item.pose.position)), quaternion(item.pose.orientation),
                                   item.is_static ? JPH::EMotionType::Static : JPH::EMotionType::Dynamic,
                                   item.is_static ? 0 : 1);
    made.mLinearVelocity = vector(item.velocity);
    made.mAngularVelocity = vector(item.spin);
    made.mFriction = static_cast<float>(kPlumbFriction);
    made.mLinearDamping = made.mAngularDamping = 0;
    made.mMaxLinearVelocity = made.mMaxAngularVelocity = 1e6f;
    made.mApplyGyroscopicForce = true;
    made.mOverrideMassProperties = JPH::EOverrideMassProperties::MassAndInertiaProvided;
    made.mMassPropertiesOverride.mMass = static_cast<float>(item.mass);
    made.mMassPropertiesOverride.mInertia = JPH::Mat44::sScale(vector(inertia(item)));
    JPH::BodyInterface& interface = system.GetBodyInterface();
    bodies.push_back(interface.CreateBody(made));
    const PlumbVec3 moments = inertia(item);
    if (!item.is_static)  // as Jolt has it but for its rounding
      bodies.back()->GetMotionProperties()->SetInverseInertia(vector({1 / moments.x, 1 / moments.y, 1 / moments.z}),
                                                              JPH::Quat::sIdentity());
    bodies.back()->SetCollisionGroup({apart, 0, static_cast<JPH::uint>(bodies.size() - 1)});
    interface.AddBody(bodies.back()->GetID(),
                      item.is_static ? JPH::EActivation::DontActivate : JPH::EActivation::Activate);
  }

  /// A scene's hinge turns about z.
  void add(const Joint& joint) {
    JPH::Body& a = joint.a < 0 ? JPH::Body::sFixedToWorld : *bodies[static_cast<std::size_t>(joint.a)];
    JPH::Body& b = *bodies[static_cast<std::size_t>(joint.b)];
    if (joint.is_hinge) {
      JPH::HingeConstraintSettings settings;
      settings.mSpace = JPH::EConstraintSpace::LocalToBodyCOM;
      settings.mPoint1 = JPH::RVec3(vector(joint.in_a));
      settings.mPoint2 = JPH::RVec3(vector(joint.in_b));
      const JPH::Quat turn = quaternion(x_to_z());
      settings.mHingeAxis1 = settings.mHingeAxis2 = turn.RotateAxisX();
      settings.mNormalAxis1 = settings.mNormalAxis2 = turn.RotateAxisY();
      system.AddConstraint(settings.Create(a, b));
    } else {
      JPH::PointConstraintSettings settings;
      settings.mSpace = JPH::EConstraintSpace::LocalToBodyCOM;
      settings.mPoint1 = JPH::RVec3(vector(joint.in_a));
      settings.mPoint2 = JPH::RVec3(vector(joint.in_b));
      system.AddConstraint(settings.Create(a, b));
    }
    if (joint.a >= 0) apart->DisableCollision(group_of(a), group_of(b));
  }

  NativeJolt started;
  NativeLayers layers;
  JPH::TempAllocatorImplWithMallocFallback scratch{16u << 20};
  JPH::JobSystemSingleThreaded jobs{JPH::cMaxPhysicsJobs};
  JPH::PhysicsSystem system;
  std::vector<JPH::Body*> bodies;
  JPH::Ref<JPH::GroupFilterTable> apart;  ///< pairs with a joint
};

}  // namespace scenes
