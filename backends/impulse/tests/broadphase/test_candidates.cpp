// Which of many points of a contact are kept: those that the body rests on now, before those that it may tip onto.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "narrowphase/convex/candidates.hpp"

namespace plumb::impulse {
namespace {

std::vector<std::uint32_t> chosen(std::vector<Candidate> points) {
  const int count = choose_points(points.data(), static_cast<int>(points.size()), kTie);
  std::vector<std::uint32_t> features;
  for (int i = 0; i < count; ++i) features.push_back(points[static_cast<std::size_t>(i)].feature);
  std::sort(features.begin(), features.end());
  return features;
}

/// A small triangle that touches, tipped by a little, within a ring of eight points ten times as far out that hover.
std::vector<Candidate> narrow_face(Real tip, Real hover) {
  std::vector<Candidate> points{{0, 0, 0, 0}, {Real(0.1), 0, Real(0.1) * tip, 1}, {0, Real(0.1), Real(0.1) * tip, 2}};
  constexpr int kRing[8][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  for (std::uint32_t i = 0; i < 8; ++i)
    points.push_back({static_cast<Real>(kRing[i][0]), static_cast<Real>(kRing[i][1]), hover, 3 + i});
  return points;
}

TEST(Candidates, NarrowFaceKeepsItsCornersFromPointsThatHoverFarOut) {
  for (const Real tip : {Real(0), Real(0.002), Real(0.005)}) {
    const auto kept = chosen(narrow_face(tip, Real(0.3)));
    ASSERT_EQ(kept.size(), 4u) << "tip " << tip;
    EXPECT_EQ(std::vector<std::uint32_t>(kept.begin(), kept.begin() + 3), (std::vector<std::uint32_t>{0, 1, 2}))
        << "tip " << tip;
  }
}

/// A hull of many corners stands on three of them, and another hovers 3 mm above the ground, two per cent farther out:
/// without one of its three feet it would tip, then stand on others, and rock for ever.
TEST(Candidates, WhatBearsIsKeptFromWhatHoversALittleFartherOut) {
  const auto kept = chosen({{0, 0, 0, 0},
                            {1, 0, 0, 1},
                            {Real(0.5), 1, 0, 2},
                            {Real(0.5), Real(1.02), Real(0.003), 3},
                            {Real(0.2), Real(0.2), Real(0.01), 4}});
  ASSERT_GE(kept.size(), 3u);
  EXPECT_EQ(std::vector<std::uint32_t>(kept.begin(), kept.begin() + 3), (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Candidates, OfALevelFaceTheWidestFourAreKept) {
  const auto kept = chosen(narrow_face(0, 0));
  ASSERT_EQ(kept.size(), 4u);
  EXPECT_GE(kept[1], 3u);  // the first of level points stays, the rest is the ring's
}

TEST(Candidates, KeptPointsDoNotDependOnTheUnit) {
  for (const Real unit : {Real(1.0 / 1024), Real(1024)}) {
    std::vector<Candidate> scaled = narrow_face(Real(0.004), Real(0.25));
    for (Candidate& p : scaled) p = {p.x * unit, p.y * unit, p.separation * unit, p.feature};
    EXPECT_EQ(chosen(scaled), chosen(narrow_face(Real(0.004), Real(0.25))));
  }
}

}  // namespace
}  // namespace plumb::impulse
