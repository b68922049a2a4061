// A bundle says what its trajectory says, within what it keeps, and stays as small as it is told to.
#include "replay/bundle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace plumb::harness {
namespace {

const LayerSpec series{
    "series",
    LayerRows::one,
    {{"kinetic", "f64"}, {"potential", "f64"}, {"momentum", "f64", 3}, {"momenta", "f64"}, {"contacts", "u32"}}};
const LayerSpec depths{"penetration", LayerRows::moving, {{"penetration", "f32"}}};
const LayerSpec contacts{"contacts", LayerRows::list, {{"body_a", "u32"}, {"point", "f32", 3}}};

/// Two bodies turn and move anyhow; contacts are looked at in every second frame.
Trajectory made(std::size_t frames, double reach) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  Trajectory trajectory;
  trajectory.header = {{"scene", "T1"},    {"dt", 0.01},
                       {"moving", {0, 2}}, {"closed", true},
                       {"driven", false},  {"recorded", {{"every", {{"series", 1}, {"contacts", 2}}}}}};
  trajectory.moving = {0, 2};
  trajectory.layers = {series, depths, contacts};
  trajectory.outcome = {{"status", "failed"}, {"reason", "it fell"}};
  for (std::uint32_t f = 0; f < frames; ++f) {
    TrajectoryFrame frame{2 * f, {}, FrameLayers(3)};
    for (int body = 0; body < 2; ++body) {
      const double q[4] = {normal(random), normal(random), normal(random), normal(random)};
      const double n = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
      frame.poses.push_back(
          {{reach * normal(random), 3, reach * normal(random)}, {q[0] / n, q[1] / n, q[2] / n, q[3] / n}});
    }
    LayerData& account = frame.layers[0].emplace(series);
    account.put(0, 1.0 + f);
    account.put(1, 2.0);
    for (const double momentum : {3.0, 4.0 * f, 0.0}) account.put(2, momentum);
    account.put(3, 8.0);
    account.put(4, f);
    LayerData& depth = frame.layers[1].emplace(depths);
    depth.put(0, 0.25f);
    depth.put(0, static_cast<float>(f));
    if (f % 2 == 0) {
      LayerData& points = frame.layers[2].emplace(contacts);
      for (points.rows = 0; points.rows < f % 3; ++points.rows) {
        points.put(0, f);
        for (int axis = 0; axis < 3; ++axis) points.put(1, static_cast<float>(axis));
      }
    }
    trajectory.frames.push_back(std::move(frame));
  }
  return trajectory;
}

template <class Number>
Number at(const Bundle& bundle, const std::string& section, std::size_t index) {
  Number number;
  std::memcpy(&number, bundle.sections.at(section).bytes.data() + index * sizeof number, sizeof number);
  return number;
}

TEST(Bundle, SaysWhatTheTrajectorySays) {
  const Trajectory trajectory = made(50, 5);
  const Bundle bundle = unpack(pack(whole_bundle(trajectory)));
  EXPECT_EQ(bundle.header["status"], "failed");
  EXPECT_EQ(bundle.header["reason"], "it fell");
  EXPECT_EQ(bundle.header["frames"], 50);
  EXPECT_EQ(bundle.sections.at("positions").type, "u16");
  EXPECT_EQ(bundle.sections.at("positions").shape, (std::vector<std::size_t>{50, 2, 3}));
  for (std::size_t f = 0; f < 50; ++f) {
    EXPECT_FLOAT_EQ(at<float>(bundle, "times", f), 0.02f * static_cast<float>(f));
    for (std::size_t body = 0; body < 2; ++body) {
      const PoseRow& pose = trajectory.frames[f].poses[body];
      const double position[3] = {pose.position.x, pose.position.y, pose.position.z};
      const double turn[4] = {pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = bundle.header["lower"][axis], high = bundle.header["upper"][axis];
        const double found =
            low + at<std::uint16_t>(bundle, "positions", (2 * f + body) * 3 + axis) / 65535.0 * (high - low);
        EXPECT_NEAR(found, position[axis], 0.5001 * (high - low) / 65535);
      }
      for (std::size_t part = 0; part < 4; ++part)
        EXPECT_NEAR(at<std::int16_t>(bundle, "orientations", (2 * f + body) * 4 + part) / 32767.0, turn[part], 1.6e-5);
    }
    EXPECT_FLOAT_EQ(at<float>(bundle, "series/energy", f), 3.0f + static_cast<float>(f));
    EXPECT_FLOAT_EQ(at<float>(bundle, "series/energy_drift", f), static_cast<float>(f) / 52.0f);  // the largest energy
    EXPECT_FLOAT_EQ(at<float>(bundle, "series/momentum_drift", f), static_cast<float>(f) / 2.0f);
    EXPECT_FLOAT_EQ(at<float>(bundle, "series/max_penetration", f), std::max(0.25f, static_cast<float>(f)));
    EXPECT_FLOAT_EQ(at<float>(bundle, "series/contacts", f), static_cast<float>(f));
    EXPECT_FLOAT_EQ(at<float>(bundle, "penetration", 2 * f), 0.25f);
    // Contacts of the frame itself or of the one before it.
    const std::uint32_t looked = static_cast<std::uint32_t>(f - f % 2);
    const auto start = at<std::uint32_t>(bundle, "contacts/start", f),
               end = at<std::uint32_t>(bundle, "contacts/start", f + 1);
    ASSERT_EQ(end - start, looked % 3);
    for (std::uint32_t row = start; row < end; ++row) {
      EXPECT_EQ(at<std::uint32_t>(bundle, "contacts/body_a", row), looked);
      EXPECT_EQ(at<float>(bundle, "contacts/point", 3 * row + 2), 2.0f);
    }
  }
}

TEST(Bundle, SectionsLieAtMultiplesOfEight) {
  Bundle bundle;
  bundle.header = {{"kind", "scene"}};
  bundle.sections["a"] = {"u8", {3}, "abc"};
  bundle.sections["b"] = {"f32", {1}, std::string("\0\0\x80\x3f", 4)};
  const Bundle read = unpack(pack(bundle));
  EXPECT_EQ(read.header, bundle.header);
  EXPECT_EQ(read.sections.at("a").bytes, "abc");
  EXPECT_EQ(at<float>(read, "b", 0), 1.0f);
  EXPECT_THROW(static_cast<void>(unpack("nonsense")), Error);
  bundle.sections["b"].shape = {2};
  EXPECT_THROW(static_cast<void>(pack(bundle)), std::logic_error) << "too few bytes for its shape";
}

TEST(Bundle, FarFliersAndNumbersThatAreNoneKeepFloats) {
  Trajectory trajectory = made(20, 1e4);
  EXPECT_EQ(whole_bundle(trajectory).sections.at("positions").type, "f32");
  trajectory = made(20, 1);
  trajectory.frames[3].poses[0].position.x = NAN;
  const Bundle bundle = whole_bundle(trajectory);
  ASSERT_EQ(bundle.sections.at("positions").type, "f32");
  EXPECT_TRUE(std::isnan(at<float>(bundle, "positions", 3 * 6)));
}

TEST(Bundle, StaysBelowItsBound) {
  const Trajectory trajectory = made(4000, 5);
  const std::string whole = bounded_bundle(trajectory, 1 << 30);
  EXPECT_EQ(unpack(whole).header["frames"], 4000);
  const std::string half = bounded_bundle(trajectory, whole.size() * 6 / 10);
  EXPECT_LE(half.size(), whole.size() * 6 / 10);
  const Bundle fewer = unpack(half);
  EXPECT_EQ(fewer.header["frames"], 2001) << "every second and the last";
  EXPECT_TRUE(fewer.sections.contains("contacts/start"));
  EXPECT_NE(fewer.header["note"].get<std::string>().find("2th recorded frame"), std::string::npos);
  const Bundle least = unpack(bounded_bundle(trajectory, 5000));
  EXPECT_FALSE(least.sections.contains("contacts/start"));
  EXPECT_NE(least.header["note"].get<std::string>().find("without contacts"), std::string::npos);
  EXPECT_TRUE(least.sections.contains("positions"));
}

}  // namespace
}  // namespace plumb::harness
