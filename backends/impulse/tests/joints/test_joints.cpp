// Joints against closed forms: pendulums, a slope, free flight; and that momentum and bits are kept.
#include <algorithm>
#include <array>

#include "tests/rigs/joint_rig.hpp"

namespace plumb::impulse {
namespace {

constexpr double kRound = sizeof(Real) == 8 ? 1e-9 : 1e-5;  // what rounding may leave of errors of order one

/// Time of a whole swing: from rest on one side until it is at rest there again, from the sign of the speed.
double swing(JointRig& rig, PlumbBody body, double dt = 1.0 / 60) {
  double before = 0;
  int turns = 0;
  for (int i = 1; i < 2000; ++i) {
    rig.step(dt);
    const double now = rig.speed(body).angular.z;
    if (i > 2 && before * now < 0 && ++turns == 2) return dt * (i - 1 + before / (before - now));
    before = now;
  }
  return 0;
}

/// Period of a pendulum of reduced length l let go at an angle: 2 pi sqrt(l / g) / agm(1, cos(a / 2)).
double pendulum_period(double length, double angle) {
  double a = 1, b = std::cos(angle / 2);
  for (int i = 0; i < 20; ++i) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return 2 * kPi_ * std::sqrt(length / kGravity) / a;
}

TEST(Joints, PendulumsOfEveryKindSwingInTheRightTime) {
  for (const PlumbJointType type : {PLUMB_JOINT_BALL, PLUMB_JOINT_HINGE})
    for (const double degrees : {5.0, 90.0, 160.0}) {
      const double a = degrees * kPi_ / 180;
      JointRig rig;
      const PlumbBody bob = rig.body({std::sin(a), -std::cos(a), 0}, 2, {0.2, 0.2, 0.2});
      rig.join_at(type, 0, bob, {0, 0, 0}, about({0, 1, 0}, -kPi_ / 2));
      const double expected = pendulum_period(1 + 0.1, a);  // l + I / (m l)
      EXPECT_NEAR(swing(rig, bob), expected, 1e-3 * expected) << type << " from " << degrees;
    }
}

TEST(Joints, HingeKeepsItsPlaceAndItsAxisAtHighSpeed) {
  JointRig rig;
  const PlumbBody wheel = rig.body({1, 0, 0}, 1, {0.01, 0.1, 0.1}, {0, 0, 0, 1}, {0, 30, 0}, {0, 0, 30});
  const PlumbJoint axle = rig.join_at(PLUMB_JOINT_HINGE, 0, wheel, {0, 0, 0}, about({0, 1, 0}, -kPi_ / 2));
  for (int i = 0; i < 300; ++i) {
    rig.step();
    const auto at = rig.coordinates(axle);
    for (const std::size_t axis : {0U, 1U, 2U, 4U, 5U}) EXPECT_NEAR(at[axis], 0, 2e-3) << axis;
  }
  EXPECT_GT(std::abs(rig.speed(wheel).angular.z), 25);
}

TEST(Joints, SliderGoesDownASlopeWithoutFriction) {
  JointRig rig;
  const PlumbQuat slope = about({0, 0, 1}, -kPi_ / 6);
  const PlumbBody sled = rig.body({3, 2, 1}, 4, {0.3, 0.2, 0.1}, slope);
  const PlumbJoint rail = rig.join_at(PLUMB_JOINT_SLIDER, 0, sled, {3, 2, 1}, slope);
  const double seconds = 2;
  rig.run(seconds);
  const auto at = rig.coordinates(rail);
  EXPECT_NEAR(at[0], kGravity / 2 * seconds * seconds / 2, 0.002 * kGravity);
  for (std::size_t axis = 1; axis < 6; ++axis) EXPECT_NEAR(at[axis], 0, kRound) << axis;
}

TEST(Joints, DistanceIsKept) {
  JointRig rig;
  const PlumbBody a = rig.body({0, 0, 0}, 1, {0.1, 0.2, 0.3}, {0, 0, 0, 1}, {1, 2, 3}, {3, 2, 1});
  const PlumbBody b = rig.body({2, 0, 0}, 3, {0.1, 0.1, 0.1}, {0, 0, 0, 1}, {0, -4, 0}, {0, 5, 0});
  PlumbJointDesc rod = joint_desc(PLUMB_JOINT_DISTANCE);
  rod.body_a = a;
  rod.body_b = b;
  rod.frame_a.position = {0.25, 0.5, 0};
  rod.frame_b.position = {-0.25, 0, 0};
  rod.rest_length = std::sqrt(1.5 * 1.5 + 0.5 * 0.5);
  const PlumbJoint id = rig.join(rod);
  for (int i = 0; i < 300; ++i) {
    rig.step();
    const auto at = rig.coordinates(id);
    EXPECT_NEAR(std::hypot(at[0], at[1], at[2]), rod.rest_length, 1e-4);
  }
}

TEST(Joints, FixedPairFliesAsOneBody) {
  JointRig rig;
  // Together: mass 4, centre at x = 1.5, inertia about y and z 0.1 + 0.3 + reduced mass 0.75 times 2^2.
  const double spin = 2;
  const PlumbBody a = rig.body({0, 0, 0}, 1, {0.1, 0.1, 0.1}, {0, 0, 0, 1}, {1, 5 - 1.5 * spin, 0}, {0, 0, spin});
  const PlumbBody b = rig.body({2, 0, 0}, 3, {0.3, 0.3, 0.3}, {0, 0, 0, 1}, {1, 5 + 0.5 * spin, 0}, {0, 0, spin});
  const PlumbJoint weld = rig.join_at(PLUMB_JOINT_FIXED, a, b, {0.7, 0.4, 0.1}, about({0, 0.6, 0.8}, 1.2));
  const double dt = 1.0 / 60;
  rig.run(1, dt);
  const double h = dt / 8;
  const PlumbPose p = rig.pose(a), q = rig.pose(b);
  const PlumbVec3 centre = {(p.position.x + 3 * q.position.x) / 4, (p.position.y + 3 * q.position.y) / 4,
                            (p.position.z + 3 * q.position.z) / 4};
  EXPECT_NEAR(centre.x, 1.5 + 1, kRound);
  EXPECT_NEAR(centre.y, 5 - kGravity / 2 * (1 + h), 2 * kRound);  // symplectic Euler falls h / T further
  EXPECT_NEAR(centre.z, 0, kRound);
  const double turned = spin * spin * spin * h * h;  // second order in the sub-step
  EXPECT_NEAR(std::atan2(q.position.y - p.position.y, q.position.x - p.position.x), spin, turned);
  for (const PlumbBody body : {a, b}) EXPECT_NEAR(rig.speed(body).angular.z, spin, 10 * kRound);
  for (const double coordinate : rig.coordinates(weld)) EXPECT_NEAR(coordinate, 0, 10 * kRound);
}

TEST(Joints, MomentumIsKeptInFreeSpace) {
  for (const PlumbJointType type :
       {PLUMB_JOINT_BALL, PLUMB_JOINT_HINGE, PLUMB_JOINT_SLIDER, PLUMB_JOINT_DISTANCE, PLUMB_JOINT_FIXED}) {
    JointRig rig(PLUMB_NEED_ROTATION | PLUMB_NEED_GYROSCOPIC | PLUMB_NEED_JOINTS, {0, 0, 0});
    const PlumbVec3 inertia = {0.2, 0.3, 0.4};
    std::vector<PlumbBody> bodies;
    for (int i = 0; i < 3; ++i)
      bodies.push_back(rig.body({i * 1.0, 0.1 * i, 0}, 2, inertia, about({0, 0.6, 0.8}, 0.5 * i),
                                {0.5 * i, 1.0 - i, 0.3}, {1, 2.0 * i, -1}));
    for (std::size_t i = 0; i < 2; ++i) {
      const double x = static_cast<double>(i) + 0.5;
      if (type != PLUMB_JOINT_DISTANCE) {
        rig.join_at(type, bodies[i], bodies[i + 1], {x, 0.05, 0.2});
        continue;
      }
      PlumbJointDesc rod = joint_desc(type);
      rod.body_a = bodies[i];
      rod.body_b = bodies[i + 1];
      rod.rest_length = std::hypot(1.0, 0.1);
      rig.join(rod);
    }
    rig.step();  // speeds that the joints forbid are gone after it
    const auto first = momentum(rig, bodies, 2, inertia);
    rig.run(5);
    const auto last = momentum(rig, bodies, 2, inertia);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(first[i], last[i], sizeof(Real) == 8 ? 1e-6 : 2e-3) << type << " " << i;
  }
}

/// A chain with a heavy end, its bodies and joints made in the order given; where the end is after a second.
PlumbVec3 chain_end(const std::vector<int>& order, std::uint32_t threads = 1) {
  JointRig rig(PLUMB_NEED_ROTATION | PLUMB_NEED_GYROSCOPIC | PLUMB_NEED_JOINTS, {0, -kGravity, 0}, threads);
  std::vector<PlumbBody> links(order.size());
  const int last = static_cast<int>(order.size()) - 1;
  for (const int i : order)
    links[static_cast<std::size_t>(i)] = rig.body({i + 0.5, 0, 0}, i == last ? 100 : 1, {0.01, 0.1, 0.1});
  for (const int i : order) {
    const auto at = static_cast<std::size_t>(i);
    rig.join_at(i % 2 == 0 ? PLUMB_JOINT_BALL : PLUMB_JOINT_HINGE, i == 0 ? 0 : links[at - 1], links[at],
                {static_cast<double>(i), 0, 0}, about({0, 1, 0}, -kPi_ / 2));
  }
  rig.run(1);
  return rig.pose(links.back()).position;
}

TEST(Joints, OrderOfCreationMattersNoMoreThanRounding) {
  const PlumbVec3 forth = chain_end({0, 1, 2, 3, 4, 5, 6, 7}), mixed = chain_end({5, 2, 7, 0, 3, 6, 1, 4});
  EXPECT_NEAR(forth.x, mixed.x, 10 * kRound);
  EXPECT_NEAR(forth.y, mixed.y, 10 * kRound);
  EXPECT_LT(forth.y, -3);
}

/// Ten passes do not carry a tip of 100 links' weight: the chain gives way, but it does not swing up.
TEST(Joints, HeavyTipStretchesAChainWherePassesDoNotSuffice) {
  for (const double solver : {1, 2}) {
    JointRig rig;
    rig.choose_solver(solver);
    std::vector<PlumbJoint> joints;
    PlumbBody before = 0;
    for (int i = 0; i < 11; ++i) {
      const PlumbBody link = rig.body({0, -i - 0.5, 0}, i == 10 ? 100 : 1, {0.1, 0.1, 0.1});
      joints.push_back(rig.join_at(PLUMB_JOINT_BALL, before, link, {0, -1.0 * i, 0}));
      before = link;
    }
    for (int i = 0; i < 600; ++i) {
      rig.step();
      for (const PlumbJoint joint : joints) {
        const auto at = rig.coordinates(joint);
        ASSERT_LT(std::hypot(at[0], at[1], at[2]), 0.5) << solver << " step " << i;
      }
    }
  }
}

/// A light chain hangs in folds while the load at its end falls: when it snaps taut, again and again, energy is lost
/// and none made. The load is nearly all that weighs.
TEST(Joints, AChainThatSnapsTautMakesNoEnergy) {
  for (const int links : {6, 10, 20})
    for (const double load : {100.0, 1000.0}) {
      JointRig rig;
      PlumbVec3 end = {0, 0, 0};
      PlumbBody before = 0;
      const auto add = [&](double mass, const PlumbVec3& way) {
        const PlumbVec3 at = {end.x + way.x / 2, end.y + way.y / 2, 0};
        const PlumbBody link =
            rig.body(at, mass, {mass / 300, mass / 3000, mass / 300}, about({0, 0, 1}, std::atan2(way.x, -way.y)));
        rig.join_at(PLUMB_JOINT_BALL, before, link, end);
        before = link;
        end = {end.x + way.x, end.y + way.y, 0};
      };
      for (int i = 0; i < links; ++i) add(0.5, {i % 2 == 0 ? 0.17 : -0.17, -0.1, 0});
      add(load, {0.1, -0.2, 0});
      const auto energy = [&] {
        const PlumbVec3 v = rig.speed(before).linear;
        return kGravity * rig.pose(before).position.y + (v.x * v.x + v.y * v.y + v.z * v.z) / 2;
      };
      const double start = energy();
      double most = start;
      for (int i = 0; i < 600; ++i) {
        rig.step();
        most = std::max(most, energy());
      }
      EXPECT_LT(most, start + 0.01 * kGravity * 0.2 * links) << links << " links, " << load << " kg";
    }
}

/// Twelve rods let go level crack like a whip; moments across them are the worst that float has to tell apart.
TEST(Joints, LongChainOfHingesSwings) {
  JointRig rig;
  std::vector<PlumbJoint> joints;
  std::vector<PlumbBody> rods;
  PlumbBody before = 0;
  for (int i = 0; i < 12; ++i) {
    const double x = i;
    rods.push_back(rig.body({x + 0.5, 0, 0}, 1, {0.01, 1.0 / 12, 1.0 / 12}));
    joints.push_back(rig.join_at(PLUMB_JOINT_HINGE, before, rods.back(), {x, 0, 0}, about({0, 1, 0}, -kPi_ / 2)));
    before = rods.back();
  }
  for (int i = 0; i < 300; ++i) {
    rig.step();
    for (const PlumbJoint joint : joints) {
      const auto at = rig.coordinates(joint);
      ASSERT_LT(std::hypot(at[0], at[1], at[2]), 0.01) << "step " << i;
    }
  }
}

TEST(Joints, ThreadsGiveTheSameBits) {
  std::vector<int> order(200);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  const PlumbVec3 one = chain_end(order, 1), two = chain_end(order, 2);
  EXPECT_EQ(one.x, two.x);
  EXPECT_EQ(one.y, two.y);
  EXPECT_EQ(one.z, two.z);
}

TEST(Joints, ParallelogramOfFourHingesStaysClosedWhenItSpins) {
  JointRig rig(PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS);
  const double spin = 25;
  const PlumbVec3 thin = {1.0 / 12, 0.001, 1.0 / 12};
  std::vector<PlumbBody> cranks;
  const PlumbQuat axes = about({0, 1, 0}, -kPi_ / 2);
  for (const double x : {0.0, 2.0})
    cranks.push_back(rig.body({x, -0.5, 0}, 1, thin, {0, 0, 0, 1}, {spin / 2, 0, 0}, {0, 0, spin}));
  const PlumbBody coupler = rig.body({1, -1, 0}, 1, {0.001, 1.0 / 3, 1.0 / 3}, {0, 0, 0, 1}, {spin, 0, 0});
  std::vector<PlumbJoint> hinges;
  for (std::size_t i = 0; i < 2; ++i) {
    const double x = 2 * static_cast<double>(i);
    hinges.push_back(rig.join_at(PLUMB_JOINT_HINGE, 0, cranks[i], {x, 0, 0}, axes));
    hinges.push_back(rig.join_at(PLUMB_JOINT_HINGE, cranks[i], coupler, {x, -1, 0}, axes));
  }
  for (int i = 0; i < 600; ++i) {
    rig.step();
    for (const PlumbJoint hinge : hinges) {
      const auto at = rig.coordinates(hinge);
      EXPECT_LT(std::hypot(at[0], at[1], at[2]), 0.01);
    }
  }
  EXPECT_NEAR(std::abs(rig.speed(cranks[0]).angular.z), spin, 3);
}

/// A sheet of balls on rods is too full for one matrix: joint by joint.
TEST(Joints, SheetHangsTogether) {
  JointRig rig(PLUMB_NEED_JOINTS);
  constexpr std::size_t kSide = 16;
  std::vector<PlumbBody> grid;
  for (std::size_t i = 0; i < kSide * kSide; ++i)
    grid.push_back(rig.body({0.1 * static_cast<double>(i % kSide), 0, 0.1 * static_cast<double>(i / kSide)}, 0.1));
  std::vector<PlumbJoint> rods;
  const auto rod = [&](PlumbBody a, PlumbBody b, const PlumbVec3& at) {
    PlumbJointDesc desc = joint_desc(a == 0 ? PLUMB_JOINT_BALL : PLUMB_JOINT_DISTANCE);
    desc.body_a = a;
    desc.body_b = b;
    desc.frame_a.position = at;
    desc.rest_length = 0.1;
    const PlumbJoint made = rig.join(desc);
    if (a != 0) rods.push_back(made);
  };
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (i < kSide) rod(0, grid[i], rig.pose(grid[i]).position);
    if (i % kSide != 0) rod(grid[i - 1], grid[i], {0, 0, 0});
    if (i >= kSide) rod(grid[i - kSide], grid[i], {0, 0, 0});
  }
  rig.run(2);
  double worst = 0;
  for (const PlumbJoint joint : rods) {
    const auto at = rig.coordinates(joint);
    worst = std::max(worst, std::abs(std::hypot(at[0], at[1], at[2]) - 0.1));
  }
  EXPECT_LT(worst, 0.005);
}

/// One by one a chain gives, all at once it does not; which of the two may be said while it swings.
TEST(Joints, OfTheIterativeSolverGive) {
  JointRig rig;
  std::vector<PlumbJoint> joints;
  PlumbBody before = 0;
  for (int i = 0; i < 20; ++i) {
    const PlumbBody link = rig.body({0.2 * i + 0.1, 0, 0}, 0.5, {0.002, 0.002, 0.002});
    joints.push_back(rig.join_at(PLUMB_JOINT_BALL, before, link, {0.2 * i, 0, 0}));
    before = link;
  }
  const auto gap_in = [&](double seconds) {
    double widest = 0;
    for (double t = 0; t < seconds; t += 1.0 / 60) {
      rig.step();
      for (const PlumbJoint joint : joints) {
        const auto at = rig.coordinates(joint);
        widest = std::max(widest, std::hypot(at[0], at[1], at[2]));
      }
    }
    return widest;
  };
  EXPECT_LT(gap_in(1), 1e-3);
  rig.choose("joint_solver", "iterative");
  const double loose = gap_in(2);
  EXPECT_GT(loose, 3e-3);
  EXPECT_LT(loose, 0.1);
  rig.choose("joint_solver", "auto");
  (void)gap_in(0.5);
  EXPECT_LT(gap_in(1), 1e-3);
}

}  // namespace
}  // namespace plumb::impulse
