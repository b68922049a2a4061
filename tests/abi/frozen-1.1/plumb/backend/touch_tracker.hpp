// Contact and sensor events out of "who touches whom", for engines that do not tell begin and end by themselves.
#pragma once

#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::backend {

/// Sorts events into the order that world.h states.
inline void sort_events(std::vector<PlumbEvent>& events) {
  std::sort(events.begin(), events.end(), [](const PlumbEvent& a, const PlumbEvent& b) {
    return std::tuple(a.type, slot_of(a.body_a), slot_of(a.body_b), slot_of(a.joint)) <
           std::tuple(b.type, slot_of(b.body_a), slot_of(b.body_b), slot_of(b.joint));
  });
}

/// Call touch() for every touching pair of a step (as often as you like), then finish_step(). Sorted vectors and a
/// merge: no allocation once warm.
class TouchTracker {
 public:
  /// A pair in which a sensor is: the sensor first.
  void touch_sensor(PlumbBody sensor, PlumbBody other) { now_.push_back({sensor, other, true}); }
  void touch(PlumbBody a, PlumbBody b) {
    if (slot_of(b) < slot_of(a)) std::swap(a, b);
    now_.push_back({a, b, false});
  }

  /// Appends begin and end events since the step before.
  void finish_step(std::vector<PlumbEvent>& events) {
    std::sort(now_.begin(), now_.end());
    now_.erase(std::unique(now_.begin(), now_.end()), now_.end());
    auto old = before_.begin();
    auto young = now_.begin();
    while (old != before_.end() || young != now_.end()) {
      if (young == now_.end() || (old != before_.end() && *old < *young)) {
        events.push_back(event(*old++, false));
      } else if (old == before_.end() || *young < *old) {
        events.push_back(event(*young++, true));
      } else {
        ++old;
        ++young;
      }
    }
    before_.swap(now_);
    now_.clear();
  }

  /// Bodies that were destroyed: appends the ends of what they touched, to be told with the next step's events.
  void forget(std::span<const PlumbBody> bodies, std::vector<PlumbEvent>& events) {
    std::vector<PlumbBody> sorted(bodies.begin(), bodies.end());
    std::sort(sorted.begin(), sorted.end());
    const auto is = [&](PlumbBody body) { return std::binary_search(sorted.begin(), sorted.end(), body); };
    const auto gone = [&](const Pair& pair) { return is(pair.a) || is(pair.b); };
    for (const Pair& pair : before_)
      if (gone(pair)) events.push_back(event(pair, false));
    std::erase_if(before_, gone);
  }

  struct Pair {
    PlumbBody a, b;
    bool sensor;
    friend bool operator==(const Pair&, const Pair&) = default;
    friend auto operator<=>(const Pair&, const Pair&) = default;
  };
  /// Who touched in the step before, for snapshots.
  [[nodiscard]] std::vector<Pair>& touching() { return before_; }

 private:
  static PlumbEvent event(const Pair& pair, bool begins) {
    const PlumbEventType type = pair.sensor ? (begins ? PLUMB_EVENT_SENSOR_ENTER : PLUMB_EVENT_SENSOR_LEAVE)
                                            : (begins ? PLUMB_EVENT_CONTACT_BEGIN : PLUMB_EVENT_CONTACT_END);
    return {type, 0, pair.a, pair.b, 0};
  }

  std::vector<Pair> before_, now_;
};

}  // namespace plumb::backend
