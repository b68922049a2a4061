// Where two recordings part: held against motions whose moment is known in closed form.
#include "replay/parting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace plumb::harness {
namespace {

constexpr double dt = 0.01;
constexpr double radius = 0.5;

using Motion = std::function<PoseRow(double seconds)>;

PoseRow at(double x, double y = 0) { return {{x, y, 0}, {0, 0, 0, 1}}; }

/// Spheres (or, without shapes, particles), each with its motion; a frame every second step.
Trajectory recorded(const std::vector<Motion>& motions, bool with_shapes = true, std::uint32_t frames = 101) {
  Trajectory trajectory;
  trajectory.header = {{"dt", dt}, {"shapes", {{{"type", "sphere"}, {"radius", radius}}}}, {"bodies", Json::array()}};
  trajectory.header["bodies"].push_back({{"name", "ground"}, {"shape", nullptr}});
  for (std::size_t i = 0; i < motions.size(); ++i) {
    trajectory.header["bodies"].push_back(
        {{"name", "ball" + std::to_string(i)}, {"shape", with_shapes ? Json(0) : Json(nullptr)}});
    trajectory.moving.push_back(i + 1);
  }
  for (std::uint32_t f = 0; f < frames; ++f) {
    TrajectoryFrame frame{2 * f, {}, {}};
    for (const Motion& motion : motions) frame.poses.push_back(motion(2 * f * dt));
    trajectory.frames.push_back(std::move(frame));
  }
  return trajectory;
}

TEST(Parting, is_the_first_moment_at_which_a_body_is_a_tenth_of_its_radius_off) {
  const auto still = [](double) { return at(0); };
  // Visible beyond 0.05 m, which 0.21 t^2 passes at 0.488 s; the next frame is at 0.5 s.
  const auto leaves = [](double t) { return at(0.21 * t * t); };
  const auto parting = parting_of(recorded({still, still}), recorded({still, leaves}));
  ASSERT_TRUE(parting);
  EXPECT_TRUE(parting->visible);
  EXPECT_NEAR(parting->seconds, 0.5, 1e-12);
  EXPECT_NEAR(parting->distance, 0.21 * 0.5 * 0.5, 1e-12);
  EXPECT_EQ(parting->body, "ball1");
}

TEST(Parting, an_orientation_counts_by_what_it_moves_at_the_radius) {
  const auto still = [](double) { return at(0); };
  // A turn by an angle moves a point at the radius by 2 r sin(angle / 2): 0.05 m at 0.1 rad.
  const auto turns = [](double t) { return PoseRow{{0, 0, 0}, {0, std::sin(t / 2), 0, std::cos(t / 2)}}; };
  const auto parting = parting_of(recorded({still}), recorded({turns}));
  ASSERT_TRUE(parting);
  EXPECT_NEAR(parting->seconds, 0.12, 1e-12);
  EXPECT_NEAR(parting->distance, 2 * radius * std::sin(0.06), 1e-7);
  const auto negative = [&](double t) {
    const PoseRow row = turns(t);
    const PlumbQuat& q = row.orientation;
    return PoseRow{row.position, {-q.x, -q.y, -q.z, -q.w}};
  };
  const auto same = parting_of(recorded({turns}), recorded({negative}));
  ASSERT_TRUE(same);
  EXPECT_FALSE(same->visible);
  EXPECT_NEAR(same->distance, 0, 1e-7);
}

TEST(Parting, of_what_never_parts_tells_where_it_is_farthest) {
  const auto still = [](double) { return at(0); };
  const auto trembles = [](double t) { return at(0.04 * std::exp(-std::pow((t - 1) / 0.1, 2))); };
  const auto parting = parting_of(recorded({still}), recorded({trembles}));
  ASSERT_TRUE(parting);
  EXPECT_FALSE(parting->visible);
  EXPECT_NEAR(parting->seconds, 1, 1e-12);
  EXPECT_NEAR(parting->distance, 0.04, 1e-12);
}

TEST(Parting, of_particles_goes_by_their_way) {
  const auto falls = [](double t) { return at(0, 10 - 5 * t * t); };
  const auto slower = [](double t) { return at(0, 10 - 4 * t * t); };
  // The longer way is 20 m in 2 s, a hundredth of it .2 m: t^2 passes that after 0.447 s.
  const auto parting = parting_of(recorded({falls}, false), recorded({slower}, false));
  ASSERT_TRUE(parting);
  EXPECT_TRUE(parting->visible);
  EXPECT_NEAR(parting->seconds, 0.46, 1e-12);
}

TEST(Parting, a_lost_body_is_infinitely_far) {
  const auto still = [](double) { return at(0); };
  const auto lost = [](double t) { return at(t < 0.3 ? 0 : std::nan("")); };
  const auto parting = parting_of(recorded({still}), recorded({lost}));
  ASSERT_TRUE(parting);
  EXPECT_NEAR(parting->seconds, 0.3, 1e-12);
  EXPECT_TRUE(std::isinf(parting->distance));
}

TEST(Parting, needs_frames_in_common_and_the_same_bodies_and_step) {
  const auto still = [](double) { return at(0); };
  EXPECT_FALSE(parting_of(recorded({still}), recorded({still, still})));
  EXPECT_FALSE(parting_of(recorded({still}), recorded({still}, true, 0)));
  Trajectory other = recorded({still});
  other.header["dt"] = 2 * dt;
  EXPECT_FALSE(parting_of(recorded({still}), other));
  const auto shorter = parting_of(recorded({still}), recorded({still}, true, 3));
  ASSERT_TRUE(shorter) << "one that ended early is compared as far as it goes";
}

}  // namespace
}  // namespace plumb::harness
