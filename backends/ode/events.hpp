// Events between steps: what touches now and did not before, what sleeps, what broke.
#pragma once

#include <span>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::ode {

/// Two bodies as they were when seen; one may be gone by now.
struct BodyPair {
  PlumbBody a, b;
  friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

/// By slot, then generation.
[[nodiscard]] bool before(const BodyPair& x, const BodyPair& y);

class PairEvents {
 public:
  void begin_step() { events_.clear(); }
  /// Takes the pairs of this step, in any order and with repetitions, and leaves the argument empty.
  void touching(std::vector<BodyPair>& now) {
    compare(touching_, now, PLUMB_EVENT_CONTACT_BEGIN, PLUMB_EVENT_CONTACT_END);
  }
  void sensed(std::vector<BodyPair>& now) { compare(sensed_, now, PLUMB_EVENT_SENSOR_ENTER, PLUMB_EVENT_SENSOR_LEAVE); }
  void add(PlumbEventType type, PlumbBody body) { events_.push_back({type, 0, body, 0, 0}); }
  void add_broken(PlumbJoint joint) { events_.push_back({PLUMB_EVENT_JOINT_BROKEN, 0, 0, 0, joint}); }
  void end_step();

  [[nodiscard]] std::span<const PlumbEvent> events() const { return events_; }

  /// What the next step is compared with: for snapshots.
  struct Memory {
    std::vector<BodyPair> touching, sensed;
  };
  [[nodiscard]] Memory memory() const { return {touching_, sensed_}; }
  void remember(Memory memory) {
    touching_ = std::move(memory.touching);
    sensed_ = std::move(memory.sensed);
  }

 private:
  void compare(std::vector<BodyPair>& known, std::vector<BodyPair>& now, PlumbEventType begin, PlumbEventType end);

  std::vector<BodyPair> touching_, sensed_;
  std::vector<PlumbEvent> events_;
};

}  // namespace plumb::ode
