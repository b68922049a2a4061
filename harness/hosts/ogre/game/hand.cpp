#include "hosts/ogre/game/hand.hpp"

#include <span>

#include "hosts/ogre/game/vectors.hpp"

namespace plumb::ogre {
namespace {

constexpr double kSpeed = 6;      // m/s
constexpr double kLength = 0.15;  // m that a held point may stay behind before the hand waits

}  // namespace

Hand::Hand(IPhysicsWorld& world, PlumbBody body, const PlumbVec3& at) : world_(world), held_(body), at_(at) {
  if (world.joints() == nullptr) throw Error(PLUMB_E_UNSUPPORTED, "it has no joints to hold a body by");
  position_ = held_point();
  PlumbBodyDesc hand = body_desc(PLUMB_KINEMATIC);
  hand.pose.position = position_;
  check(world, world.create_bodies({&hand, 1}, {&body_, 1}));
  PlumbJointDesc joint = joint_desc(PLUMB_JOINT_BALL);
  joint.body_a = body_;
  joint.body_b = body;
  joint.frame_b.position = at;
  if (const PlumbResult result = world.joints()->create_joints({&joint, 1}, {&joint_, 1}); result < 0) {
    const std::string text = world.error_text();
    world.destroy_bodies({&body_, 1});
    throw Error(result, text);
  }
}

Hand::~Hand() {
  world_.joints()->destroy_joints({&joint_, 1});
  world_.destroy_bodies({&body_, 1});
}

PlumbVec3 Hand::held_point() const {
  PlumbPose pose{};
  check(world_, world_.read(PLUMB_FIELD_POSE, {&held_, 1}, rows_over(std::span(&pose, 1))));
  return to_world(pose, at_);
}

void Hand::reach(const PlumbVec3& target, double dt) {
  if (distance(held_point(), position_) < kLength) position_ = add(position_, towards(position_, target, kSpeed * dt));
  const PlumbPose pose{position_, {0, 0, 0, 1}};
  check(world_, world_.write(PLUMB_FIELD_KINEMATIC_TARGET, {&body_, 1}, const_rows_over(std::span(&pose, 1))));
}

}  // namespace plumb::ogre
