// What a scene does not declare is left out of the step, and with it work but not a bit of the results.
#include <gtest/gtest.h>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr const char* kSolvers[] = {"tgs_soft", "si", "jacobi", "xpbd"};

/// Pushed and braked, all of them, and far enough apart to meet nobody.
std::uint64_t hash_of_flight(PlumbNeeds needs, const char* solver, std::uint32_t flags) {
  Scene scene(engine(), needs | PLUMB_NEED_FORCES | PLUMB_NEED_DAMPING, kDown, 1, {"solver", solver});
  scene.body.flags = flags;
  scene.body.mass_mode = PLUMB_MASS_EXPLICIT;
  scene.body.material.friction = 0;
  scene.body.linear_damping = 0.1;
  scene.body.angular_damping = 0.2;
  const bool turns = (flags & PLUMB_BODY_NO_ROTATION) == 0;
  for (int i = 0; i < 70; ++i) {
    scene.body.mass = 1 + 0.1 * i;
    scene.body.inertia = turns ? PlumbVec3{1, i % 3 == 0 ? 1.0 : 1.4, i % 3 == 0 ? 1.0 : 2.1} : PlumbVec3{0, 0, 0};
    scene.body.linear_velocity = {0.3, 1.0 * i, 0};
    scene.body.angular_velocity = turns ? PlumbVec3{1, 0.2 * i, -3} : PlumbVec3{0, 0, 0};
    scene.add(0, {3.0 * i, 0, 0});
  }
  const std::vector<PlumbBody> bodies(scene.world().bodies().begin(), scene.world().bodies().end());
  scene.before_step = [&](Scene& now, int step) {
    const PlumbBody pushed = bodies[static_cast<std::size_t>(step) % bodies.size()];
    now.write(PLUMB_FIELD_FORCE, pushed, {1, 2, 3});
    now.write(PLUMB_FIELD_TORQUE, pushed, {-1, 0.5, 0.1});
  };
  scene.run(80);
  return scene.hash();
}

TEST(Needs, BodiesThatFlyAloneGoAsThroughTheSolver) {
  for (const char* solver : kSolvers)
    for (const PlumbNeeds needs : {PLUMB_NEED_ROTATION, PLUMB_NEED_ROTATION | PLUMB_NEED_GYROSCOPIC})
      EXPECT_EQ(hash_of_flight(needs, solver, 0), hash_of_flight(needs | PLUMB_NEED_COLLISION, solver, 0)) << solver;
}

TEST(Needs, WhereNothingTurnsTheRestIsTheSame) {
  for (const char* solver : kSolvers)
    EXPECT_EQ(hash_of_flight(0, solver, PLUMB_BODY_NO_ROTATION),
              hash_of_flight(PLUMB_NEED_ROTATION, solver, PLUMB_BODY_NO_ROTATION))
        << solver;
}

std::uint64_t hash_of_pile(PlumbNeeds needs, const char* solver, bool steered) {
  Scene scene(engine(), needs, kDown, 1, {"solver", solver});
  scene.container(3, 20);
  scene.body.material.friction = 0.4;
  scene.body.flags = PLUMB_BODY_NO_ROTATION;
  const PlumbShape ball = scene.sphere(0.5), cube = scene.box({0.4, 0.4, 0.4});
  for (int i = 0; i < 60; ++i)
    scene.add(i % 2 == 0 ? ball : cube, {1.1 * (i % 4) - 1.6 + 0.01 * i, 1 + 1.2 * (i / 16), 1.1 * (i / 4 % 4) - 1.6});
  if (steered) {
    const PlumbBody paddle = scene.add_kinematic(scene.box({2, 0.1, 0.2}), {0, 0.6, 0});
    scene.write(PLUMB_FIELD_VELOCITY, paddle, {0, 0, 0, 0, 2, 0});
  }
  scene.run(80);
  return scene.hash();
}

TEST(Needs, ContactsOfWhatDoesNotTurnAreTheSame) {
  constexpr PlumbNeeds needs = PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;
  for (const char* solver : kSolvers)
    EXPECT_EQ(hash_of_pile(needs, solver, false), hash_of_pile(needs | PLUMB_NEED_ROTATION, solver, false)) << solver;
}

TEST(Needs, AKinematicBodyTurnsWhereNothingElseDoes) {
  constexpr PlumbNeeds needs = PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_KINEMATIC;
  EXPECT_EQ(hash_of_pile(needs, "tgs_soft", true), hash_of_pile(needs | PLUMB_NEED_ROTATION, "tgs_soft", true));
}

}  // namespace
}  // namespace plumb::impulse::test
