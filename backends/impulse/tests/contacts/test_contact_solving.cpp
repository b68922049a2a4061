// A contact solved in its own frame: the same bits whatever the room for points, and what friction must be.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "contacts/contact_friction.hpp"
#include "contacts/contact_impact.hpp"
#include "contacts/contact_normals.hpp"
#include "contacts/prepare_contacts.hpp"
#include "tests/hashes/scene.hpp"

namespace plumb::impulse::test {
namespace {

struct OneContact {
  std::vector<Real> numbers = std::vector<Real>(std::size_t{kAllFields} * kRowBlock);
  ContactRows rows{};
  SolverBody<Real> a{}, b{};

  /// `count` points at random places, pressed and rubbed at random, between bodies that move at random.
  OneContact(std::uint64_t seed, int count) {
    Random random(seed);
    const auto real = [&](double low, double high) { return static_cast<Real>(random.between(low, high)); };
    const auto vec = [&](double most) -> Vec { return {real(-most, most), real(-most, most), real(-most, most)}; };
    ContactNumbers<Real> row{};
    const Vec towards = vec(1), n = (Real(1) / length(towards)) * towards, t1 = perpendicular(n);
    row.put(kNormal, n);
    row.put(kTangent, t1);
    const Vec centre_a = vec(1), centre_b = vec(1);
    row.put(kCentreA, centre_a);
    row.put(kCentreB, centre_b);
    row.at[kFriction] = real(0.1, 1);
    for (SolverBody<Real>* body : {&a, &b}) {
      body->linear = vec(2);
      body->angular = vec(3);
      body->inverse_mass = real(0.2, 2);
      body->inverse_inertia = {real(1, 2), real(1, 2), real(1, 2), real(0, 0.3), real(0, 0.3), real(0, 0.3)};
    }
    const FrameDelassus<Real> delassus(n, t1, centre_a, centre_b, a.inverse_inertia, b.inverse_inertia,
                                       a.inverse_mass + b.inverse_mass);
    PlanePoint<Real> places[kManifoldPoints] = {};
    Real largest_slip = 0;
    for (int p = 0; p < count; ++p) {
      if (count > 1) places[p] = {real(-0.5, 0.5), real(-0.5, 0.5)};
      largest_slip = max(largest_slip, delassus.largest_slip(places[p]));
      row.at[point_field(p, kPlace)] = places[p].x;
      row.at[point_field(p, kPlace) + 1] = places[p].y;
      row.at[point_field(p, kNormalImpulse)] = real(0, 1);
      row.at[point_field(p, kTangentImpulse)] = real(-0.3, 0.3);
      row.at[point_field(p, kTangentImpulse) + 1] = real(-0.3, 0.3);
      row.at[point_field(p, kNoted)] = kNotPushedYet / 2;
    }
    row.at[kTangentStep] = Real(1) / largest_slip;
    const auto points = static_cast<Real>(count);
    const NormalBlock<Real> normals(row, points, delassus, places);
    put_frame_matrix(row, points, delassus, normals, places);
    row.at[kPointCount] = points;
    row.store(numbers.data());
    rows.numbers = numbers.data();
  }

  template <int P>
  Contact<P, Real> load() const {
    return load_contact<P>(RowAccess<Real>(rows, 0));
  }
};

std::vector<Real> numbers_of(const SolverBody<Real>& body) {
  return {body.linear.x, body.linear.y, body.linear.z, body.angular.x, body.angular.y, body.angular.z};
}

/// Three passes of normals and friction.
template <int P>
std::vector<Real> solved(const OneContact& start) {
  Contact<P, Real> contact = start.load<P>();
  SolverBody<Real> a = start.a, b = start.b;
  for (int pass = 0; pass < 3; ++pass) {
    ContactMotion<Real> motion = motion_of(contact, a, b);
    ContactWrench<Real> wrench = no_wrench<Real>();
    const auto held = solve_normals(contact, hard_target(contact), motion, wrench, true);
    solve_friction(contact, motion, wrench, held);
    push(contact, wrench, a, b);
  }
  std::vector<Real> result = numbers_of(a);
  const std::vector<Real> of_b = numbers_of(b);
  result.insert(result.end(), of_b.begin(), of_b.end());
  return result;
}

/// A CPU works on as many points as there are, a GPU always on four: what is not there must not be felt.
TEST(ContactSolving, RoomForPointsThatAreNotThereChangesNoBit) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const OneContact one(seed, 1), two(seed, 2);
    ASSERT_EQ(solved<1>(one), solved<2>(one)) << "seed " << seed;
    ASSERT_EQ(solved<1>(one), solved<kManifoldPoints>(one)) << "seed " << seed;
    ASSERT_EQ(solved<2>(two), solved<kManifoldPoints>(two)) << "seed " << seed;
  }
}

/// Of points that are apart and come closer: whether impacts are looked for in the next sub-step, and what one does.
template <int P>
std::vector<Real> struck(const OneContact& start, std::uint64_t seed, bool& is_about_to) {
  Random random(seed);
  const ImpactLaw law = {Real(0.1), Real(1) / 480, 480, true};
  Contact<P, Real> contact = start.load<P>();
  contact.restitution = Real(0.6);
  const auto gap = static_cast<Real>(random.between(0, 0.02));
  contact.separation = select(contact.there(), for_all_points<P>(gap), for_all_points<P>(Real(0)));
  contact.noted = for_all_points<P>(Real(-1));
  SolverBody<Real> a = start.a, b = start.b;
  is_about_to = is_about_to_strike(contact, a, b, law);
  std::vector<Real> result = {solve_impact(contact, a, b, law) ? Real(1) : Real(0)};
  for (const SolverBody<Real>& body : {a, b})
    for (const Real number : numbers_of(body)) result.push_back(number);
  return result;
}
TEST(ContactSolving, NorDoPointsThatAreNotThereStrike) {
  int about_to = 0, striking = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const OneContact one(seed, 1), two(seed, 2);
    bool of[5];
    const std::vector<Real> alone = struck<1>(one, seed, of[0]), pair = struck<2>(two, seed, of[3]);
    ASSERT_EQ(alone, struck<2>(one, seed, of[1])) << "seed " << seed;
    ASSERT_EQ(alone, struck<kManifoldPoints>(one, seed, of[2])) << "seed " << seed;
    ASSERT_EQ(pair, struck<kManifoldPoints>(two, seed, of[4])) << "seed " << seed;
    ASSERT_TRUE(of[0] == of[1] && of[0] == of[2] && of[3] == of[4]) << "seed " << seed;
    about_to += of[0] ? 1 : 0;
    striking += alone[0] > 0 ? 1 : 0;
  }
  EXPECT_GT(about_to, 200);
  EXPECT_LT(about_to, 1800);
  EXPECT_GT(striking, 50);
}

/// The frame's matrix says what a push does to how the bodies move against each other.
TEST(ContactSolving, TheFrameAnswersAsTheBodiesDo) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const OneContact start(seed, 4);
    const auto contact = start.load<kManifoldPoints>();
    Random random(seed + 1);
    const auto real = [&] { return static_cast<Real>(random.between(-1, 1)); };
    const ContactWrench<Real> wrench = {{real(), real(), real()}, {real(), real(), real()}};
    ContactMotion<Real> by_frame = motion_of(contact, start.a, start.b);
    apply_delassus(contact.delassus, wrench.normal, by_frame);
    apply_delassus(contact.delassus, wrench.friction, by_frame);
    SolverBody<Real> a = start.a, b = start.b;
    push(contact, wrench, a, b);
    const ContactMotion<Real> by_bodies = motion_of(contact, a, b);
    const Real tolerance = 200 * kEpsilon;
    EXPECT_NEAR(by_frame.normal.along_n, by_bodies.normal.along_n, tolerance) << "seed " << seed;
    EXPECT_NEAR(by_frame.normal.about_t1, by_bodies.normal.about_t1, tolerance);
    EXPECT_NEAR(by_frame.normal.about_t2, by_bodies.normal.about_t2, tolerance);
    EXPECT_NEAR(by_frame.friction.along_t1, by_bodies.friction.along_t1, tolerance);
    EXPECT_NEAR(by_frame.friction.along_t2, by_bodies.friction.along_t2, tolerance);
    EXPECT_NEAR(by_frame.friction.about_n, by_bodies.friction.about_n, tolerance);
  }
}

/// With room to rub, one pass of friction stops the slip of a patch, and what the points do sums up to what Eigen says
/// would stop it.
TEST(ContactSolving, FrictionThatSticksStopsTheWholePatch) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const OneContact start(seed, 4);
    auto contact = start.load<kManifoldPoints>();
    contact.friction = 1000;
    contact.impulse[0] = for_all_points<kManifoldPoints>(Real(1));
    contact.impulse[1] = contact.impulse[2] = for_all_points<kManifoldPoints>(Real(0));
    ContactMotion<Real> motion = motion_of(contact, start.a, start.b);
    const Eigen::Vector3d before(motion.friction.along_t1, motion.friction.along_t2, motion.friction.about_n);
    const Real* f = contact.delassus.friction;
    Eigen::Matrix3d delassus;
    delassus << f[0], f[1], f[2], f[1], f[3], f[4], f[2], f[4], f[5];
    const Eigen::Vector3d expected = -delassus.inverse() * before;
    ContactWrench<Real> wrench = no_wrench<Real>();
    solve_friction(contact, motion, wrench, false);
    const Real tolerance = 2000 * kEpsilon;
    EXPECT_NEAR(motion.friction.along_t1, 0, tolerance) << "seed " << seed;
    EXPECT_NEAR(motion.friction.along_t2, 0, tolerance);
    EXPECT_NEAR(motion.friction.about_n, 0, tolerance);
    EXPECT_NEAR(wrench.friction.along_t1, expected.x(), tolerance * expected.norm());
    EXPECT_NEAR(wrench.friction.along_t2, expected.y(), tolerance * expected.norm());
    EXPECT_NEAR(wrench.friction.about_n, expected.z(), tolerance * expected.norm());
  }
}

/// Where one point of a patch bears all, it is its own slip that stops, whatever the patch does about it: a point
/// resists no turn about the normal. What stopped slip and turn of the whole patch drove a cart's wheel on and on.
TEST(ContactSolving, FrictionStopsTheSlipOfTheOnePointThatBearsAll) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const OneContact start(seed, 4);
    auto contact = start.load<kManifoldPoints>();
    contact.friction = 1000;
    for (PerPoint<kManifoldPoints, Real>& impulse : contact.impulse) impulse = for_all_points<kManifoldPoints>(Real(0));
    const int bears = static_cast<int>(seed % kManifoldPoints);
    contact.impulse[0].at[bears] = 1;
    ContactMotion<Real> motion = motion_of(contact, start.a, start.b);
    ContactWrench<Real> wrench = no_wrench<Real>();
    solve_friction(contact, motion, wrench, false);
    const PlanePoint<Real> place = {contact.place.x.at[bears], contact.place.y.at[bears]};
    const Real tolerance = 2000 * kEpsilon;
    EXPECT_NEAR(slip1_at(motion.friction, place), 0, tolerance) << "seed " << seed;
    EXPECT_NEAR(slip2_at(motion.friction, place), 0, tolerance);
    EXPECT_NEAR(wrench.friction.about_n, place.x * wrench.friction.along_t2 - place.y * wrench.friction.along_t1,
                tolerance * std::hypot(wrench.friction.along_t1, wrench.friction.along_t2));
  }
}

/// Wherever it ends, no point rubs beyond its circle; and a patch that slides for good rubs each point straight against
/// its own slip, as hard as it can.
TEST(ContactSolving, FrictionThatSlidesIsOnTheCircleAndAgainstTheSlip) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const OneContact start(seed, 4);
    auto contact = start.load<kManifoldPoints>();
    contact.friction = Real(1e-3);
    ContactMotion<Real> motion = motion_of(contact, start.a, start.b);
    ContactWrench<Real> wrench = no_wrench<Real>();
    for (int pass = 0; pass < 50; ++pass) solve_friction(contact, motion, wrench, false);
    for (int p = 0; p < kManifoldPoints; ++p) {
      const PlanePoint<Real> place = {contact.place.x.at[p], contact.place.y.at[p]};
      const double slip1 = slip1_at(motion.friction, place), slip2 = slip2_at(motion.friction, place);
      const double rub1 = contact.impulse[1].at[p], rub2 = contact.impulse[2].at[p];
      const double most = contact.friction * contact.impulse[0].at[p], slip = std::hypot(slip1, slip2);
      EXPECT_LE(std::hypot(rub1, rub2), most * (1 + 1e-5)) << "seed " << seed;
      if (slip < 0.05) continue;
      EXPECT_NEAR((rub1 * slip1 + rub2 * slip2) / (most * slip), -1, 1e-4) << "seed " << seed << " point " << p;
    }
  }
}

}  // namespace
}  // namespace plumb::impulse::test
