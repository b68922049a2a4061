// Sensors: they see whoever overlaps them, once each, and nothing feels them.
#include <gtest/gtest.h>

#include <map>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kSensorNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                                    PLUMB_NEED_SENSORS | PLUMB_NEED_KINEMATIC | PLUMB_NEED_FILTERS;

struct Seen {
  int entered = 0, left = 0;
};

struct Sensors : ::testing::Test {
  Scene scene{engine(), kSensorNeeds, {0, 0, 0}, 1};
  std::map<std::pair<PlumbBody, PlumbBody>, Seen> seen;

  PlumbBody sensor(PlumbMotion motion, const PlumbVec3& position) {
    scene.body.flags = PLUMB_BODY_SENSOR;
    const PlumbShape box = scene.box({1, 1, 1});
    const PlumbBody id = motion == PLUMB_STATIC      ? scene.add_static(box, position)
                         : motion == PLUMB_KINEMATIC ? scene.add_kinematic(box, position)
                                                     : scene.add(box, position);
    scene.body.flags = 0;
    return id;
  }
  PlumbBody flying(const PlumbVec3& position, const PlumbVec3& velocity) {
    scene.body.linear_velocity = velocity;
    const PlumbBody id = scene.add(scene.sphere(0.25), position);
    scene.body.linear_velocity = {0, 0, 0};
    return id;
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      scene.run(1);
      for (const PlumbEvent& event : scene.world().events()) {
        Seen& pair = seen[{event.body_a, event.body_b}];
        if (event.type == PLUMB_EVENT_SENSOR_ENTER) ++pair.entered;
        if (event.type == PLUMB_EVENT_SENSOR_LEAVE) ++pair.left;
      }
    }
  }
};

TEST_F(Sensors, SeeWhoFliesThroughThem) {
  const PlumbBody gate = sensor(PLUMB_STATIC, {0, 0, 0});
  const PlumbBody through = flying({-3, 0, 0}, {4, 0, 0}), beside = flying({-3, 2, 0}, {4, 0, 0});
  const PlumbBody stays = flying({0.5, 0, 0.9}, {0, 0, 0});
  run(120);
  EXPECT_EQ((seen[{gate, through}].entered), 1);
  EXPECT_EQ((seen[{gate, through}].left), 1);
  EXPECT_EQ((seen[{gate, beside}].entered), 0);
  EXPECT_EQ((seen[{gate, stays}].entered), 1);
  EXPECT_EQ((seen[{gate, stays}].left), 0);
  EXPECT_NEAR(scene.poses()[1].position.x, 5, 1e-4) << "it was not slowed down";
}

TEST_F(Sensors, MoveAndSeeStaticsButNotEachOther) {
  const PlumbBody wall = scene.add_static(scene.box({0.2, 1, 1}), {5, 0, 0});
  const PlumbBody eye = sensor(PLUMB_KINEMATIC, {0, 0, 0}), other = sensor(PLUMB_STATIC, {2, 0, 0});
  scene.write(PLUMB_FIELD_VELOCITY, eye, {4, 0, 0, 0, 0, 0});
  run(60);
  EXPECT_EQ((seen[{eye, wall}].entered), 1);
  EXPECT_EQ((seen[{eye, other}].entered), 0);
  EXPECT_EQ((seen[{other, wall}].entered), 0);
  scene.remove(wall);
  run(1);
  EXPECT_EQ((seen[{eye, wall}].left), 1) << "of what is destroyed too";
}

TEST_F(Sensors, SeeByTheirFilter) {
  scene.body.filter.category = 2;
  scene.body.filter.mask = 4;
  const PlumbBody gate = sensor(PLUMB_STATIC, {0, 0, 0});
  scene.body.filter.category = 4;
  scene.body.filter.mask = ~0U;
  const PlumbBody wanted = flying({0, 0, 0.3}, {0, 0, 0});
  scene.body.filter.category = 1;
  const PlumbBody unwanted = flying({0, 0, -0.3}, {0, 0, 0});
  run(2);
  EXPECT_EQ((seen[{gate, wanted}].entered), 1);
  EXPECT_EQ((seen[{gate, unwanted}].entered), 0);
}

}  // namespace
}  // namespace plumb::impulse::test
