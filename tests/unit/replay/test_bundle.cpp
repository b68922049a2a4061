// A bundle says what its trajectory says, within what it keeps, and stays as small as it is told to.
#include "replay/bundle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "decode.hpp"
#include "replay/badge.hpp"
#include "replay/motion.hpp"

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

/// Angle between two orientations, rad; either may have any norm above 0.
double angle_between(const std::array<double, 4>& a, const PlumbQuat& b) {
  const double norm = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2] + a[3] * a[3]);
  const double dot = (a[0] * b.x + a[1] * b.y + a[2] * b.z + a[3] * b.w) / norm;
  const std::array<double, 3> across{a[3] * b.x - a[0] * b.w - a[1] * b.z + a[2] * b.y,
                                     a[3] * b.y + a[0] * b.z - a[1] * b.w - a[2] * b.x,
                                     a[3] * b.z - a[0] * b.y + a[1] * b.x - a[2] * b.w};
  return 2 * std::atan2(std::hypot(across[0], across[1], across[2]) / norm, std::abs(dot));
}

/// Every pose comes back within what the header states.
void expect_poses_within_bounds(const Bundle& bundle, const Trajectory& trajectory) {
  const auto positions = decoded_positions(bundle.sections.at("positions"));
  const auto orientations = decoded_orientations(bundle.sections.at("orientations"));
  const double most = bundle.header["bounds"]["position"], most_angle = bundle.header["bounds"]["angle"];
  double worst = 0, worst_angle = 0;
  ASSERT_EQ(positions.size(), trajectory.frames.size());
  for (std::size_t f = 0; f < positions.size(); ++f) {
    for (std::size_t body = 0; body < positions[f].size(); ++body) {
      const auto& [p, q] = trajectory.frames[f].poses[body];
      for (const double off : {positions[f][body][0] - p.x, positions[f][body][1] - p.y, positions[f][body][2] - p.z})
        worst = std::max(worst, std::abs(off));
      worst_angle = std::max(worst_angle, angle_between(orientations[f][body], q));
    }
  }
  EXPECT_LE(worst, most * (1 + 1e-9));
  EXPECT_LE(worst_angle, most_angle);
}

TEST(Bundle, SaysWhatTheTrajectorySays) {
  const Trajectory trajectory = made(50, 5);
  const Bundle bundle = unpack(pack(whole_bundle(trajectory)));
  EXPECT_EQ(bundle.header["status"], "failed");
  EXPECT_EQ(bundle.header["reason"], "it fell");
  EXPECT_EQ(bundle.header["badge"], Json({{"verdict", "failed"}, {"words", "it fell"}}));
  EXPECT_EQ(bundle.header["frames"], 50);
  EXPECT_EQ(bundle.sections.at("positions").shape, (std::vector<std::size_t>{50, 2, 3}));
  expect_poses_within_bounds(bundle, trajectory);
  const auto column = [&](const char* name) { return decoded_column(bundle, name); };
  const std::vector<double> times = column("times"), energy = column("series/energy"),
                            energy_drift = column("series/energy_drift"), momentum = column("series/momentum_drift"),
                            deepest = column("series/max_penetration"), count = column("series/contacts"),
                            depth = column("penetration"), start = column("contacts/start"),
                            of_body = column("contacts/body_a"), points = column("contacts/point");
  for (std::size_t f = 0; f < 50; ++f) {
    const auto frame = static_cast<float>(f);
    EXPECT_FLOAT_EQ(static_cast<float>(times[f]), 0.02f * frame);
    EXPECT_EQ(energy[f], 3.0f + frame);
    EXPECT_FLOAT_EQ(static_cast<float>(energy_drift[f]), frame / 52.0f);  // the largest energy
    EXPECT_FLOAT_EQ(static_cast<float>(momentum[f]), frame / 2.0f);
    EXPECT_EQ(deepest[f], std::max(0.25f, frame));
    EXPECT_EQ(count[f], frame);
    EXPECT_EQ(depth[2 * f], 0.25);
    EXPECT_NEAR(depth[2 * f + 1], frame, 1.5e-3 * frame);
    // Contacts of the frame itself or of the one before it.
    const std::size_t looked = f - f % 2;
    ASSERT_EQ(start[f + 1] - start[f], looked % 3);
    for (auto row = static_cast<std::size_t>(start[f]); row < static_cast<std::size_t>(start[f + 1]); ++row) {
      EXPECT_EQ(of_body[row], looked);
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(points[3 * row + axis], static_cast<double>(axis),
                    1.5 * bundle.header["bounds"]["position"].get<double>());
    }
  }
}

/// Bodies of radius 1 that rest, fall, turn evenly, and tumble with changes of the largest component, with noise below
/// what is kept: a replay such as most are.
Trajectory moving_scene(std::size_t frames, std::size_t bodies) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 1e-5);
  Trajectory trajectory;
  trajectory.header = {{"scene", "T2"}, {"dt", 1.0 / 60}, {"shapes", {{{"type", "sphere"}, {"radius", 1.0}}}}};
  for (std::size_t body = 0; body < bodies; ++body) {
    trajectory.moving.push_back(body);
    trajectory.header["bodies"].push_back(
        {{"name", "b" + std::to_string(body)}, {"shape", 0}, {"motion", "dynamic"}, {"start", {0, 0, 0, 0, 0, 0, 1}}});
  }
  trajectory.header["moving"] = trajectory.moving;
  for (std::uint32_t f = 0; f < frames; ++f) {
    TrajectoryFrame frame{f, {}, {}};
    for (std::size_t body = 0; body < bodies; ++body) {
      const double t = f / 60.0, phase = 0.37 * static_cast<double>(body), x = 3 * phase;
      PoseRow row{{x, 1 + noise(random), 0}, {0, 0, 0, 1}};
      const bool falls = t < 1;  // and then rests
      if (body % 4 == 1 && falls) row.position.y = 6 + phase - 4.905 * t * t;
      if (body % 4 == 2) row.orientation = {0, std::sin(2 * t + phase), 0, std::cos(2 * t + phase)};
      if (body % 4 == 3) {
        const double a = 5 * std::sin(t + phase), b = 3 * t + phase;
        row.orientation = {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a) * std::sin(2 * b),
                           std::cos(a) * std::cos(2 * b)};
        if (f % 2 == 1)
          row.orientation = {-row.orientation.x, -row.orientation.y, -row.orientation.z, -row.orientation.w};
      }
      frame.poses.push_back(row);
    }
    trajectory.frames.push_back(std::move(frame));
  }
  return trajectory;
}

TEST(Bundle, PosesComeBackWithinTheStatedBounds) {
  const Trajectory trajectory = moving_scene(600, 40);
  const Bundle bundle = unpack(pack(whole_bundle(trajectory)));
  EXPECT_LE(bundle.header["bounds"]["position"].get<double>(), 1.0 / 511)
      << "of a body's radius, which is drawn in float32";
  EXPECT_EQ(bundle.header["bounds"]["angle"], angle_bound);
  expect_poses_within_bounds(bundle, trajectory);
}

TEST(Bundle, ABodyCostsLittleAFrameAndNextToNothingAtRest) {
  const Trajectory moving = moving_scene(600, 40);
  const double bytes = static_cast<double>(pack(whole_bundle(moving)).size()) / (600 * 40);
  EXPECT_LT(bytes, 1.1) << "packed bytes a body and frame; 18 in the recording";
  RecordProperty("bytes_per_body_frame", std::to_string(bytes));
  Trajectory resting = moving_scene(600, 40);
  for (TrajectoryFrame& frame : resting.frames) frame.poses = resting.frames.front().poses;
  EXPECT_LT(pack(whole_bundle(resting)).size(), pack(whole_bundle(moving)).size() / 4);
  EXPECT_LT(static_cast<double>(pack(whole_bundle(resting)).size()) / (600 * 40), 0.15);
}

TEST(Bundle, JointsKeepTheirGapsAndBrokenOnesGo) {
  const LayerSpec joints{"joints", LayerRows::list, {{"joint", "u32"}, {"gap", "f32"}, {"angle", "f32"}}};
  Trajectory trajectory = moving_scene(50, 4);
  trajectory.header["joints"] = Json::array({{{"name", "first"}}, {{"name", "second"}}});
  trajectory.layers = {joints};
  const auto gap = [](std::size_t f) { return 0.1f / static_cast<float>(f + 1); };
  for (std::size_t f = 0; f < 50; ++f) {
    LayerData& data = trajectory.frames[f].layers.emplace_back().emplace(joints);
    for (std::uint32_t joint = 0; joint < (f < 20 ? 2u : 1u); ++joint, ++data.rows) {
      data.put(0, joint);
      data.put(1, joint == 0 ? NAN : gap(f));
      data.put(2, 0.0f);
    }
    if (f < 20) continue;
    data = LayerData(joints);  // the second alone is left
    data.put(0, 1u);
    data.put(1, gap(f));
    data.put(2, 0.0f);
    data.rows = 1;
  }
  const Bundle bundle = unpack(pack(whole_bundle(trajectory)));
  EXPECT_EQ(bundle.header["joints"][1]["name"], "second");
  const std::vector<double> start = decoded_column(bundle, "joints/start"),
                            number = decoded_column(bundle, "joints/joint"),
                            gaps = decoded_column(bundle, "joints/gap");
  for (std::size_t f = 0; f < 50; ++f) {
    const auto row = static_cast<std::size_t>(start[f]);
    ASSERT_EQ(start[f + 1] - start[f], f < 20 ? 2 : 1);
    if (f < 20) {
      EXPECT_TRUE(std::isnan(gaps[row])) << "a spring alone";
    }
    const std::size_t second = f < 20 ? row + 1 : row;
    EXPECT_EQ(number[second], 1);
    EXPECT_NEAR(gaps[second], gap(f), 1.5e-3 * gap(f));
  }
}

TEST(Badge, SaysTheVerdictAndTheMeasureThatDecidedIt) {
  const auto metric = [](double error, Json threshold, Json gold) {
    Json row{{"value", error},         {"unit", "m"},  {"truth", 0},     {"error", error},
             {"threshold", threshold}, {"gold", gold}, {"pass", nullptr}};
    if (!threshold.is_null()) row["pass"] = error <= threshold.get<double>();
    return row;
  };
  const auto badge = [](const char* status, const char* reason, const Json& metrics) {
    return badge_of({{"status", status}, {"reason", reason}, {"metrics", metrics}});
  };
  const Json gold = badge("ok", "", {{"drift", metric(1e-5, 0.01, 1e-3)}, {"gap", metric(5e-4, 0.05, 1e-3)}});
  EXPECT_EQ(gold["verdict"], "gold");
  EXPECT_EQ(gold["words"], "nearest to its limit: gap 5e-4 of 0.001 for gold");
  const Json pass = badge("ok", "", {{"drift", metric(0.008, 0.01, 1e-3)}, {"gap", metric(5e-4, 0.05, 1e-3)}});
  EXPECT_EQ(pass["verdict"], "pass");
  EXPECT_EQ(pass["words"], "nearest to its limit: drift 0.00800 of 0.01");
  const Json failed = badge("failed", "gap 0.144 > 0.05", {{"gap", metric(0.144, 0.05, 1e-3)}});
  EXPECT_EQ(failed, Json({{"verdict", "failed"}, {"words", "gap 0.144 > 0.05"}}));
  EXPECT_EQ(badge("unsupported", "joints", Json::object())["verdict"], "unsupported");
  EXPECT_EQ(badge("ok", "", {{"ms", metric(1, nullptr, nullptr)}})["verdict"], "ran");
  EXPECT_EQ(badge_of(nullptr)["verdict"], "crashed");
  EXPECT_TRUE(badge_of({{"status", "ok"}, {"reason", ""}}).is_null()) << "an older recording tells no more";
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
  Trajectory trajectory = moving_scene(20, 3);
  trajectory.frames[3].poses[0].position.x = NAN;
  trajectory.frames[7].poses[2].position.y = 1e9;
  const Bundle bundle = unpack(pack(whole_bundle(trajectory)));
  EXPECT_EQ(bundle.sections.at("positions").coding["raw"], Json({0, 2}));
  const auto positions = decoded_positions(bundle.sections.at("positions"));
  EXPECT_TRUE(std::isnan(positions[3][0][0]));
  EXPECT_EQ(positions[7][2][1], 1e9);
  EXPECT_NEAR(positions[5][1][1], trajectory.frames[5].poses[1].position.y,
              bundle.header["bounds"]["position"].get<double>());
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
