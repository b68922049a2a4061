// Sub-steps by load: more of them where something bears what it is too light for, and nowhere else.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "tests/rigs/engine.hpp"
#include "tests/rigs/vise.hpp"

namespace plumb::impulse::test {
namespace {

/// Cubes of 1 m on the ground.
struct Cubes {
  explicit Cubes(PlumbNeeds more_needs = 0)
      : scene(engine(), PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | more_needs, kDown, 1),
        cube(scene.box({0.5, 0.5, 0.5})) {
    scene.ground();
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  }
  PlumbBody add(double mass, const PlumbVec3& position) {
    scene.body.mass = mass;
    return scene.add(cube, position);
  }
  /// From now on there are no more than the setting "substeps" says.
  void keep_to_the_setting() {
    ASSERT_EQ(scene.world().settings()->set_setting("most_substeps", {PLUMB_SETTING_INT, 0, 1, nullptr}), PLUMB_OK);
  }
  double speed(PlumbBody body) {
    const std::vector<double> v = scene.velocity(body);
    return std::hypot(v[0], v[1], v[2]);
  }

  Scene scene;
  PlumbShape cube;
};

/// A cube of 10 kg between two that are heavier by the ratio: how far the upper one sinks in 5 s, m.
double sink_of_sandwich(Cubes& cubes, double ratio) {
  cubes.add(10 * ratio, {0, 0.5, 0});
  cubes.add(10, {0, 1.5, 0});
  const PlumbBody top = cubes.add(10 * ratio, {0, 2.5, 0});
  cubes.scene.run(300);
  EXPECT_LT(cubes.speed(top), 1e-3);
  return 2.5 - cubes.scene.poses().back().position.y;
}

TEST(SubstepsByLoad, HoldASandwichOfMassesThatDifferByAThousand) {
  Cubes chooses, keeps;
  keeps.keep_to_the_setting();
  EXPECT_LT(sink_of_sandwich(chooses, 1000), 0.01);
  EXPECT_GT(sink_of_sandwich(keeps, 1000), 0.05) << "it gives way by F / (m w^2) at two faces";
}

/// A heavy cube rocks on a light one for ever where contacts are as stiff as those of like masses.
TEST(SubstepsByLoad, LetAHeavyCubeOnALightOneComeToRest) {
  Cubes cubes(PLUMB_NEED_KINEMATIC);
  const PlumbBody platform = cubes.scene.add_kinematic(cubes.scene.box({3, 0.2, 3}), {0, 0.2, 0});
  cubes.add(100, {0, 0.9, 0});
  const PlumbBody heavy = cubes.add(10000, {0, 1.9, 0});
  cubes.scene.before_step = [&](Scene& scene, int done) {  // at 2 m/s2 for 1 s, and as hard to a halt
    const double t = std::min((done + 1) / 60.0, 2.0);
    scene.target(platform, {t < 1 ? t * t : 2 - (2 - t) * (2 - t), 0.2, 0});
  };
  cubes.scene.run(1200);
  EXPECT_LT(cubes.speed(heavy), 1e-4);
}

TEST(SubstepsByLoad, AreThoseOfTheSettingInPilesOfLikeMasses) {
  Cubes chooses, keeps;
  keeps.keep_to_the_setting();
  for (Cubes* cubes : {&chooses, &keeps}) {
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < 3; ++k) cubes->add(1 + 3 * ((i + k) % 2), {1.02 * k, i + 0.5, 0});
    cubes->scene.run(120);
  }
  EXPECT_EQ(chooses.scene.hash(), keeps.scene.hash());
}

/// What is light and strikes something heavy bears no load.
TEST(SubstepsByLoad, AreThoseOfTheSettingWhereLightBodiesRainOnAHeavyOne) {
  Cubes chooses, keeps;
  keeps.keep_to_the_setting();
  for (Cubes* cubes : {&chooses, &keeps}) {
    cubes->add(5000, {0, 0.5, 0});
    for (int i = 0; i < 40; ++i) cubes->add(1, {0.3 * (i % 3 - 1), 2.5 + 1.5 * i, 0.2 * (i % 2)});
    cubes->scene.run(300);
  }
  EXPECT_EQ(chooses.scene.hash(), keeps.scene.hash());
}

/// Cubes in rows of twenty at that height of their centres, from x = 3 on.
std::vector<PlumbBody> add_crowd(Cubes& cubes, int count, double height) {
  std::vector<PlumbBody> crowd;
  for (int i = 0; i < count; ++i) crowd.push_back(cubes.add(10, {3.0 + 1.5 * (i % 20), height, 1.5 * (i / 20) - 40}));
  return crowd;
}
/// How far a heavy cube sinks into a light one, whose centre is at that height, m.
double sink_of_heavy(Cubes& cubes, double height) {
  cubes.add(10, {0, height, 0});
  cubes.add(1000, {0, height + 1, 0});
  cubes.scene.run(120);
  return height + 1 - cubes.scene.poses().back().position.y;
}

/// A cube in the middle of so many, one upon the other and a little beside it, is so far from the axis after 60 s, m.
double drift_of_column(Cubes& cubes, int count) {
  for (int i = 0; i < count; ++i) cubes.add(1000, {i % 2 * 1e-4, i + 0.5, 0});
  cubes.scene.run(3600);
  const PlumbPose pose = cubes.scene.poses()[static_cast<std::size_t>(1 + count / 2)];
  return std::hypot(pose.position.x, pose.position.z);
}

TEST(SubstepsByLoad, HoldAColumnThatWouldBuckle) {
  Cubes chooses, keeps;
  keeps.keep_to_the_setting();
  EXPECT_LT(drift_of_column(chooses, 50), 1e-3);
  EXPECT_GT(drift_of_column(keeps, 50), 1) << "it falls";
}

/// Of columns half as large, on half the gravity, twice as heavy: what matters is how many stand on one.
TEST(SubstepsByLoad, AreNoMatterOfAColumnsSize) {
  Cubes chooses;
  Scene& scene = chooses.scene;
  scene.body.mass = 2000;
  const PlumbShape small = scene.box({0.25, 0.25, 0.25});
  for (int i = 0; i < 50; ++i) scene.add(small, {0, 0.25 + 0.5 * i, 0});
  check(scene.world(), scene.world().set_gravity({0, -9.81 / 2, 0}));
  scene.run(3600);
  EXPECT_LT(std::hypot(scene.poses()[25].position.x, scene.poses()[25].position.z), 1e-4);
}

TEST(SubstepsByLoad, AreThoseOfTheSettingInColumnsThatStandAsItIs) {
  Cubes chooses, keeps;
  keeps.keep_to_the_setting();
  for (Cubes* cubes : {&chooses, &keeps}) drift_of_column(*cubes, 20);
  EXPECT_EQ(chooses.scene.hash(), keeps.scene.hash());
}

/// Columns side by side that touch hold each other.
TEST(SubstepsByLoad, AreThoseOfTheSettingInWalls) {
  Cubes chooses, keeps;
  keeps.keep_to_the_setting();
  for (Cubes* cubes : {&chooses, &keeps}) {
    for (int i = 0; i < 120; ++i) cubes->add(1000, {1.0 * (i % 3), i / 3 + 0.5, 0});
    cubes->scene.run(240);
  }
  EXPECT_EQ(chooses.scene.hash(), keeps.scene.hash());
}

/// They are those of an island: a machine does as well in a large world as in a small one.
TEST(SubstepsByLoad, AreNoMatterOfTheWorldsSize) {
  Cubes alone, among, keeps;
  keeps.keep_to_the_setting();
  const double sink = sink_of_heavy(alone, 0.5);
  add_crowd(among, 1100, 0.5);
  EXPECT_NEAR(sink_of_heavy(among, 0.5), sink, 0.01 * sink);
  EXPECT_LT(sink, 0.6 * sink_of_heavy(keeps, 0.5));
}

/// What does not touch the loaded goes through the step as if nobody were.
TEST(SubstepsByLoad, LeaveOtherIslandsTheirs) {
  Cubes chooses, keeps;
  keeps.keep_to_the_setting();
  std::vector<PlumbPose> poses[2];
  for (Cubes* cubes : {&chooses, &keeps}) {
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < 3; ++k) cubes->add(1 + 3 * ((i + k) % 2), {1.02 * k + 0.1 * i, i + 0.52, 10});
    sink_of_heavy(*cubes, 0.5);
    poses[cubes == &keeps] = cubes->scene.poses();
  }
  constexpr std::size_t kGroundAndPile = 19;
  for (std::size_t i = 0; i < poses[0].size(); ++i) {
    const bool same = std::memcmp(&poses[0][i], &poses[1][i], sizeof(PlumbPose)) == 0;
    EXPECT_EQ(same, i < kGroundAndPile) << i;
  }
}

/// Of islands that differ in what they ask each has its own.
TEST(SubstepsByLoad, AreEachIslandsOwn) {
  const double ratios[] = {7, 30, 100, 1000, 10000};
  Cubes together;
  for (int k = 0; k < 5; ++k) {
    together.add(10, {3.0 * k, 0.5, 0});
    together.add(10 * ratios[k], {3.0 * k, 1.5, 0});
  }
  together.scene.run(120);
  for (int k = 0; k < 5; ++k) {
    Cubes alone;
    alone.add(10, {3.0 * k, 0.5, 0});
    alone.add(10 * ratios[k], {3.0 * k, 1.5, 0});
    alone.scene.run(120);
    const double height = alone.scene.poses().back().position.y;
    EXPECT_NEAR(together.scene.poses()[2 + 2 * k].position.y, height, 1e-5) << ratios[k];
  }
}

/// A heavy cube on a light one, on what the host moves upwards at that speed, m/s: how far the two are above it in the
/// end.
std::array<double, 2> heights_on_platform(double speed) {
  Cubes cubes(PLUMB_NEED_KINEMATIC);
  const PlumbBody platform = cubes.scene.add_kinematic(cubes.scene.box({3, 0.2, 3}), {0, 20, 0});
  const PlumbBody light = cubes.add(10, {0, 20.7, 0}), heavy = cubes.add(1000, {0, 21.7, 0});
  for (const PlumbBody body : {light, heavy}) cubes.scene.write(PLUMB_FIELD_VELOCITY, body, {0, speed, 0, 0, 0, 0});
  cubes.scene.before_step = [&](Scene& scene, int done) {
    scene.target(platform, {0, 20 + speed * (done + 1) / 60.0, 0});
  };
  double fastest = 0;
  for (int i = 0; i < 120; ++i) {
    cubes.scene.run(1);
    fastest = std::max(fastest, std::abs(cubes.scene.velocity(heavy)[1] - speed));
  }
  EXPECT_LT(fastest, 0.1) << speed << " m/s";
  const std::vector<PlumbPose> poses = cubes.scene.poses();
  return {poses[2].position.y - poses[1].position.y, poses[3].position.y - poses[1].position.y};
}

/// Galileo's: what rides in a lift does not see that it goes.
TEST(SubstepsByLoad, GoWithWhatTheHostMoves) {
  const std::array<double, 2> at_rest = heights_on_platform(0);
  for (const double speed : {1.0, 5.0, -5.0}) {
    const std::array<double, 2> moving = heights_on_platform(speed);
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(moving[k], at_rest[k], 1e-4) << speed << " m/s";
  }
}

/// A load of that many kg in a bucket of 2 kg that hangs on what the host moves sideways, m/s: where it is in the end,
/// seen from there.
PlumbVec3 load_in_bucket(double load, double speed) {
  Cubes cubes(PLUMB_NEED_KINEMATIC | PLUMB_NEED_JOINTS);
  Scene& scene = cubes.scene;
  const PlumbBody trolley = scene.add_kinematic(scene.box({0.3, 0.3, 0.3}), {0, 6, 0});
  scene.body.mass = 2;
  const PlumbBody bucket = scene.add(scene.box({1, 0.05, 1}), {0, 4, 0});
  scene.ball_joint(trolley, {0, -0.3, 0}, bucket, {0, 1.7, 0});
  scene.body.mass = load;
  const PlumbBody box = scene.add(scene.box({0.3, 0.3, 0.3}), {0, 4.35, 0});
  for (const PlumbBody body : {bucket, box}) scene.write(PLUMB_FIELD_VELOCITY, body, {speed, 0, 0, 0, 0, 0});
  scene.before_step = [&](Scene& all, int done) { all.target(trolley, {speed * (done + 1) / 60.0, 6, 0}); };
  scene.run(120);
  const std::vector<PlumbPose> poses = scene.poses();
  const PlumbVec3 from = poses[1].position, at = poses[3].position;
  return {at.x - from.x, at.y - from.y, at.z - from.z};
}

TEST(SubstepsByLoad, GoWithWhatTheHostMovesByAJoint) {
  for (const double load : {100.0, 1000.0}) {
    const PlumbVec3 at_rest = load_in_bucket(load, 0), moving = load_in_bucket(load, 4);
    EXPECT_NEAR(moving.x, at_rest.x, 2e-3) << load;
    EXPECT_NEAR(moving.y, at_rest.y, 2e-3) << load;
  }
}

/// An island of many thousands of contacts would take too long. A joint is as much work as eight.
TEST(SubstepsByLoad, AreThoseOfTheSettingInCrowds) {
  Cubes few(PLUMB_NEED_JOINTS), many(PLUMB_NEED_JOINTS), keeps(PLUMB_NEED_JOINTS);
  keeps.keep_to_the_setting();
  const auto on_a_plate = [](Cubes& cubes, int others) {
    cubes.scene.body.mass = 1e6;
    cubes.scene.add(cubes.scene.box({45, 0.5, 45}), {0, 0.5, 0});
    const std::vector<PlumbBody> crowd = add_crowd(cubes, others, 1.5);
    for (std::size_t i = 1; i < crowd.size(); ++i)
      if (i % 20 != 0) cubes.scene.ball_joint(crowd[i - 1], {0.75, 0, 0}, crowd[i], {-0.75, 0, 0});
    return sink_of_heavy(cubes, 1.5);
  };
  const double sink = on_a_plate(keeps, 0);
  EXPECT_LT(on_a_plate(few, 20), 0.6 * sink);
  EXPECT_GT(on_a_plate(many, 1100), 0.9 * sink);
}

/// So many boxes of that mass in rows on a plate of 56 kg, fallen by a millimetre, after 10 s: speed of the fastest,
/// m/s.
double fastest_on_a_plate(Cubes& cubes, int rows, int in_row, double mass) {
  cubes.scene.body.mass = 56;
  cubes.scene.add(cubes.scene.box({0.3 * in_row, 0.05, 0.3 * rows}), {0, 0.05, 0});
  const PlumbShape shape = cubes.scene.box({0.2, 0.2, 0.2});
  cubes.scene.body.mass = mass;
  std::vector<PlumbBody> boxes;
  for (int i = 0; i < in_row; ++i)
    for (int j = 0; j < rows; ++j)
      boxes.push_back(cubes.scene.add(shape, {0.6 * i - 0.3 * (in_row - 1), 0.301, 0.6 * j - 0.3 * (rows - 1)}));
  cubes.scene.run(600);
  double fastest = 0;
  for (const PlumbBody& box : boxes) fastest = std::max(fastest, cubes.speed(box));
  return fastest;
}

/// None is much heavier than the plate; all together are.
TEST(Stars, OfManyHeavyBoxesOnALightPlateComeToRest) {
  Cubes keeps;
  keeps.keep_to_the_setting();
  EXPECT_GT(fastest_on_a_plate(keeps, 4, 4, 200), 1e-2) << "a sweep stops too little of what all do together";
  for (const double mass : {100.0, 800.0}) {
    Cubes chooses;
    EXPECT_LT(fastest_on_a_plate(chooses, 4, 4, mass), 1e-3) << mass;
  }
  Cubes many;
  EXPECT_LT(fastest_on_a_plate(many, 8, 8, 40), 1e-3);
}

/// Two heavy boxes; sixteen that are too little together; a hundred that are nothing each.
TEST(Stars, AreNoneOfAFewOrOfLightOnes) {
  struct Load {
    int rows, in_row;
    double mass;
  };
  for (const auto& [rows, in_row, mass] : {Load{1, 2, 300}, Load{4, 4, 30}, Load{10, 10, 10}}) {
    Cubes chooses, keeps;
    keeps.keep_to_the_setting();
    EXPECT_EQ(fastest_on_a_plate(chooses, rows, in_row, mass), fastest_on_a_plate(keeps, rows, in_row, mass));
    EXPECT_EQ(chooses.scene.hash(), keeps.scene.hash()) << rows * in_row;
  }
}

/// What does not touch a star goes through the step as if there were none.
TEST(Stars, LeaveOtherIslandsTheirs) {
  std::vector<PlumbPose> poses[2];
  Cubes chooses, keeps;
  keeps.keep_to_the_setting();
  for (Cubes* cubes : {&chooses, &keeps}) {
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < 3; ++k) cubes->add(1 + 3 * ((i + k) % 2), {1.02 * k + 0.1 * i, i + 0.52, 10});
    fastest_on_a_plate(*cubes, 4, 4, 200);
    poses[cubes == &keeps] = cubes->scene.poses();
  }
  constexpr std::size_t kGroundAndPile = 19;
  for (std::size_t i = 0; i < poses[0].size(); ++i) {
    const bool same = std::memcmp(&poses[0][i], &poses[1][i], sizeof(PlumbPose)) == 0;
    EXPECT_EQ(same, i < kGroundAndPile) << i;
  }
}

/// What loads asked for in the last second is part of a snapshot.
TEST(SubstepsByLoad, GoOnFromASnapshotAsTheyWere) {
  Cubes saved(PLUMB_NEED_SNAPSHOT), other(PLUMB_NEED_SNAPSHOT);
  PlumbBody heavy{};
  for (Cubes* cubes : {&other, &saved}) {
    cubes->add(10, {0, 0.5, 0});
    heavy = cubes->add(3000, {0, 1.5, 0});
  }
  saved.scene.run(60);
  saved.scene.write(PLUMB_FIELD_POSE, heavy, {3, 1, 0, 0, 0, 0, 1});
  saved.scene.run(5);  // the light cube, alone, rises again
  std::span<const std::byte> bytes;
  ASSERT_EQ(saved.scene.world().snapshot()->save(bytes), PLUMB_OK);
  const std::vector<std::byte> kept(bytes.begin(), bytes.end());
  saved.scene.run(90);
  ASSERT_EQ(other.scene.world().snapshot()->restore(kept), PLUMB_OK);
  other.scene.run(90);
  EXPECT_EQ(other.scene.hash(), saved.scene.hash());
}

/// A pebble bears nothing better with the most sub-steps than with the setting's, and gets none.
TEST(SubstepsByLoad, AreNotSpentOnWhatIsPastHelp) {
  Cubes chooses, keeps;
  keeps.keep_to_the_setting();
  for (Cubes* cubes : {&chooses, &keeps}) {
    const PlumbShape pebble = cubes->scene.sphere(0.005);
    cubes->add(1200, {0, 0.51, 0});
    cubes->scene.body.mass = 0.001;
    cubes->scene.add(pebble, {0.1, 0.005, 0});
    cubes->scene.run(120);
  }
  EXPECT_EQ(chooses.scene.hash(), keeps.scene.hash());
}

/// A vise: a slider's motor squeezes one cube against the other with hundreds of their weights, and the slider holds
/// against it. Contacts that stiffen by what they press would be wound up by that, and throw what they squeeze.
TEST(SubstepsByLoad, AreNotSpentOnWhatJointsSqueeze) {
  Cubes chooses(PLUMB_NEED_JOINTS), keeps(PLUMB_NEED_JOINTS);
  keeps.keep_to_the_setting();
  PlumbBody squeezed = 0;
  for (Cubes* cubes : {&keeps, &chooses}) {
    squeezed = vise(cubes->scene, 2e4);
    cubes->scene.run(120);
  }
  EXPECT_EQ(chooses.scene.hash(), keeps.scene.hash());
  EXPECT_LT(chooses.speed(squeezed), 1e-3);
}

/// Two jaws of the host hold a cube by a centimetre of overlap, with thousands of its weights, and another hangs on it.
TEST(SubstepsByLoad, AreNotSpentOnWhatTheHostSqueezes) {
  Cubes chooses(PLUMB_NEED_JOINTS | PLUMB_NEED_KINEMATIC), keeps(PLUMB_NEED_JOINTS | PLUMB_NEED_KINEMATIC);
  keeps.keep_to_the_setting();
  PlumbBody hanging = 0;
  for (Cubes* cubes : {&keeps, &chooses}) {
    Scene& scene = cubes->scene;
    for (const double side : {-1.0, 1.0}) scene.add_kinematic(scene.box({0.05, 0.2, 0.2}), {side * 0.14, 5, 0});
    const PlumbShape cube = scene.box({0.1, 0.1, 0.1});
    scene.body.mass = 1;
    const PlumbBody held = scene.add(cube, {0, 5, 0});
    hanging = scene.add(cube, {0, 4.7, 0});
    scene.ball_joint(held, {0, -0.1, 0}, hanging, {0, 0.2, 0});
    scene.run(300);
  }
  EXPECT_EQ(chooses.scene.hash(), keeps.scene.hash());
  EXPECT_LT(chooses.speed(hanging), 0.1);
}

}  // namespace
}  // namespace plumb::impulse::test
