// Trajectories come back as they were written, within what the format keeps.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include "program.hpp"
#include "run/trajectory.hpp"

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
  const auto file = folder / "trajectories" / (finished.rows()[0]["cell"].get<std::string>() + ".plt");
  const Trajectory trajectory = read_trajectory(file);
  EXPECT_EQ(trajectory.header["scene"], "A1");
  ASSERT_EQ(trajectory.frames.size(), 121u);
  const double dt = trajectory.header["dt"];
  for (const TrajectoryFrame& frame : trajectory.frames) {
    const double n = frame.step;
    const double y = 100 - 9.81 * dt * dt * n * (n + 1) / 2;  // semi-implicit Euler
    EXPECT_NEAR(frame.poses.at(0).position.y, y, 1e-5);
  }
  // A torn end loses its block and nothing else.
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 5);
  EXPECT_EQ(read_trajectory(file).frames.size(), 64u);
  std::ofstream(file) << "something else";
  EXPECT_THROW(static_cast<void>(read_trajectory(file)), Error);
}

}  // namespace
}  // namespace plumb::harness::testing
