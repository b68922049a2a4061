// What holds a body by a point of it: a kinematic body without a shape, and a ball joint between the two.
#pragma once

#include "plumb/physics_world.hpp"

namespace plumb::ogre {

class Hand {
 public:
  static constexpr PlumbNeeds needs = PLUMB_NEED_JOINTS | PLUMB_NEED_KINEMATIC;

  /// at: in the body's frame. world outlives this. Throws Error when the engine refuses.
  Hand(IPhysicsWorld& world, PlumbBody body, const PlumbVec3& at);
  Hand(const Hand&) = delete;
  Hand& operator=(const Hand&) = delete;
  ~Hand();

  /// Before a step: it goes there as fast as a hand does, and waits for a body that is stuck.
  void reach(const PlumbVec3& target, double dt);

  [[nodiscard]] const PlumbVec3& position() const { return position_; }

 private:
  [[nodiscard]] PlumbVec3 held_point() const;

  IPhysicsWorld& world_;
  PlumbBody held_;
  PlumbVec3 at_;
  PlumbVec3 position_{};
  PlumbBody body_ = 0;
  PlumbJoint joint_ = 0;
};

}  // namespace plumb::ogre
