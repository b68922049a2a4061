// Gears, racks and pinions, as a constraint of the adapter's own. Jolt's gear gives its second wheel the same torque as
// the first, whatever the ratio, and both of Jolt's take no bodies but dynamic ones and drift where no hinge is named.
//
// One row: C' = along (v_a - v_b) + about_a w_a + about_b w_b = 0. Of a gear along is 0, about_a the first axis and
// about_b the second times the ratio. Of a rack it is what passes at the pitch point, times the ratio: rad/s of the
// pinion.
//
// This file is compiled without run-time type information, as Jolt is.
#include <Jolt/Jolt.h>

#include <Jolt/Physics/Body/Body.h>
#include <Jolt/Physics/Constraints/GearConstraint.h>
#include <Jolt/Physics/StateRecorder.h>

#include "joints/joint.hpp"

namespace plumb::jolt {
namespace {

class Meshing final : public JPH::TwoBodyConstraint {
 public:
  Meshing(const PlumbJointDesc& desc, const Ends& ends)
      : TwoBodyConstraint(ends.a, ends.b, JPH::GearConstraintSettings()),
        is_rack_(desc.type == PLUMB_JOINT_RACK_AND_PINION),
        ratio_(number(desc.ratio)),
        a_(ends.frame_a),
        b_(ends.frame_b) {
    remember();
  }

  JPH::EConstraintSubType GetSubType() const override { return JPH::EConstraintSubType::User1; }
  void NotifyShapeChanged(const JPH::BodyID& body, JPH::Vec3Arg moved) override {
    if (mBody1->GetID() == body) a_.origin -= moved;
    if (mBody2->GetID() == body) b_.origin -= moved;
  }
  void ResetWarmStart() override { impulse_ = 0; }
  void SetupVelocityConstraint(float /*dt*/) override {
    measure();
    set_up();
  }
  void WarmStartVelocityConstraint(float ratio) override {
    impulse_ *= ratio;
    push(impulse_);
  }
  bool SolveVelocityConstraint(float /*dt*/) override {
    const float more = -effective_mass_ * rate();
    impulse_ += more;
    push(more);
    return more != 0;
  }
  bool SolvePositionConstraint(float /*dt*/, float baumgarte) override {
    measure();
    set_up();
    const float more = -effective_mass_ * baumgarte * error_;
    if (more == 0) return false;
    if (mBody1->IsDynamic()) {
      mBody1->AddPositionStep(more * mBody1->GetMotionProperties()->GetInverseMass() * along_);
      mBody1->AddRotationStep(more * turned_a_);
    }
    if (mBody2->IsDynamic()) {
      mBody2->SubPositionStep(more * mBody2->GetMotionProperties()->GetInverseMass() * along_);
      mBody2->AddRotationStep(more * turned_b_);
    }
    return true;
  }
  void SaveState(JPH::StateRecorder& to) const override {
    TwoBodyConstraint::SaveState(to);
    to.Write(impulse_);
    to.Write(error_);
    to.Write(before_.turn_a);
    to.Write(before_.turn_b);
    to.Write(before_.passed);
  }
  void RestoreState(JPH::StateRecorder& from) override {
    TwoBodyConstraint::RestoreState(from);
    from.Read(impulse_);
    from.Read(error_);
    from.Read(before_.turn_a);
    from.Read(before_.turn_b);
    from.Read(before_.passed);
  }
#ifdef JPH_DEBUG_RENDERER
  void DrawConstraint(JPH::DebugRenderer* /*renderer*/) const override {}
#endif
  JPH::Ref<JPH::ConstraintSettings> GetConstraintSettings() const override { return new JPH::GearConstraintSettings(); }
  JPH::Mat44 GetConstraintToBody1Matrix() const override { return matrix_of(a_); }
  JPH::Mat44 GetConstraintToBody2Matrix() const override { return matrix_of(b_); }

  [[nodiscard]] Impulse on_b() const { return {to_plumb(-impulse_ * along_), to_plumb(impulse_ * about_b_)}; }

 private:
  static JPH::Mat44 matrix_of(const Frame& frame) {
    return JPH::Mat44(JPH::Vec4(frame.x, 0), JPH::Vec4(frame.y, 0), JPH::Vec4(frame.x.Cross(frame.y), 0),
                      JPH::Vec4(frame.origin, 1));
  }

  /// How far the line is past the pinion's axis.
  [[nodiscard]] float passed() const {
    const JPH::RVec3 at_a = mBody1->GetCenterOfMassTransform() * a_.origin,
                     at_b = mBody2->GetCenterOfMassTransform() * b_.origin;
    return JPH::Vec3(at_b - at_a).Dot(mBody2->GetRotation() * b_.x);
  }
  void remember() { before_ = {mBody1->GetRotation(), mBody2->GetRotation(), is_rack_ ? passed() : 0}; }

  /// By which a body has turned about an axis.
  static float turned(JPH::QuatArg before, JPH::QuatArg now, JPH::Vec3Arg axis) {
    JPH::Quat turn = now * before.Conjugated();
    if (turn.GetW() < 0) turn = -turn;
    return 2 * std::atan2(turn.GetXYZ().Dot(axis), turn.GetW());
  }
  void measure() {
    const JPH::Quat turn_a = mBody1->GetRotation(), turn_b = mBody2->GetRotation();
    error_ += turned(before_.turn_a, turn_a, turn_a * a_.x);
    error_ += is_rack_ ? -ratio_ * (passed() - before_.passed) : ratio_ * turned(before_.turn_b, turn_b, turn_b * b_.x);
    remember();
  }

  void set_up() {
    const JPH::Vec3 axis = mBody1->GetRotation() * a_.x, other = mBody2->GetRotation() * b_.x;
    along_ = JPH::Vec3::sZero();
    about_a_ = axis;
    about_b_ = ratio_ * other;
    if (is_rack_) {
      const JPH::RVec3 pitch = mBody1->GetCenterOfMassTransform() * a_.origin + other.Cross(axis) / ratio_;
      along_ = ratio_ * other;
      about_a_ = JPH::Vec3(pitch - mBody1->GetCenterOfMassPosition()).Cross(along_);
      about_b_ = along_.Cross(JPH::Vec3(pitch - mBody2->GetCenterOfMassPosition()));
    }
    turned_a_ = turned_by(*mBody1, about_a_);
    turned_b_ = turned_by(*mBody2, about_b_);
    const float inverse = about_a_.Dot(turned_a_) + about_b_.Dot(turned_b_) +
                          along_.LengthSq() * (inverse_mass(*mBody1) + inverse_mass(*mBody2));
    effective_mass_ = inverse > 0 ? 1 / inverse : 0;
    if (inverse <= 0) impulse_ = 0;
  }
  static JPH::Vec3 turned_by(const JPH::Body& body, JPH::Vec3Arg torque) {
    if (!body.IsDynamic()) return JPH::Vec3::sZero();
    return body.GetMotionProperties()->MultiplyWorldSpaceInverseInertiaByVector(body.GetRotation(), torque);
  }
  static float inverse_mass(const JPH::Body& body) {
    return body.IsDynamic() ? body.GetMotionProperties()->GetInverseMass() : 0;
  }
  [[nodiscard]] float rate() const {
    return along_.Dot(mBody1->GetLinearVelocity() - mBody2->GetLinearVelocity()) +
           about_a_.Dot(mBody1->GetAngularVelocity()) + about_b_.Dot(mBody2->GetAngularVelocity());
  }
  void push(float impulse) {
    if (mBody1->IsDynamic()) {
      JPH::MotionProperties& motion = *mBody1->GetMotionProperties();
      motion.AddLinearVelocityStep(impulse * motion.GetInverseMass() * along_);
      motion.AddAngularVelocityStep(impulse * turned_a_);
    }
    if (mBody2->IsDynamic()) {
      JPH::MotionProperties& motion = *mBody2->GetMotionProperties();
      motion.SubLinearVelocityStep(impulse * motion.GetInverseMass() * along_);
      motion.AddAngularVelocityStep(impulse * turned_b_);
    }
  }

  bool is_rack_;
  float ratio_;
  Frame a_, b_;
  struct {
    JPH::Quat turn_a, turn_b;
    float passed;
  } before_{};
  float error_ = 0;  ///< rad
  float impulse_ = 0, effective_mass_ = 0;
  JPH::Vec3 along_ = JPH::Vec3::sZero(), about_a_ = JPH::Vec3::sZero(), about_b_ = JPH::Vec3::sZero();
  JPH::Vec3 turned_a_ = JPH::Vec3::sZero(), turned_b_ = JPH::Vec3::sZero();  ///< by about_a and about_b
};

}  // namespace

JPH::Ref<JPH::TwoBodyConstraint> make_meshing(const PlumbJointDesc& desc, const Ends& ends) {
  return new Meshing(desc, ends);
}

Impulse meshing_impulse(const JPH::TwoBodyConstraint& constraint) {
  return static_cast<const Meshing&>(constraint).on_b();
}

}  // namespace plumb::jolt
