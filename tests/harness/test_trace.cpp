// plumb run --trace writes what plumb replay can run again, with the same bits.
#include <gtest/gtest.h>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

TEST(Trace, of_a_run_replays_the_same) {
  const std::filesystem::path folder = fresh_folder("trace");
  const Finished run = plumb(
      {"run", particle_scene(folder), "--backend", SAMPLE_BACKEND, "--trace", "--out", (folder / "out").string()});
  ASSERT_EQ(run.status, 0) << run.err;
  std::size_t traces = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "out" / "traces")) {
    const Finished replay = plumb({"replay", entry.path().string(), "--backend", SAMPLE_BACKEND, "--json"});
    EXPECT_EQ(replay.status, 0) << replay.out << replay.err;
    ++traces;
  }
  EXPECT_EQ(traces, 3u) << "one a cell";
}

TEST(Trace, needs_a_folder) {
  const Finished run = plumb({"run", "A1", "--trace"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("--out"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace plumb::harness::testing
