// Trajectories come back as they were written, within what the format keeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <random>

#include "program.hpp"
#include "record/trajectory.hpp"

namespace plumb::harness::testing {
namespace {

TEST(Trajectory, orientations_come_back) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 10000; ++i) {
    double q[4] = {normal(random), normal(random), normal(random), normal(random)};
    const double n = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const PlumbQuat in{q[0] / n, q[1] / n, q[2] / n, q[3] / n};
    const PlumbQuat out = unpack_orientation(pack_orientation(in));
    const double dot = in.x * out.x + in.y * out.y + in.z * out.z + in.w * out.w;
    EXPECT_GT(std::abs(dot), 1 - 1e-8);
    EXPECT_NEAR(out.x, dot < 0 ? -in.x : in.x, 1e-4);
  }
}

TEST(Trajectory, round_trip_through_a_run) {
  const std::filesystem::path folder = fresh_folder("trajectory");
  const Finished finished =
      plumb({"run", "A1", "--backend", SAMPLE_BACKEND, "--record", "--out", folder.string(), "--json"});
  ASSERT_EQ(finished.rows().size(), 1u) << finished.err;
  const Json row = finished.rows()[0];
  const auto file = folder / "trajectories" / (row["cell"].get<std::string>() + ".plt");
  const Trajectory trajectory = read_trajectory(file);
  EXPECT_EQ(trajectory.header["scene"], "A1");
  EXPECT_EQ(trajectory.header["cell"], row["cell"]);
  EXPECT_EQ(trajectory.outcome["status"], row["status"]);
  EXPECT_EQ(trajectory.outcome["hash"], row["hash"]) << "looking changes nothing";
  EXPECT_TRUE(trajectory.header["recorded"]["without"].contains("contacts")) << "nothing touches: it says so";
  ASSERT_EQ(trajectory.frames.size(), 121u);
  ASSERT_EQ(trajectory.layers.at(0).name, "series");
  const double dt = trajectory.header["dt"];
  const double mass = trajectory.frames[0].layers[0]->get<double>(1, 0) / (9.81 * 100);
  EXPECT_GT(mass, 0);
  for (const TrajectoryFrame& frame : trajectory.frames) {
    const double n = frame.step;
    const double y = 100 - 9.81 * dt * dt * n * (n + 1) / 2;  // semi-implicit Euler
    EXPECT_NEAR(frame.poses.at(0).position.y, y, 1e-5);
    const double speed = 9.81 * dt * n;
    EXPECT_NEAR(frame.layers[0]->get<double>(0, 0), mass * speed * speed / 2, 1e-9 * mass * (1 + speed * speed));
    EXPECT_NEAR(frame.layers[0]->get<double>(1, 0), mass * 9.81 * y, 1e-9 * mass * 1000);
  }
  // A torn end loses its block and nothing else.
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 5);
  EXPECT_TRUE(read_trajectory(file).outcome.is_null());
  std::ofstream(file) << "something else";
  EXPECT_THROW(static_cast<void>(read_trajectory(file)), Error);
  std::ofstream(file) << "PLUMBTR1 and what an older program wrote";
  try {
    static_cast<void>(read_trajectory(file));
    FAIL() << "an older file is refused";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("record the cell again"), std::string::npos) << error.what();
  }
}

/// Where a point of a body's frame is in the world.
std::array<double, 3> world_point(const PoseRow& row, const Json& frame) {
  const auto& [p, q] = row;
  const double x = frame[0], y = frame[1], z = frame[2];
  const double tx = 2 * (q.y * z - q.z * y), ty = 2 * (q.z * x - q.x * z), tz = 2 * (q.x * y - q.y * x);
  return {p.x + x + q.w * tx + q.y * tz - q.z * ty, p.y + y + q.w * ty + q.z * tx - q.x * tz,
          p.z + z + q.w * tz + q.x * ty - q.y * tx};
}

TEST(Trajectory, joints_are_recorded_with_their_anchors_and_gaps) {
  const std::filesystem::path folder = fresh_folder("joints");
  const Finished finished = plumb({"run", "E1", "--param", "L=4", "--param", "motion=hanging", "--seconds", "0.5",
                                   "--record", "--out", folder.string(), "--json"});
  int seen = 0;
  for (const Json& row : finished.rows()) {
    if (row["status"] != "ok" && row["status"] != "failed") continue;
    const auto file = folder / "trajectories" / (row["cell"].get<std::string>() + ".plt");
    const Trajectory trajectory = read_trajectory(file);
    const Json& joints = trajectory.header["joints"];
    ASSERT_EQ(joints.size(), 5u) << "the world, four links, the tip";
    EXPECT_TRUE(joints[0]["body_a"].is_null());
    EXPECT_EQ(trajectory.outcome["metrics"], row["metrics"]);
    const auto layer = static_cast<std::size_t>(std::find_if(trajectory.layers.begin(), trajectory.layers.end(),
                                                             [](const auto& l) { return l.name == "joints"; }) -
                                                trajectory.layers.begin());
    ASSERT_LT(layer, trajectory.layers.size());
    for (std::size_t f = 0; f < trajectory.frames.size(); ++f) {
      const TrajectoryFrame& frame = trajectory.frames[f];
      const auto& rows = frame.layers[layer];
      ASSERT_TRUE(rows && rows->rows == 5);
      for (std::uint32_t j = 0; j < 5; ++j) {
        EXPECT_EQ(rows->get<std::uint32_t>(0, j), j);
        EXPECT_EQ(joints[j]["type"], "ball");
        // Of a chain that hangs at rest anchor j is j metres below the world's.
        const auto b = world_point(frame.poses.at(joints[j]["body_b"].get<std::size_t>()), joints[j]["frame_b"]);
        const PoseRow world{{0, 0, 0}, {0, 0, 0, 1}};
        const PoseRow& body_a =
            joints[j]["body_a"].is_null() ? world : frame.poses.at(joints[j]["body_a"].get<std::size_t>());
        const auto a = world_point(body_a, joints[j]["frame_a"]);
        if (f == 0) {
          EXPECT_NEAR(a[1], -static_cast<double>(j), 1e-8);
          EXPECT_NEAR(b[1], -static_cast<double>(j), 1e-8);
        }
        // Poses are kept as float32 and orientations in 15 bits; the gap is of the poses before that.
        const double apart = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        EXPECT_NEAR(rows->get<float>(1, j), apart, 2e-4) << row["backend"] << " frame " << f << " joint " << j;
      }
    }
    ++seen;
  }
  if (seen == 0) GTEST_SKIP() << "no backend here has ball joints";
}

TEST(Trajectory, what_cannot_run_is_recorded_as_it_would_have_begun) {
  const std::filesystem::path folder = fresh_folder("unsupported");
  const Finished finished =
      plumb({"run", "E1", "--backend", SAMPLE_BACKEND, "--record", "--out", folder.string(), "--json"});
  ASSERT_FALSE(finished.rows().empty()) << finished.err;
  const Json row = finished.rows()[0];
  ASSERT_EQ(row["status"], "unsupported") << "the sample has no joints";
  const Trajectory trajectory = read_trajectory(folder / "trajectories" / (row["cell"].get<std::string>() + ".plt"));
  EXPECT_EQ(trajectory.outcome["status"], "unsupported");
  EXPECT_EQ(trajectory.outcome["reason"], row["reason"]);
  EXPECT_EQ(trajectory.header["bodies"].size(), 11u);
  EXPECT_TRUE(trajectory.frames.empty());
}

TEST(Trajectory, cells_that_are_finished_are_recorded_when_asked_for) {
  const std::filesystem::path folder = fresh_folder("later");
  const std::vector<std::string> run{"run", "A1", "--backend", SAMPLE_BACKEND, "--out", folder.string(), "--json"};
  const Finished measured = plumb(run);
  ASSERT_EQ(measured.rows().size(), 1u) << measured.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "trajectories"));
  std::vector<std::string> record = run;
  record.emplace_back("--record");
  const Finished recorded = plumb(record);
  ASSERT_EQ(recorded.rows().size(), 1u) << recorded.err;
  EXPECT_EQ(recorded.rows()[0], measured.rows()[0]) << "its numbers are those of the first time";
  const auto file = folder / "trajectories" / (measured.rows()[0]["cell"].get<std::string>() + ".plt");
  EXPECT_EQ(read_trajectory(file).outcome["status"], measured.rows()[0]["status"]);
}

TEST(Trajectory, layers_come_back_where_they_were_looked_at) {
  const auto file = fresh_folder("layers") / "made.plt";
  const std::vector<LayerSpec> layers{{"depths", LayerRows::moving, {{"depth", "f32"}}},
                                      {"points", LayerRows::list, {{"at", "f32", 3}, {"id", "u32"}}}};
  const Json header{{"bodies", Json::array({{{"start", {0, 0, 0, 0, 0, 0, 1}}}, {{"start", {1e5, 0, 0, 0, 0, 0, 1}}}})},
                    {"moving", {1}}};
  TrajectoryWriter writer(file, header, layers);
  for (std::uint32_t step = 0; step < 100; ++step) {
    const PoseRow pose{{1e5 + step, 0, 0}, {0, 0, 0, 1}};
    FrameLayers frame(2);
    frame[0].emplace(layers[0]).put(0, static_cast<float>(step));
    if (step % 3 == 0) {
      LayerData& points = frame[1].emplace(layers[1]);
      for (points.rows = 0; points.rows < step % 5; ++points.rows) {
        for (int axis = 0; axis < 3; ++axis) points.put(0, static_cast<float>(step + points.rows));
        points.put(1, points.rows);
      }
    }
    writer.add_frame(step, {&pose, 1}, frame);
  }
  writer.finish();
  end_trajectory(file, {{"status", "ok"}});
  const Trajectory read = read_trajectory(file);
  ASSERT_EQ(read.frames.size(), 100u);
  EXPECT_EQ(read.outcome["status"], "ok");
  for (std::uint32_t step = 0; step < 100; ++step) {
    const TrajectoryFrame& frame = read.frames[step];
    EXPECT_EQ(frame.step, step);
    ASSERT_EQ(frame.poses.size(), 1u) << "of what moves";
    EXPECT_NEAR(frame.poses[0].position.x, 1e5 + step, 1e-6);
    EXPECT_EQ(frame.layers[0]->get<float>(0, 0), static_cast<float>(step));
    ASSERT_EQ(frame.layers[1].has_value(), step % 3 == 0);
    if (!frame.layers[1]) continue;
    ASSERT_EQ(frame.layers[1]->rows, step % 5);
    for (std::uint32_t row = 0; row < step % 5; ++row) {
      EXPECT_EQ(frame.layers[1]->get<float>(0, 3 * row + 2), static_cast<float>(step + row));
      EXPECT_EQ(frame.layers[1]->get<std::uint32_t>(1, row), row);
    }
  }
}

}  // namespace
}  // namespace plumb::harness::testing
