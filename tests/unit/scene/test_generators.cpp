// Generators against rows that the defining script printed: equal to the last digit.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "scene/generators.hpp"

namespace plumb::harness {
namespace {

using Row = std::array<double, 7>;

struct Generated {
  std::vector<SceneShape> shapes;
  std::vector<SceneBody> bodies;
  std::size_t statics = 0;

  Generated(const std::string& word, std::int64_t count, std::uint32_t seed = 0) {
    const auto& words = generator_words();
    const auto found = std::find(words.begin(), words.end(), word);
    generate(static_cast<std::size_t>(found - words.begin()), count, seed, 0.5, shapes, bodies);
    while (statics < bodies.size() && bodies[statics].desc.motion == PLUMB_STATIC) ++statics;
  }
  [[nodiscard]] Row cube(std::size_t i) const {
    const PlumbPose& p = bodies.at(statics + i).desc.pose;
    return {p.position.x,    p.position.y,    p.position.z,   p.orientation.x,
            p.orientation.y, p.orientation.z, p.orientation.w};
  }
  [[nodiscard]] std::array<double, 6> fixed(std::size_t i) const {
    const PlumbVec3& p = bodies.at(i).desc.pose.position;
    const PlumbVec3& h = shapes.at(*bodies.at(i).shape).desc.half_extents;
    return {p.x, p.y, p.z, h.x, h.y, h.z};
  }
};

TEST(Generators, PyramidEqualsItsDefinition) {
  const Generated pyramid("pyramid", 20);
  ASSERT_EQ(pyramid.bodies.size(), 211u);
  EXPECT_EQ(pyramid.fixed(0), (std::array<double, 6>{0, -1, 0, 500, 1, 500}));
  EXPECT_EQ(pyramid.cube(0), (Row{-9.69, 0.5, 0, 0, 0, 0, 1}));
  EXPECT_EQ(pyramid.cube(19), (Row{9.69, 0.5, 0, 0, 0, 0, 1}));
  EXPECT_EQ(pyramid.cube(57), (Row{-8.16, 3.5, 0, 0, 0, 0, 1}));
  EXPECT_EQ(pyramid.cube(209), (Row{0, 19.5, 0, 0, 0, 0, 1}));
}

TEST(Generators, ManyPyramidsEqualTheirDefinition) {
  const Generated pyramids("manypyramids", 3);
  ASSERT_EQ(pyramids.bodies.size(), 496u);
  EXPECT_EQ(pyramids.cube(0), (Row{-16.59, 0.5, -3, 0, 0, 0, 1}));
  EXPECT_EQ(pyramids.cube(54), (Row{-12, 9.5, -3, 0, 0, 0, 1}));
  EXPECT_EQ(pyramids.cube(131), (Row{-13.53, 2.5, 3, 0, 0, 0, 1}));
  EXPECT_EQ(pyramids.cube(494), (Row{12, 9.5, 3, 0, 0, 0, 1}));
  EXPECT_EQ(Generated("manypyramids", 100).fixed(0), (std::array<double, 6>{0, -1, 0, 650, 1, 650}));
}

TEST(Generators, ASeedMakesAnotherPileOfTheSameSize) {
  const Generated first("pile", 100), same("pile", 100, 0), other("pile", 100, 1), third("pile", 100, 2);
  ASSERT_EQ(other.bodies.size(), first.bodies.size());
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(first.cube(i), same.cube(i));
    EXPECT_NE(first.cube(i), other.cube(i));
    EXPECT_NE(other.cube(i), third.cube(i));
    EXPECT_NEAR(first.cube(i)[1], other.cube(i)[1], 0.2);
  }
}

TEST(Generators, PileEqualsItsDefinition) {
  const Generated pile("pile", 1000);
  ASSERT_EQ(pile.statics, 5u);
  ASSERT_EQ(pile.bodies.size(), 1005u);
  EXPECT_EQ(pile.fixed(1), (std::array<double, 6>{-6.7, 22, 0, 0.5, 22, 7.2}));
  EXPECT_EQ(pile.fixed(2), (std::array<double, 6>{6.7, 22, 0, 0.5, 22, 7.2}));
  EXPECT_EQ(pile.fixed(3), (std::array<double, 6>{0, 22, -6.7, 7.2, 22, 0.5}));
  EXPECT_EQ(pile.fixed(4), (std::array<double, 6>{0, 22, 6.7, 7.2, 22, 0.5}));
  EXPECT_EQ(pile.cube(0), (Row{-4.473337838357271, 0.986305599409702, -4.64471324568148, 0.10572360733745068,
                               0.13394230361513149, 0.8713080577251817, -0.46011329767460507}));
  EXPECT_EQ(pile.cube(1), (Row{-3.2366876849655437, 1.0491563514525402, -4.45579944928264, 0.2557372263266478,
                               -0.7001708748691142, -0.6644161850629069, 0.053947660581578086}));
  EXPECT_EQ(pile.cube(63), (Row{4.559729213578388, 0.9597447023480222, 4.545996680257199, 0.7217626776114446,
                                -0.06174583795390432, 0.402279964727296, -0.559836510672119}));
  EXPECT_EQ(pile.cube(500), (Row{0.5617147869607285, 11.508502635261758, 3.3487995788436185, -0.16790992625431234,
                                 -0.1121943669776237, 0.41920327996913564, -0.8851481744583108}));
  EXPECT_EQ(pile.cube(999), (Row{4.5316965513277125, 23.582225203154266, 0.7036873598751837, 0.037374144344690906,
                                 -0.7359129321184806, -0.5932222391040788, 0.324226317111406}));
}

TEST(Generators, WidePileStartsWithoutOverlaps) {
  const Generated pile("wide_pile", 200);
  for (std::size_t i = 0; i < 200; ++i) {
    for (std::size_t j = i + 1; j < 200; ++j) {
      const Row a = pile.cube(i), b = pile.cube(j);
      const double square =
          (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]);
      EXPECT_GT(square, 3.0) << i << " " << j;  // their bounding spheres have the diameter sqrt(3)
    }
  }
}

}  // namespace
}  // namespace plumb::harness
