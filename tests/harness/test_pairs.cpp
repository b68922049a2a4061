// What the referee says of pairs of shapes on their way, and what becomes of backends that cannot.
#include <gtest/gtest.h>

#include <cmath>

#include "program.hpp"
#include "record/pair_tour.hpp"
#include "record/trajectory.hpp"

namespace plumb::harness::testing {
namespace {

TEST(Pairs, the_referee_sees_every_pair_touch_and_part) {
  const std::filesystem::path folder = fresh_folder("pairs");
  const std::vector<PairTour> tours = all_pair_tours();
  EXPECT_EQ(tours.size(), 39u) << "six kinds that move among each other and on three that do not";
  for (const PairTour& tour : tours) {
    const std::string file = (folder / (tour.name + ".plt")).string();
    record_pair_of_referee(tour, file);
    const Trajectory read = read_trajectory(file);
    EXPECT_EQ(read.header["kind"], "pairs");
    ASSERT_EQ(read.layers[0].columns[1].name, "true_distance");
    ASSERT_EQ(read.frames.size(), tour.poses.size());
    int apart = 0, overlapping = 0;
    for (const TrajectoryFrame& frame : read.frames) {
      const float distance = frame.layers[0]->get<float>(1, 0);
      ASSERT_TRUE(std::isfinite(distance)) << tour.name;
      ++(distance > 0 ? apart : overlapping);
      EXPECT_EQ(frame.layers[2]->rows, distance > 0 ? 0u : 1u) << tour.name;
      EXPECT_EQ(frame.layers[3]->rows, 1u) << "an axis always";
    }
    EXPECT_GT(apart, 30) << tour.name;
    EXPECT_GT(overlapping, 30) << tour.name;
  }
}

TEST(Pairs, what_a_backend_lacks_is_said_and_left_out) {
  const std::filesystem::path folder = fresh_folder("pairs_verb");
  const Finished finished =
      plumb({"pairs", SAMPLE_BACKEND, "--pair", "sphere-sphere", "--pair", "plane-box", "--out", folder.string()});
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_NE(finished.out.find("plane-box: unsupported: "), std::string::npos) << finished.out;
  EXPECT_NE(finished.out.find("0 of 2 pairs"), std::string::npos) << finished.out;
  EXPECT_TRUE(std::filesystem::exists(folder / "trajectories" / "pair-plane-box-referee.plt"));
  const std::string page = (folder / "page.html").string();
  EXPECT_EQ(plumb({"report", folder.string(), "--html", page}).status, 0) << "recordings need no rows beside them";
  EXPECT_EQ(plumb({"report", folder.string()}).status, 2) << "but a table does";
  const Finished reversed = plumb({"pairs", SAMPLE_BACKEND, "--pair", "box-plane", "--out", folder.string()});
  EXPECT_NE(reversed.out.find("plane-box: unsupported: "), std::string::npos) << reversed.out << reversed.err;
  const Finished misspelt = plumb({"pairs", SAMPLE_BACKEND, "--pair", "box-plain", "--out", folder.string()});
  EXPECT_EQ(misspelt.status, 2);
  EXPECT_NE(misspelt.err.find("box-plain"), std::string::npos) << misspelt.err;
}

}  // namespace
}  // namespace plumb::harness::testing
