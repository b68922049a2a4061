#include "make_body.hpp"

#include <Jolt/Physics/Collision/Shape/EmptyShape.h>
#include <Jolt/Physics/Collision/Shape/OffsetCenterOfMassShape.h>

#include "layers.hpp"

namespace plumb::jolt {
namespace {

/// Of a shape's radius: centres of mass nearer to each other are one.
constexpr float kSameCentre = 1e-5f;

JPH::RefConst<JPH::Shape> shape_of(const PlumbBodyDesc& desc, const Shape* shape) {
  const bool dynamic = desc.motion == PLUMB_DYNAMIC;
  const JPH::Vec3 centre = dynamic ? vector(desc.centre_of_mass, "centre_of_mass") : JPH::Vec3::sZero();
  if (shape == nullptr) return new JPH::EmptyShape(centre);
  if (!dynamic) return shape->jolt;
  const JPH::Vec3 offset = centre - shape->jolt->GetCenterOfMass();
  if (offset.Length() <= kSameCentre * shape->jolt->GetLocalBounds().GetExtent().Length()) return shape->jolt;
  return JPH::OffsetCenterOfMassShapeSettings(offset, shape->jolt).Create().Get();
}

/// The same six bits in the same order.
JPH::EAllowedDOFs free_axes_of(const PlumbBodyDesc& desc) {
  static_assert(PLUMB_LOCK_LINEAR_X == static_cast<int>(JPH::EAllowedDOFs::TranslationX) &&
                PLUMB_LOCK_ANGULAR_Z == static_cast<int>(JPH::EAllowedDOFs::RotationZ));
  constexpr std::uint32_t all = 0b111111, turns = 0b111000;
  std::uint32_t locked = desc.locks;
  if ((desc.flags & PLUMB_BODY_NO_ROTATION) != 0) locked |= turns;
  return static_cast<JPH::EAllowedDOFs>(all & ~locked);
}

/// An axis without a moment does not turn.
JPH::Vec3 inverse_inertia(const PlumbBodyDesc& desc) {
  const auto inverse = [](double moment) { return moment > 0 ? 1 / moment : 0; };
  return vector(PlumbVec3{inverse(desc.inertia.x), inverse(desc.inertia.y), inverse(desc.inertia.z)}, "1 / inertia");
}

void put_motion(const PlumbBodyDesc& desc, JPH::BodyCreationSettings& made) {
  made.mMotionType = desc.motion == PLUMB_STATIC      ? JPH::EMotionType::Static
                     : desc.motion == PLUMB_KINEMATIC ? JPH::EMotionType::Kinematic
                                                      : JPH::EMotionType::Dynamic;
  made.mOverrideMassProperties = JPH::EOverrideMassProperties::MassAndInertiaProvided;
  made.mMassPropertiesOverride.mMass = 1;
  made.mMassPropertiesOverride.mInertia = JPH::Mat44::sIdentity();
  if (desc.motion != PLUMB_DYNAMIC) return;
  (void)inverse_inertia(desc);
  made.mAllowedDOFs = free_axes_of(desc);
  made.mMassPropertiesOverride.mMass = scalar(desc.mass, "mass");
  if (!std::isnormal(1 / made.mMassPropertiesOverride.mMass))
    throw Error(PLUMB_E_INVALID_ARGUMENT,
                "mass is " + backend::number_text(desc.mass) + ", too far from 1 for Jolt's single precision");
  if (made.mAllowedDOFs != JPH::EAllowedDOFs::None) return;
  made.mMotionType = JPH::EMotionType::Kinematic;
  made.mAllowedDOFs = JPH::EAllowedDOFs::All;
  made.mLinearVelocity = made.mAngularVelocity = JPH::Vec3::sZero();
}

}  // namespace

JPH::BodyCreationSettings body_settings(const PlumbBodyDesc& desc, const Shape* shape, const Settings& settings,
                                        bool gyroscopic) {
  JPH::BodyCreationSettings made(shape_of(desc, shape), position(desc.pose.position, "pose.position"),
                                 quaternion(desc.pose.orientation), JPH::EMotionType::Static,
                                 desc.motion == PLUMB_STATIC ? kStanding : kMoving);
  made.mLinearVelocity = vector(desc.linear_velocity, "linear_velocity");
  made.mAngularVelocity = vector(desc.angular_velocity, "angular_velocity");
  made.mIsSensor = (desc.flags & PLUMB_BODY_SENSOR) != 0;
  made.mApplyGyroscopicForce = gyroscopic;
  made.mMotionQuality =
      (desc.flags & PLUMB_BODY_CCD) != 0 ? JPH::EMotionQuality::LinearCast : JPH::EMotionQuality::Discrete;
  made.mAllowSleeping = (desc.flags & PLUMB_BODY_NEVER_SLEEPS) == 0;
  made.mEnhancedInternalEdgeRemoval = settings.internal_edge_removal;
  made.mFriction = scalar(desc.material.friction, "friction");
  made.mRestitution = static_cast<float>(desc.material.restitution);
  made.mLinearDamping = scalar(desc.linear_damping, "linear_damping");
  made.mAngularDamping = scalar(desc.angular_damping, "angular_damping");
  made.mGravityFactor = scalar(desc.gravity_scale, "gravity_scale");
  made.mMaxLinearVelocity = static_cast<float>(settings.max_linear_speed);
  made.mMaxAngularVelocity = static_cast<float>(settings.max_angular_speed);
  put_motion(desc, made);
  return made;
}

void set_inertia(JPH::Body& body, const PlumbBodyDesc& desc) {
  if (!body.IsDynamic()) return;
  JPH::MotionProperties& motion = *body.GetMotionProperties();
  constexpr auto turns = JPH::EAllowedDOFs::RotationX | JPH::EAllowedDOFs::RotationY | JPH::EAllowedDOFs::RotationZ;
  if ((motion.GetAllowedDOFs() & turns) == JPH::EAllowedDOFs::None) return;
  motion.SetInverseInertia(inverse_inertia(desc), quaternion(desc.inertia_orientation));
}

}  // namespace plumb::jolt
