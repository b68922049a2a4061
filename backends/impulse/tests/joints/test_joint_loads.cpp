// Reactions of joints, and joints that break.
#include <algorithm>

#include "tests/rigs/joint_rig.hpp"

namespace plumb::impulse {
namespace {

constexpr PlumbNeeds kLoadNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_GYROSCOPIC | PLUMB_NEED_JOINTS | PLUMB_NEED_JOINT_REACTIONS | PLUMB_NEED_EVENTS;

TEST(JointReactions, CarryWhatHangsOnThem) {
  for (const double solver : {0, 1, 2, 3})
    for (const PlumbJointType type : {PLUMB_JOINT_BALL, PLUMB_JOINT_HINGE, PLUMB_JOINT_FIXED, PLUMB_JOINT_DISTANCE,
                                      PLUMB_JOINT_UNIVERSAL, PLUMB_JOINT_GENERIC}) {
      JointRig rig(kLoadNeeds);
      rig.choose_solver(solver);
      const PlumbBody bob = rig.body({0, -1, 0}, 3);
      PlumbJointDesc desc = joint_desc(type);
      for (PlumbAxisMode& mode : desc.axis_modes) mode = PLUMB_AXIS_LOCKED;
      desc.body_b = bob;
      desc.frame_b.position = {0, type == PLUMB_JOINT_DISTANCE ? 0.0 : 1.0, 0};
      desc.rest_length = 1;
      const PlumbJoint joint = rig.join(desc);
      rig.run(2);
      const auto row = rig.reaction(joint);
      const double weight = 3 * kGravity;
      EXPECT_NEAR(row[1], weight, 1e-3 * weight) << solver << " " << type;
      for (const std::size_t i : {0U, 2U, 3U, 4U, 5U}) EXPECT_NEAR(row[i], 0, 1e-3 * weight) << solver << " " << type;
    }
}

TEST(JointReactions, AreForceAndTorqueAtFrameB) {
  JointRig rig(kLoadNeeds);
  const PlumbBody beam = rig.body({1.5, 0, 0}, 2);
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_FIXED);
  desc.body_b = beam;
  desc.frame_a.position = {0.5, 0, 0};
  desc.frame_b.position = {-1, 0, 0};
  const PlumbJoint root = rig.join(desc);
  rig.run(1);
  const auto row = rig.reaction(root);
  EXPECT_NEAR(row[1], 2 * kGravity, 1e-3);
  EXPECT_NEAR(row[5], 2 * kGravity, 1e-3);  // on an arm of 1 m, against its weight
}

TEST(JointReactions, OfASwingAtItsLowestAreThreeWeights) {
  JointRig rig(kLoadNeeds & ~PLUMB_NEED_ROTATION & ~PLUMB_NEED_GYROSCOPIC);
  const PlumbBody bob = rig.body({1, 0, 0}, 2);
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_DISTANCE);
  desc.body_b = bob;
  desc.rest_length = 1;
  const PlumbJoint rod = rig.join(desc);
  double most = 0;
  for (int i = 0; i < 60; ++i) {
    rig.step();
    const auto row = rig.reaction(rod);
    most = std::max(most, std::hypot(row[0], row[1], row[2]));
  }
  EXPECT_NEAR(most, 3 * 2 * kGravity, 0.01 * 2 * kGravity);
}

TEST(JointReactions, DoNotChangeTheMotion) {
  std::vector<PlumbPose> ends;
  for (const bool read : {false, true}) {
    JointRig rig(read ? kLoadNeeds : kLoadNeeds & ~PLUMB_NEED_JOINT_REACTIONS);
    PlumbBody before = 0;
    for (int i = 0; i < 6; ++i) {
      const PlumbBody link = rig.body({i + 0.5, 0, 0}, 1 + i, {0.01, 0.1, 0.2});
      rig.join_at(i % 2 == 0 ? PLUMB_JOINT_BALL : PLUMB_JOINT_HINGE, before, link, {1.0 * i, 0, 0});
      before = link;
    }
    rig.run(2);
    ends.push_back(rig.pose(before));
  }
  EXPECT_EQ(ends[0].position.x, ends[1].position.x);
  EXPECT_EQ(ends[0].position.y, ends[1].position.y);
  EXPECT_EQ(ends[0].orientation.z, ends[1].orientation.z);
}

TEST(JointBreaks, AboveItsStrengthAndNotBelow) {
  for (const double factor : {0.99, 1.01}) {
    JointRig rig(kLoadNeeds & ~PLUMB_NEED_JOINT_REACTIONS);
    const PlumbBody bob = rig.body({0, -1, 0}, 3);
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_FIXED);
    desc.body_b = bob;
    desc.frame_b.position = {0, 1, 0};
    desc.break_force = factor * 3 * kGravity;
    const PlumbJoint joint = rig.join(desc);
    rig.step();
    const auto events = rig.events();
    ASSERT_EQ(events.size(), factor < 1 ? 1U : 0U);
    if (factor < 1) {
      EXPECT_EQ(events[0].type, static_cast<PlumbEventType>(PLUMB_EVENT_JOINT_BROKEN));
      EXPECT_EQ(events[0].joint, joint);
      EXPECT_EQ(events[0].body_b, bob);
    }
    const double start = rig.speed(bob).linear.y;
    rig.run(1);
    EXPECT_NEAR(rig.speed(bob).linear.y - start, factor < 1 ? -kGravity : 0, 1e-3);
    EXPECT_TRUE(rig.events().empty());
  }
}

TEST(JointBreaks, ByTorque) {
  for (const double factor : {0.99, 1.01}) {
    JointRig rig(kLoadNeeds);
    const PlumbBody beam = rig.body({1, 0, 0}, 2);
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_FIXED);
    desc.body_b = beam;
    desc.frame_b.position = {-1, 0, 0};
    desc.break_torque = factor * 2 * kGravity;
    rig.join(desc);
    rig.step();
    EXPECT_EQ(rig.events().size(), factor < 1 ? 1U : 0U);
  }
}

}  // namespace
}  // namespace plumb::impulse
