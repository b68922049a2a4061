// Who began to touch, who parted and who hit whom how hard, each with a point, a normal, the speed at which the two
// closed and the impulse: for sounds, sparks and damage. As contact and hit events of Box2D 3 and Jolt's contact
// listener, over any engine that has events and contacts.
//
// One round a step: before_step(), the world's step, after_step(). Speeds are those before the step, for after it a
// body that was stopped has none. State of all bodies is read in two batches before the step, of those that hit
// something after it.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::helpers {

/// Of pairs in contact, which are told as hits: those that reach both. A blow that takes an engine with soft contacts
/// several steps is told in the first of them, with the impulse of that step.
struct ContactEventSettings {
  double min_speed = 1;  ///< m/s at which the two closed, >= 0; 0: in every step also those that lie on each other
  double min_impulse =
      0;  ///< N s in the step, >= 0: what is pressed and not struck; only of engines that tell impulses
};

/// A pair of bodies in a step, all its contact points as one.
struct PairContact {
  PlumbBody body_a = 0, body_b = 0;   ///< the lower slot first
  uint32_t child_a = 0, child_b = 0;  ///< as of PlumbContact, of the point that bears most
  PlumbVec3 position{};               ///< world, m: mean of the points by what they bear
  PlumbVec3 normal{};                 ///< unit, from a to b
  /// m/s, >= 0: the fastest of the points, along its normal, before the step. What the step's own gravity adds is not
  /// in it.
  double closing_speed = 0;
  /// N s along the normal in the step, >= 0; NaN where the engine does not tell.
  double impulse = std::numeric_limits<double>::quiet_NaN();
};

class ContactEvents {
 public:
  /// And PLUMB_NEED_CONTACT_IMPULSES for impulses; without it they are NaN.
  static constexpr PlumbNeeds needs = PLUMB_NEED_COLLISION | PLUMB_NEED_EVENTS | PLUMB_NEED_CONTACTS;

  /// world outlives this. Throws Error on a setting out of range.
  explicit ContactEvents(IPhysicsWorld& world, const ContactEventSettings& settings = {});

  /// From now on only pairs of which one is among these are told; empty: all.
  void watch(std::span<const PlumbBody> bodies);

  /// After all that the host does to bodies before a step, and right before it.
  void before_step();
  /// After the step, before bodies are destroyed. Throws Error when a read fails or a body in contact was not there at
  /// before_step(); then nothing of the step is told.
  void after_step();

  // Of the last step, by the slots of the bodies. They live until the next after_step().

  /// Pairs that began to touch, however slowly. Of one that parted in the same step again, or whose points the engine
  /// does not list, position and normal are NaN.
  [[nodiscard]] std::span<const PairContact> began() const { return began_; }
  /// Pairs that reach the settings, whether they touched before or not.
  [[nodiscard]] std::span<const PairContact> hits() const { return hits_; }
  /// PLUMB_EVENT_CONTACT_END as the engine tells them; a body that was destroyed is a stale handle.
  [[nodiscard]] std::span<const PlumbEvent> ended() const { return ended_; }

 private:
  struct Motion {
    PlumbVec3 linear, angular;
  };
  struct BodyState {
    PlumbBody body;
    PlumbPose pose;
    PlumbVec3 centre;  // of mass, world, m
    Motion before, after;
  };
  void sort_events();
  void sort_contacts();
  void read_touching();
  [[nodiscard]] PairContact sum_up(std::span<const PlumbContact> points) const;
  [[nodiscard]] double closing_speed(const PlumbContact& point, Motion BodyState::*when) const;
  [[nodiscard]] bool strikes(const PairContact& pair, std::span<const PlumbContact> points) const;
  [[nodiscard]] bool goes_on(const PairContact& pair) const;
  [[nodiscard]] bool is_watched(PlumbBody a, PlumbBody b) const;

  IPhysicsWorld& world_;
  ContactEventSettings settings_;
  std::vector<PlumbBody> watched_;  // sorted
  std::vector<PlumbBody> bodies_;   // before the step
  std::vector<PlumbPose> poses_;    // theirs
  std::vector<double> velocities_;  // rows of PLUMB_FIELD_VELOCITY, theirs
  std::vector<BodyState> states_;   // by slot
  std::vector<PlumbEvent> begins_;
  std::vector<PlumbContact> points_;                  // the lower slot first, sorted by pair
  std::vector<PairContact> began_, hits_, striking_;  // striking: all that reach the settings, also in a later step
  std::vector<PlumbEvent> ended_;
};

}  // namespace plumb::helpers
