#include <algorithm>
#include <array>
#include <vector>

#include "backend_under_test.hpp"
#include "plumb/helpers/worlds.hpp"

namespace plumb::helpers::test {
namespace {

constexpr PlumbNeeds kNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_FORCES;

/// Three cubes that fall on ground and on each other, pushed aside by `lean`.
std::unique_ptr<IPhysicsWorld> falling_cubes(double lean, PlumbNeeds more = 0) {
  TestWorld t({0, -9.81, 0}, kNeeds | more);
  t.box(PLUMB_STATIC, {5, 0.5, 5}, {0, -0.5, 0});
  for (int i = 0; i < 3; ++i) t.box(PLUMB_DYNAMIC, {0.2, 0.2, 0.2}, {lean * i, 0.25 + 0.45 * i, 0});
  return std::move(t.world);
}
double lean_of(std::uint32_t index) { return 0.03 * index; }

std::vector<std::uint64_t> hashes(Worlds& worlds) {
  std::vector<std::uint64_t> all(worlds.count());
  for (std::uint32_t i = 0; i < worlds.count(); ++i) check(worlds[i], worlds[i].hash(all[i]));
  return all;
}

TEST(Worlds, EndAsEachDoesAlone) {
  Worlds worlds(
      7, [](std::uint32_t i) { return falling_cubes(lean_of(i)); }, 3);
  for (int k = 0; k < 90; ++k) worlds.step(1.0 / 60);
  EXPECT_EQ(worlds.reports()[6].step, 90U);
  if (backend_under_test().info().determinism == PLUMB_DETERMINISM_NONE) GTEST_SKIP() << "not deterministic";
  for (std::uint32_t i = 0; i < worlds.count(); ++i) {
    TestWorld alone;
    alone.world = falling_cubes(lean_of(i));
    for (int k = 0; k < 90; ++k) alone.step(1.0 / 60);
    std::uint64_t own = 0, together = 0;
    check(*alone.world, alone.world->hash(own));
    check(worlds[i], worlds[i].hash(together));
    EXPECT_EQ(own, together) << "world " << i;
  }
}

TEST(Worlds, AreReadAndWrittenAsOneArray) {
  Worlds worlds(
      3, [](std::uint32_t i) { return falling_cubes(lean_of(i)); }, 2);
  ASSERT_EQ(worlds.bodies(), 4U);
  const std::span<const double> poses = worlds.read(PLUMB_FIELD_POSE);
  ASSERT_EQ(poses.size(), 3U * 4 * 7);
  EXPECT_NEAR(poses[(2 * 4 + 3) * 7], 2 * lean_of(2), 1e-6);  // world 2, the topmost cube, x
  const std::array<std::uint32_t, 2> two = {3, 1};
  std::vector<double> velocities(3 * 2 * 6);
  for (std::size_t i = 0; i < velocities.size(); ++i) velocities[i] = static_cast<double>(i) / 8;
  const std::array<std::uint8_t, 3> mask = {1, 0, 1};
  worlds.write(PLUMB_FIELD_VELOCITY, velocities, two, mask);
  const std::span<const double> now = worlds.read(PLUMB_FIELD_VELOCITY, two);
  for (std::size_t world = 0; world < 3; ++world)
    for (std::size_t k = 0; k < 12; ++k)
      EXPECT_NEAR(now[world * 12 + k], mask[world] != 0 ? velocities[world * 12 + k] : 0, 1e-5);
  EXPECT_EQ(worlds.read(PLUMB_FIELD_POSE, two).size(), 3U * 2 * 7);
}

/// Of worlds in which others have lived before, under handles that so are not those of the world beside.
TEST(Worlds, KnowBodiesByTheirPlaceWhateverTheirHandles) {
  const auto make = [](std::uint32_t index) {
    TestWorld t({0, 0, 0}, kNeeds);
    for (std::uint32_t gone = 0; gone < index; ++gone) {
      const PlumbBody body = t.sphere(0.1, {0, 5, 0}, 1);
      check(*t.world, t.world->destroy_bodies({&body, 1}));
    }
    for (int k = 0; k < 2; ++k) t.sphere(0.1, {10.0 * index + k, 0, 0}, 1);
    return std::move(t.world);
  };
  Worlds worlds(3, make, 2);
  ASSERT_NE(worlds[0].bodies()[0], worlds[1].bodies()[0]);
  const std::array<std::uint32_t, 1> first = {0};
  const std::vector<double> velocities = {1, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0};
  worlds.write(PLUMB_FIELD_VELOCITY, velocities, first);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(worlds.read(PLUMB_FIELD_POSE, first)[7 * i], 10.0 * i, 1e-6);
    EXPECT_NEAR(worlds.read(PLUMB_FIELD_VELOCITY)[12 * i], 1.0 + i, 1e-6);
    EXPECT_NEAR(worlds.read(PLUMB_FIELD_VELOCITY)[12 * i + 6], 0, 1e-6);
  }
}

TEST(Worlds, LendTheRowsOfAllWhereTheyLie) {
  Worlds worlds(
      3, [](std::uint32_t i) { return falling_cubes(lean_of(i)); }, 2);
  const PlumbStateRequest request = {sizeof request, PLUMB_FIELD_POSE, 1, 1};
  if (worlds[0].worlds() == nullptr) {
    EXPECT_THROW((void)worlds.borrow(request), Error);
    return;
  }
  for (int k = 0; k < 20; ++k) worlds.step(1.0 / 60);
  PlumbDLManagedTensor* lent = worlds.borrow(request);
  worlds.step(1.0 / 60);
  lent->deleter(lent);
  lent = worlds.borrow(request);
  const PlumbDLTensor& rows = lent->dl_tensor;
  ASSERT_EQ(rows.ndim, 3);
  EXPECT_EQ(rows.shape[0], 3);
  std::span<const PlumbBody> ids;
  std::uint64_t generation = 0;
  check(worlds[2], worlds[2].state()->row_map(ids, generation));
  const auto row = std::find(ids.begin(), ids.end(), worlds[2].bodies()[3]) - ids.begin();
  const std::int64_t height = 2 * rows.strides[0] + row * rows.strides[1] + rows.strides[2];
  EXPECT_NEAR(static_cast<const double*>(rows.data)[height], worlds.read(PLUMB_FIELD_POSE)[(2 * 4 + 3) * 7 + 1], 1e-12);
  lent->deleter(lent);
  Worlds one(1, [](std::uint32_t) { return falling_cubes(0); });
  lent = one.borrow(request);
  EXPECT_EQ(lent->dl_tensor.ndim, 3);
  EXPECT_EQ(lent->dl_tensor.shape[0], 1);
  lent->deleter(lent);
}

/// A wheel that a motor turns, as fast as its world is told.
TEST(Worlds, DriveTheJointsOfAllByOneArray) {
  if (!offers(kNeeds | PLUMB_NEED_JOINTS)) GTEST_SKIP() << "no joints";
  const Backend& backend = backend_under_test();
  if (backend.capability(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_HINGE, PLUMB_JOINT_HAS_MOTORS) == PLUMB_NONE)
    GTEST_SKIP() << "no motors";
  PlumbJoint hinge = 0;
  const auto wheel = [&](std::uint32_t) {
    TestWorld t({0, 0, 0}, kNeeds | PLUMB_NEED_JOINTS);
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_HINGE);
    desc.body_b = t.sphere(0.5, {0, 0, 0}, 1);
    desc.motors[3] = {0, 100, 1, 0};
    check(*t.world, t.world->joints()->create_joints({&desc, 1}, {&hinge, 1}));
    return std::move(t.world);
  };
  Worlds worlds(3, wheel, 2);
  std::vector<double> motors(3 * 12);
  for (std::size_t i = 0; i < 3; ++i) {
    motors[12 * i + 6] = 1.0 + static_cast<double>(i);
    motors[12 * i + 7] = 100;
  }
  const std::array<std::uint8_t, 3> mask = {1, 0, 1};
  worlds.write_joints(PLUMB_JOINT_MOTOR, motors, {&hinge, 1}, mask);
  for (int k = 0; k < 30; ++k) worlds.step(1.0 / 60);
  const std::span<const double> turned = worlds.read_joints(PLUMB_JOINT_COORDINATES, {&hinge, 1});
  ASSERT_EQ(turned.size(), 3U * 6);
  EXPECT_NEAR(turned[3], 0.5, 0.03);
  EXPECT_NEAR(turned[6 + 3], 0, 1e-6);
  EXPECT_NEAR(turned[12 + 3], 1.5, 0.08);
  const PlumbJoint none = 0;
  EXPECT_THROW((void)worlds.read_joints(PLUMB_JOINT_COORDINATES, {&none, 1}), Error);
  EXPECT_THROW(worlds.write_joints(PLUMB_JOINT_MOTOR, std::span(motors).first(12), {&hinge, 1}), Error);
}

TEST(Worlds, GoBackToTheirStartByMask) {
  if (!offers(Worlds::needs)) GTEST_SKIP() << "no snapshots";
  Worlds worlds(
      4, [](std::uint32_t i) { return falling_cubes(lean_of(i), Worlds::needs); }, 2);
  const auto run = [&](int steps) {
    for (int k = 0; k < steps; ++k) worlds.step(1.0 / 60);
    return hashes(worlds);
  };
  EXPECT_THROW(worlds.reset(), Error);
  worlds.mark();
  const std::vector<std::uint64_t> start = hashes(worlds), once = run(40);
  const std::array<std::uint8_t, 4> mask = {0, 1, 0, 1};
  worlds.reset(mask);
  std::vector<std::uint64_t> now = hashes(worlds);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(now[i], mask[i] != 0 ? start[i] : once[i]) << "world " << i;
  if (backend_under_test().capability(PLUMB_CAP_SNAPSHOT) != PLUMB_NATIVE) return;
  now = run(40);
  for (const std::size_t i : {1, 3}) EXPECT_EQ(now[i], once[i]) << "world " << i;
  worlds.mark();
  run(10);
  worlds.reset();
  EXPECT_EQ(hashes(worlds), now);
}

TEST(Worlds, SayWhichOneIsWrong) {
  const auto expect_text = [](auto&& f, const std::string& part) {
    try {
      f();
      ADD_FAILURE() << "no error with '" << part << "'";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  Worlds worlds(
      3, [](std::uint32_t) { return falling_cubes(0); }, 2);
  expect_text([&] { worlds.step(-1); }, "world 0: ");
  worlds.step(1.0 / 60);  // all can go on
  expect_text([&] { worlds.reset(std::array<std::uint8_t, 2>{}); }, "a mask of 2 entries for 3 worlds");
  expect_text([&] { worlds.write(PLUMB_FIELD_VELOCITY, std::array<double, 5>{}); }, "3 worlds x 4 bodies x 6 columns");
  expect_text([&] { (void)worlds.read(PLUMB_FIELD_POSE, std::array<std::uint32_t, 1>{4}); }, "there is no body 4");
  expect_text(
      [] {
        Worlds unlike(2, [](std::uint32_t i) {
          auto world = falling_cubes(0);
          if (i == 1) check(*world, world->destroy_bodies(world->bodies().subspan(1, 1)));
          return world;
        });
      },
      "world 1: 3 bodies, and the first world has 4");
}

/// What one world refuses does not stop the others, and none is left within a step.
TEST(Worlds, GoOnWhereOneFails) {
  std::vector<std::unique_ptr<IPhysicsWorld>> all;
  std::vector<IPhysicsWorld*> pointers;
  for (int i = 0; i < 3; ++i) {
    all.push_back(falling_cubes(0));
    pointers.push_back(all.back().get());
  }
  StepTogether together(2);
  std::vector<PlumbStepReport> reports(3);
  check(*pointers[1], pointers[1]->step(1.0 / 60));  // a second step is refused
  EXPECT_THROW(together.step(pointers, 1.0 / 60, reports), Error);
  EXPECT_EQ(reports[0].step, 1U);
  EXPECT_EQ(reports[2].step, 1U);
  PlumbStepReport report{};
  report.struct_size = sizeof(report);
  check(*pointers[1], pointers[1]->wait(report));
  together.step(pointers, 1.0 / 60, reports);
  EXPECT_EQ(reports[1].step, 2U);
  EXPECT_THROW(together.step(pointers, 1.0 / 60, std::span(reports).first(2)), Error);
}

TEST(StepTogether, CallsEachOnceOnAnyNumberOfThreads) {
  for (const std::uint32_t threads : {1U, 2U, 5U}) {
    StepTogether together(threads);
    EXPECT_EQ(together.threads(), threads);
    for (const std::size_t n : {0UL, 1UL, 3UL, 1000UL}) {
      std::vector<int> calls(n);
      together.each(n, [&](std::size_t i) { ++calls[i]; });
      EXPECT_EQ(std::count(calls.begin(), calls.end(), 1), static_cast<std::ptrdiff_t>(n));
    }
  }
}

}  // namespace
}  // namespace plumb::helpers::test
