// What every solver must do: carry weight, keep momentum, hold what friction holds, stay within the cone, and give the
// same bits for any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "plugin/world.hpp"

namespace plumb::impulse {
namespace {

constexpr double kDt = 1.0 / 60, kWeight = 9.81;

/// Unit cubes of 1000 kg and a ground below y = 0.
class CubeWorld {
 public:
  /// "once": tgs_soft that relaxes at the end of a step.
  explicit CubeWorld(const std::string& solver, std::uint32_t threads = 1, PlumbVec3 gravity = {0, -kWeight, 0},
                     bool ground = true)
      : world_(init(gravity, threads)) {
    set("solver", 0, solver == "once" ? "tgs_soft" : solver.c_str());
    if (solver == "once") set("relaxation", 0, "step");
    add_box(box_, {0.5, 0.5, 0.5});
    if (!ground) return;
    PlumbShape plate = 0;
    add_box(plate, {500, 1, 500});
    PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
    desc.shape = plate;
    desc.pose = {{0, -1, 0}, {0, 0, 0, 1}};
    desc.material.friction = 0.5;
    add(desc);
  }

  PlumbBody cube(const PlumbVec3& at, const PlumbVec3& velocity = {0, 0, 0}, double restitution = 0,
                 double mass = 1000) {
    PlumbBodyDesc desc = body_desc();
    desc.shape = box_;
    desc.pose = {at, {0, 0, 0, 1}};
    desc.linear_velocity = velocity;
    desc.mass_mode = PLUMB_MASS_EXPLICIT;
    desc.mass = mass;
    desc.inertia = {mass / 6, mass / 6, mass / 6};
    desc.material.friction = 0.5;
    desc.material.restitution = restitution;
    desc.gravity_scale = gravity_scale;
    return add(desc);
  }
  /// Of radius 0.5 m, that strikes the ground so hard that the impulse is no number any more.
  void overflowing_ball(const PlumbVec3& at) {
    PlumbShape ball = 0;
    PlumbShapeDesc shape = shape_desc(PLUMB_SPHERE);
    shape.radius = 0.5;
    add_shape(ball, shape);
    PlumbBodyDesc desc = body_desc();
    desc.shape = ball;
    desc.pose = {at, {0, 0, 0, 1}};
    desc.linear_velocity = {0, -1e9, 0};
    desc.mass_mode = PLUMB_MASS_EXPLICIT;
    desc.mass = sizeof(Real) == 8 ? 1e300 : 1e30;
    desc.inertia = {desc.mass / 10, desc.mass / 10, desc.mass / 10};
    add(desc);
  }
  void set(const char* name, double number, const char* choice = nullptr) {
    world_.settings()->set_setting(name, {0, 0, number, choice});
  }
  /// lost: bodies whose numbers overflow in it.
  void step(std::uint32_t lost = 0) {
    world_.step(kDt);
    PlumbStepReport report{};
    world_.wait(report);
    ASSERT_EQ(report.nonfinite, lost);
  }
  void run(double seconds) {
    for (double t = kDt / 2; t < seconds; t += kDt) step();
  }

  PlumbVec3 place(PlumbBody body) {
    PlumbPose at{};
    world_.read(PLUMB_FIELD_POSE, {&body, 1}, rows_over(std::span(&at, 1)));
    return at.position;
  }
  struct Speed {
    PlumbVec3 linear, angular;
  };
  Speed speed(PlumbBody body) {
    Speed v{};
    world_.read(PLUMB_FIELD_VELOCITY, {&body, 1}, rows_over(std::span(&v, 1)));
    return v;
  }
  std::span<const PlumbContact> contacts() { return world_.contacts(); }
  std::uint32_t passes() const { return world_.counters().passes; }

  double gravity_scale = 1;  ///< of cubes to come

 private:
  static WorldInit init(const PlumbVec3& gravity, std::uint32_t threads) {
    WorldInit made{};
    made.desc = world_desc(PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_RESTITUTION |
                           PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES);
    made.desc.gravity = gravity;
    made.desc.threads = threads;
    made.infos = settings_table().infos();
    for (const PlumbSettingInfo& info : made.infos) made.values.push_back(info.default_value);
    return made;
  }
  void add_box(PlumbShape& id, const PlumbVec3& half_extents) {
    PlumbShapeDesc desc = shape_desc(PLUMB_BOX);
    desc.half_extents = half_extents;
    add_shape(id, desc);
  }
  void add_shape(PlumbShape& id, const PlumbShapeDesc& desc) {
    id = shapes_++ + (std::uint64_t{1} << 32);
    world_.create_shapes({&desc, 1}, {&id, 1});
  }
  PlumbBody add(const PlumbBodyDesc& desc) {
    PlumbBody id = bodies_++ + (std::uint64_t{1} << 32);
    world_.create_bodies({&desc, 1}, {&id, 1});
    return id;
  }

  World world_;
  PlumbShape box_ = 0;
  std::uint64_t shapes_ = 0, bodies_ = 0;
};

class EachSolver : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, EachSolver, testing::Values("tgs_soft", "once", "si", "jacobi", "xpbd"),
                         [](const auto& at) { return std::string(at.param); });

/// Gravity that leans by `degrees`, so that level ground is a slope.
PlumbVec3 leaning(double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  return {kWeight * std::sin(a), -kWeight * std::cos(a), 0};
}

TEST_P(EachSolver, CarriesTheWeightOfABox) {
  CubeWorld world(GetParam());
  world.cube({0, 0.5, 0});
  world.run(1);
  double impulse = 0;
  for (int k = 0; k < 60; ++k) {
    world.step();
    for (const PlumbContact& contact : world.contacts()) impulse += contact.normal_impulse / 60;
  }
  EXPECT_NEAR(impulse, 1000 * kWeight * kDt, 1e-3 * 1000 * kWeight * kDt);
}

TEST_P(EachSolver, KeepsMomentumWhenTwoCollide) {
  CubeWorld world(GetParam(), 1, {0, 0, 0}, false);
  const PlumbBody a = world.cube({0, 0, 0}, {2, 0, 0}, 0.5), b = world.cube({1.5, 0.3, 0.2}, {-1, 0, 0}, 0.5, 3000);
  world.run(2);
  const PlumbVec3 va = world.speed(a).linear, vb = world.speed(b).linear;
  EXPECT_GT(vb.x - va.x, 0.1);  // they did collide, and part
  EXPECT_NEAR(1000 * va.x + 3000 * vb.x, -1000, 0.01);
  EXPECT_NEAR(1000 * va.y + 3000 * vb.y, 0, 0.01);
  EXPECT_NEAR(1000 * va.z + 3000 * vb.z, 0, 0.01);
}

/// tan 26.57 deg is the friction. The creep that is let pass is that of xpbd, whose friction starts anew in each part.
TEST_P(EachSolver, HoldsABoxOnASlopeOrLetsItSlide) {
  for (const double degrees : {25.0, 28.0}) {
    CubeWorld world(GetParam(), 1, leaning(degrees));
    const PlumbBody box = world.cube({0, 0.5, 0});
    world.run(2);
    const double a = degrees * std::numbers::pi / 180;
    const double slides = std::max(0.0, 0.5 * kWeight * (std::sin(a) - 0.5 * std::cos(a)) * 4);
    EXPECT_NEAR(world.place(box).x, slides, 0.03) << degrees;
  }
}

/// Those that end a pass with friction. tgs_soft ends it with the normals, and so does not promise the cone.
class FrictionLastSolver : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, FrictionLastSolver, testing::Values("si", "jacobi", "xpbd"),
                         [](const auto& at) { return std::string(at.param); });

TEST_P(FrictionLastSolver, StaysWithinTheFrictionCone) {
  CubeWorld world(GetParam(), 1, leaning(20));
  for (int i = 0; i < 6; ++i) world.cube({0.15 * i, 0.5 + i, 0.1 * (i % 2)}, {0.5 * i, 0, -0.3});
  constexpr double slack = 1e-4;
  for (int k = 0; k < 90; ++k) {
    world.step();
    double most = 0;
    for (const PlumbContact& contact : world.contacts()) most = std::max(most, contact.normal_impulse);
    for (const PlumbContact& contact : world.contacts()) {
      const PlumbVec3& t = contact.tangent_impulse;
      ASSERT_GE(contact.normal_impulse, 0);
      ASSERT_LE(std::hypot(t.x, t.y, t.z), 0.5 * contact.normal_impulse + slack * most) << "step " << k;
    }
  }
}

TEST_P(EachSolver, LetsATowerOfTenStand) {
  CubeWorld world(GetParam());
  std::vector<PlumbBody> tower;
  for (int i = 0; i < 10; ++i) tower.push_back(world.cube({0, 0.5 + i, 0}));
  world.run(10);
  for (int i = 0; i < 10; ++i) {
    const PlumbVec3 at = world.place(tower[static_cast<std::size_t>(i)]);
    EXPECT_NEAR(at.y, 0.5 + i, 0.1) << i;
    EXPECT_LT(std::hypot(at.x, at.z), 0.05) << i;
  }
}

/// Four cubes in a square below, one on all of them, and a pile of three on that. Who lies lower is made earlier; the
/// four are made in either order.
std::vector<PlumbBody> heap(CubeWorld& world, bool backwards) {
  const std::vector<PlumbVec3> places = {{0, 0.5, 0},     {1.2, 0.5, 0},   {0, 0.5, 1.2},    {1.2, 0.5, 1.2},
                                         {0.6, 1.5, 0.6}, {0.6, 2.5, 0.5}, {0.6, 3.5, 0.55}, {0.5, 4.5, 0.55}};
  std::vector<PlumbBody> bodies(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::size_t k = backwards && i < 4 ? 3 - i : i;
    bodies[k] = world.cube(places[k]);
  }
  return bodies;
}

TEST_P(EachSolver, GivesTheSameBitsForAnyThreads) {
  CubeWorld one(GetParam(), 1), two(GetParam(), 2);
  std::vector<PlumbBody> bodies;
  for (int i = 0; i < 300; ++i) {
    const PlumbVec3 at = {1.05 * (i % 10), 0.6 + 1.1 * (i / 100), 1.05 * (i / 10 % 10)};
    const PlumbVec3 velocity = {0.1 * (i % 7), 0, 0.1 * (i % 5)};
    bodies.push_back(one.cube(at, velocity));
    two.cube(at, velocity);
  }
  one.run(1);
  two.run(1);
  for (const PlumbBody body : bodies) {
    const PlumbVec3 a = one.place(body), b = two.place(body);
    const CubeWorld::Speed v = one.speed(body), w = two.speed(body);
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
    EXPECT_EQ(std::memcmp(&v, &w, sizeof v), 0);
  }
}

/// How far apart the heaps are after a quarter of a second.
double difference_by_order(const char* solver) {
  CubeWorld forth(solver), back(solver);
  const std::vector<PlumbBody> a = heap(forth, false), b = heap(back, true);
  forth.run(0.25);
  back.run(0.25);
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const PlumbVec3 p = forth.place(a[i]), q = back.place(b[i]);
    most = std::max(most, std::hypot(p.x - q.x, p.y - q.y, p.z - q.z));
  }
  return most;
}

/// All contacts at once: the order of the contacts reaches the result by rounding alone.
TEST(Jacobi, DoesNotDependOnTheOrder) { EXPECT_LT(difference_by_order("jacobi"), 5e-6); }

/// A body on four others is in four parts, and the heap keeps its momentum though nothing holds it.
TEST(Jacobi, KeepsTheMomentumOfABodyInManyParts) {
  CubeWorld world("jacobi", 1, {0, 0, 0}, false);
  const std::vector<PlumbBody> bodies = heap(world, false);
  const PlumbBody hammer = world.cube({0.55, 6.5, 0.55}, {0, -6, 0});
  world.run(1);
  PlumbVec3 sum = world.speed(hammer).linear;
  EXPECT_GT(sum.y, -5);
  for (const PlumbBody body : bodies) {
    const PlumbVec3 v = world.speed(body).linear;
    sum = {sum.x + v.x, sum.y + v.y, sum.z + v.z};
  }
  EXPECT_NEAR(sum.x, 0, 1e-4);
  EXPECT_NEAR(sum.y, -6, 1e-4);
  EXPECT_NEAR(sum.z, 0, 1e-4);
}

/// What falls fifty times as fast is foreseen at the ground fifty times as far off.
TEST_P(EachSolver, FindsTheGroundThatAHeavyScaleOfGravityReachesWithinTheStep) {
  CubeWorld world(GetParam());
  world.gravity_scale = 50;
  const PlumbBody box = world.cube({0, 0.53, 0});
  world.step();
  EXPECT_GT(world.place(box).y, 0.49);
}

class PassingSolver : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, PassingSolver, testing::Values("si", "jacobi"),
                         [](const auto& at) { return std::string(at.param); });

TEST_P(PassingSolver, StopsEarlyWhenNothingChanges) {
  CubeWorld world(GetParam());
  for (int i = 0; i < 3; ++i) world.cube({0, 0.5 + i, 0});
  world.set("iterations", 500);
  world.step();
  EXPECT_GT(world.passes(), 5U);  // impulses begin at 0
  world.run(3);
  EXPECT_LE(world.passes(), 5U);
  world.set("stop_below", 0);
  world.step();
  EXPECT_EQ(world.passes(), 500U);
}

/// Others get the passes that they need, whatever is left of an impulse that overflows: inf, or NaN.
TEST_P(PassingSolver, IsNotToldWhenToStopByWhoIsLost) {
  std::uint32_t passes[2];
  for (const std::uint32_t lost : {0U, 1U}) {
    CubeWorld world(GetParam());
    world.set("iterations", 500);
    for (int i = 0; i < 3; ++i) world.cube({0, 0.5 + i, 0});
    if (lost != 0) world.overflowing_ball({20, 0.5, 0});
    world.step(lost);
    passes[lost] = world.passes();
  }
  EXPECT_GT(passes[0], 5U);
  EXPECT_EQ(passes[1], passes[0]);
}

TEST_P(PassingSolver, LeavesOverlapAloneWithoutBias) {
  for (const double bias : {0.0, 0.2}) {
    CubeWorld world(GetParam());
    const PlumbBody box = world.cube({0, 0.4, 0});
    world.set("bias", bias);
    world.run(2);
    EXPECT_NEAR(world.place(box).y, bias == 0 ? 0.4 : 0.49, 0.002);
  }
}

/// The memory of contacts goes from solver to solver.
TEST(Solvers, CanBeChangedBetweenSteps) {
  CubeWorld world("tgs_soft");
  std::vector<PlumbBody> tower;
  for (int i = 0; i < 5; ++i) tower.push_back(world.cube({0, 0.5 + i, 0}));
  for (const char* solver : {"si", "jacobi", "xpbd", "jacobi", "tgs_soft", "xpbd", "si"}) {
    world.set("solver", 0, solver);
    world.run(0.5);
  }
  EXPECT_NEAR(world.place(tower[4]).y, 4.5, 0.05);
}

}  // namespace
}  // namespace plumb::impulse
