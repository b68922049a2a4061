// Overlaps of random boxes and hulls against libccd, which decides them with other code.
#include <ccd/ccd.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "shapes.hpp"

namespace plumb::referee::testing {
namespace {

struct Placed {
  const Shape* shape;
  Pose pose;
};

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* result) {
  const auto* placed = static_cast<const Placed*>(object);
  const Vec3 d(direction->v[0], direction->v[1], direction->v[2]);
  const Vec3 p = placed->pose * placed->shape->support(placed->pose.rotation.transpose() * d);
  ccdVec3Set(result, p.x(), p.y(), p.z());
}

struct Tally {
  int pairs = 0, overlaps = 0, wrong_sign = 0, ours_too_deep = 0, theirs_short = 0, agree = 0;
};

// Theirs is an upper bound where moving the pair apart by it truly works; an expansion that stopped early answers less
// than the depth, and such answers are counted as short.
Tally compare(Random& random, const std::function<ShapePtr()>& make, int count) {
  Tally tally;
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = support;
  ccd.max_iterations = 500;
  ccd.epa_tolerance = 1e-8;
  for (; tally.pairs < count; ++tally.pairs) {
    const ShapePtr a = make(), b = make();
    const Placed first{a.get(), random.pose(0.6)}, second{b.get(), random.pose(0.6)};
    const Penetration ours = penetration(*a, first.pose, *b, second.pose);
    const bool touch = ccdGJKIntersect(&first, &second, &ccd) != 0;
    if (touch != (ours.depth > 0) && std::abs(ours.depth) > 1e-5) ++tally.wrong_sign;
    if (ours.depth <= 1e-5 || !touch) continue;
    ++tally.overlaps;
    double depth = 0;
    ccd_vec3_t direction, position;
    if (ccdGJKPenetration(&first, &second, &ccd, &depth, &direction, &position) != 0) continue;
    const Vec3 normal = Vec3(direction.v[0], direction.v[1], direction.v[2]).normalized();
    const double needed = overlap_along(*a, first.pose, *b, second.pose, normal);
    if (needed > depth + 1e-6)
      ++tally.theirs_short;
    else if (ours.depth > depth + 1e-6)
      ++tally.ours_too_deep;
    else if (ours.depth > depth - 1e-5)
      ++tally.agree;
  }
  return tally;
}

void expect_agreement(const Tally& tally, double least_share) {
  EXPECT_EQ(tally.wrong_sign, 0);
  EXPECT_EQ(tally.ours_too_deep, 0);
  EXPECT_GT(tally.agree, least_share * tally.overlaps)
      << tally.overlaps << " overlaps, " << tally.theirs_short << " answers that do not part the pair";
}

TEST(SecondOpinion, Boxes) {
  Random random(11);
  expect_agreement(compare(
                       random, [&] { return random.box(); }, 20000),
                   0.95);
}

TEST(SecondOpinion, Hulls) {
  Random random(12);
  expect_agreement(compare(
                       random, [&] { return random.hull(); }, 5000),
                   0.95);
}

}  // namespace
}  // namespace plumb::referee::testing
