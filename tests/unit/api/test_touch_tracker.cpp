// Begin and end events out of lists of touching pairs, against a set computed by brute force.
#include "plumb/backend/touch_tracker.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace plumb::backend {
namespace {

TEST(TouchTracker, EqualsSetDifferences) {
  std::mt19937 random(1);
  TouchTracker tracker;
  std::set<std::pair<PlumbBody, PlumbBody>> before;
  for (int step = 0; step < 200; ++step) {
    std::set<std::pair<PlumbBody, PlumbBody>> now;
    for (int i = 0; i < 20; ++i) {
      const PlumbBody a = (std::uint64_t{1} << 32) | (random() % 8), b = (std::uint64_t{1} << 32) | (random() % 8);
      if (a == b) continue;
      tracker.touch(a, b);
      now.insert({std::min(a, b), std::max(a, b)});
    }
    std::vector<PlumbEvent> events;
    tracker.finish_step(events);
    std::set<std::pair<PlumbBody, PlumbBody>> begun, ended;
    for (const PlumbEvent& event : events)
      (event.type == PLUMB_EVENT_CONTACT_BEGIN ? begun : ended).insert({event.body_a, event.body_b});
    EXPECT_EQ(begun.size() + ended.size(), events.size()) << "an event came twice";
    for (const auto& pair : now) EXPECT_EQ(begun.contains(pair), !before.contains(pair));
    for (const auto& pair : before) EXPECT_EQ(ended.contains(pair), !now.contains(pair));
    before = now;
  }
}

TEST(TouchTracker, ADestroyedBodyEndsItsTouchesOnce) {
  TouchTracker tracker;
  std::vector<PlumbEvent> events;
  tracker.touch(1, 2);
  tracker.touch_sensor(3, 1);
  tracker.finish_step(events);
  events.clear();
  const PlumbBody gone = 1;
  tracker.forget({&gone, 1}, events);
  ASSERT_EQ(events.size(), 2u);
  sort_events(events);
  EXPECT_EQ(events[0].type, PLUMB_EVENT_CONTACT_END);
  EXPECT_EQ(events[1].type, PLUMB_EVENT_SENSOR_LEAVE);
  EXPECT_EQ(events[1].body_a, 3u);
  events.clear();
  tracker.finish_step(events);
  EXPECT_TRUE(events.empty());
}

}  // namespace
}  // namespace plumb::backend
