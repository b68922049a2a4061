// Constraints of ours that Bullet's solvers solve with its own: the distance of two points, gears and racks, and
// springs on a joint's axes.
#pragma once

#include "bullet_math.hpp"

namespace plumb::bullet {

/// One row of a constraint: relative velocity = linear . (v_b - v_a) + torques. Filled anew in each sub-step.
struct Row {
  btVector3 linear;                ///< on b at its centre of mass, opposite on a
  btVector3 angular_a, angular_b;  ///< rad^-1 of the coordinate

  /// Inverse of the effective mass.
  [[nodiscard]] btScalar inverse_mass(const btRigidBody& a, const btRigidBody& b) const;
  /// Including what forces and gravity add in this sub-step.
  [[nodiscard]] btScalar velocity(const btRigidBody& a, const btRigidBody& b, btScalar h) const;
  void write(btTypedConstraint::btConstraintInfo2& info) const;
};

/// Makes a row of a constraint the impulse of a spring over a sub-step of h seconds. x: how far it is from rest. The
/// position enters as it is, so that an undamped spring neither gains nor loses energy; one by its frequency that turns
/// by more than a radian a sub-step is softened to that, because it could not be followed, and a stiff one by stiffness
/// is a soft constraint.
void put_spring(const PlumbSpring& spring, btScalar x, const Row& row, const btRigidBody& a, const btRigidBody& b,
                btScalar h, btTypedConstraint::btConstraintInfo2& info, int index);

/// Bullet asks its own constraint types for parameters; ours have none.
class RowConstraint : public btTypedConstraint {
 public:
  using btTypedConstraint::btTypedConstraint;
  void setParam(int /*number*/, btScalar /*value*/, int /*axis*/) override {}
  [[nodiscard]] btScalar getParam(int /*number*/, int /*axis*/) const override { return 0; }
};

/// Holds the distance of the frames' origins: rigidly, within limits, or by a spring.
class DistanceConstraint final : public RowConstraint {
 public:
  DistanceConstraint(btRigidBody& a, btRigidBody& b, const btVector3& point_a, const btVector3& point_b,
                     const PlumbJointDesc& desc);
  /// Where its spring rests, or what it holds where there is none, m.
  void rest_at(btScalar length);
  void getInfo1(btConstraintInfo1* info) override;
  void getInfo2(btConstraintInfo2* info) override;

 private:
  btVector3 point_a_, point_b_;  ///< seen from the bodies' transforms
  btScalar rest_, lower_, upper_;
  PlumbSpring spring_;
};

/// Holds the ratio of what two bodies do, by their speeds alone: a gear, or a rack and its pinion (joints.h).
class MeshConstraint final : public RowConstraint {
 public:
  /// frames: seen from the bodies' transforms.
  MeshConstraint(btRigidBody& a, btRigidBody& b, const btTransform& frame_a, const btTransform& frame_b,
                 const PlumbJointDesc& desc);
  void getInfo1(btConstraintInfo1* info) override;
  void getInfo2(btConstraintInfo2* info) override;

 private:
  btTransform frame_a_, frame_b_;
  btScalar ratio_;
  bool is_rack_;
};

/// A spring on one of a joint's six axes.
class AxisSpring final : public RowConstraint {
 public:
  /// frames: seen from the bodies' transforms.
  AxisSpring(btRigidBody& a, btRigidBody& b, const btTransform& frame_a, const btTransform& frame_b, int axis,
             const PlumbJointDesc& desc);
  [[nodiscard]] std::size_t axis() const { return static_cast<std::size_t>(axis_); }
  void rest_at(double rest) { spring_.rest = rest; }
  void getInfo1(btConstraintInfo1* info) override;
  void getInfo2(btConstraintInfo2* info) override;

 private:
  btTransform frame_a_, frame_b_;
  int axis_;
  PlumbJointType type_;
  PlumbSpring spring_;
};

/// Angles x y z of a rotation R = Rx(x) Ry(y) Rz(z), each in -pi..pi, y in -pi/2..pi/2.
btVector3 angles_xyz(const btMatrix3x3& r);

}  // namespace plumb::bullet
