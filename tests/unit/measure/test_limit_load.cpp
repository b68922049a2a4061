// Limit loads by linear programming, against closed forms, the other way, and the catalogue's digits.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../truth_units.hpp"
#include "limit_load.hpp"
#include "truth/structures.hpp"

namespace plumb::truth {
namespace {

/// Where the largest load of a family passes through 0: there it begins to carry its own weight.
template <class Load>
double begins_to_stand(double fails, double stands, const Load& load) {
  for (int i = 0; i < 36; ++i) {
    const double middle = (fails + stands) / 2;
    const std::optional<double> most = load(middle);
    (most && *most >= 0 ? stands : fails) = middle;
  }
  return (fails + stands) / 2;
}

TEST(LimitLoad, ABlockIsPushedAlongOrOver) {
  for (const double friction : {0.2, 0.4, 0.9}) {
    PlaneStructure block;
    block.blocks = {{{0, 1}, 3}};  // 1 m wide, 2 m high
    block.add_face(PlaneContact::ground, 0, {-0.5, 0}, {0.5, 0}, {0, 1}, friction);
    const LiveLoad push{0, {0, 1}, {1, 0}};
    const auto most = largest_load(block, std::span(&push, 1));
    ASSERT_TRUE(most.has_value());
    EXPECT_NEAR(*most, 3 * std::min(friction, 0.5), 1e-8) << friction;
    const LiveLoad press{0, {0, 1}, {0, -1}};
    EXPECT_EQ(largest_load(block, std::span(&press, 1)), std::numeric_limits<double>::infinity());
  }
}

TEST(LimitLoad, HarmonicStackCarriesAHandAtItsTipUpToItsShareOfOne) {
  const auto load = [](double share) {
    const PlaneStructure stack = harmonic_stack(5, 0.3, share, 0.5);
    const int top = static_cast<int>(stack.blocks.size()) - 1;
    const LiveLoad hand{top, stack.blocks.back().centre + Eigen::Vector2d(0.5, 0.15), {0, -1}};
    return largest_load(stack, std::span(&hand, 1));
  };
  EXPECT_NEAR(begins_to_stand(1.2, 0.5, load), 1, 1e-7);
  EXPECT_GT(load(0.9).value_or(-1), 0.01);
}

TEST(LimitLoad, FourSpheresBetweenPyramids) {
  const double truth = four_spheres().critical_friction;
  const auto critical = [](Pyramid pyramid, int sides) {
    double fails = 0.2, stands = 0.5;
    for (int i = 0; i < 16; ++i) {
      const double middle = (fails + stands) / 2;
      (can_stand(four_spheres_structure(middle), pyramid, sides) ? stands : fails) = middle;
    }
    return (fails + stands) / 2;
  };
  for (const int sides : {6, 22}) {
    const double below = critical(Pyramid::outside, sides), above = critical(Pyramid::inside, sides);
    const double apart = 1 / std::cos(std::numbers::pi / sides) - 1;
    EXPECT_LE(below, truth + 1e-5) << sides;
    EXPECT_GE(above, truth - 1e-5) << sides;
    EXPECT_LT(above - below, 2 * apart * truth) << sides;
  }
}

TEST(LimitLoad, ArchesCarryNothingAtTheirCrownWhereTheyBeginToStand) {
  const auto crown = [](const PlaneStructure& arch) {
    const int keystone = static_cast<int>(arch.blocks.size() / 2);
    const LiveLoad load{keystone, arch.blocks[arch.blocks.size() / 2].centre, {0, -1}};
    return largest_load(arch, std::span(&load, 1));
  };
  const auto thickness = [&](std::size_t stones) {
    return begins_to_stand(0.02, 0.3, [&](double t) {
      return crown(voussoir_arch({stones, 5 * (1 - t / 2), 5 * (1 + t / 2)}, 0.8));
    });
  };
  EXPECT_NEAR(thickness(7), .095705, 3e-6);
  EXPECT_NEAR(thickness(11), .104591, 3e-6);
  EXPECT_NEAR(thickness(15), .106069, 3e-6);
  EXPECT_NEAR(thickness(21), .106695, 3e-6);
  EXPECT_NEAR(begins_to_stand(0.05, 0.8,
                              [&](double mu) {
                                return crown(voussoir_arch({15, 4.5, 5.5}, mu));
                              }),
              .30899, 6e-6);
}

TEST(LimitLoad, CattosArchCarriesSoManyBoxes) {
  const auto boxes_on_keystone = [](double friction) {
    const PlaneStructure arch = catto_arch(0, false, friction);
    const double top = CattoArch::outer[CattoArch::corners - 1][1];
    const LiveLoad box{16, {0, top}, {0, -4}};
    return largest_load(arch, std::span(&box, 1));
  };
  const double expected[] = {.21701, .35809, .52710, .65142, .74721};
  for (int boxes = 0; boxes < 5; ++boxes) {
    const double critical = begins_to_stand(0.05, 2, [&](double mu) {
      const auto most = boxes_on_keystone(mu);
      return most ? std::optional(*most - boxes) : most;
    });
    EXPECT_NEAR(critical, expected[boxes], 6e-6) << boxes;
  }
  const double wide = begins_to_stand(0.05, 2, [&](double mu) {
    const PlaneStructure arch = catto_arch(4, true, mu);
    const LiveLoad more{20, arch.blocks[20].centre, {0, -1}};
    return largest_load(arch, std::span(&more, 1));
  });
  EXPECT_NEAR(wide, .48233, 6e-6);
}

TEST(LimitLoad, CardsAndLadderBeginToStandWhereTheirClosedFormsSay) {
  const auto pushed = [](const PlaneStructure& structure, const Eigen::Vector2d& outward) {
    const LiveLoad load{0, structure.contacts[0].point, outward};
    return largest_load(structure, std::span(&load, 1));
  };
  for (const double lean : {10.0, 25.0, 40.0})
    EXPECT_NEAR(begins_to_stand(0.01, 2,
                                [&](double mu) {
                                  return pushed(card_frame(lean * degree, mu), {-1, 0});
                                }),
                card_frame_friction(lean * degree), 1e-7)
        << lean;
  for (const double mu : {0.2, 0.5, 0.8})
    EXPECT_NEAR(begins_to_stand(0, 85 * degree,
                                [&](double slope) {
                                  return pushed(ladder(2, 0.05, slope, mu), {-1, 0});
                                }),
                ladder_slope(2, 0.05, mu), 1e-7)
        << mu;
}

}  // namespace
}  // namespace plumb::truth
