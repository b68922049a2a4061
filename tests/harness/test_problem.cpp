// plumb problem writes what plumb solve reads, and both say what is asked wrongly.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

TEST(Problem, of_four_spheres_is_solved_again) {
  const std::filesystem::path file = fresh_folder("problem") / "d7.hdf5";
  const Finished written = plumb({"problem", "D7", "--param", "mu=0.3", "--out", file.string(), "--json"});
  ASSERT_EQ(written.status, 0) << written.err;
  EXPECT_EQ(written.rows().at(0).at("contacts"), 9);
  EXPECT_EQ(written.rows().at(0).at("converged"), true);
  const Finished solved = plumb({"solve", file.string(), "--json"});
  ASSERT_EQ(solved.status, 0) << solved.err;
  const Json row = solved.rows().at(0);
  EXPECT_LT(row.at("residual").at("natural_map").get<double>(), 1e-10);
  EXPECT_LT(row.at("residual_of_file").get<double>(), 1e-10);
  EXPECT_EQ(row.at("impulse").size(), 9u);
  EXPECT_EQ(row.at("title"), "D7 four-spheres, step 0");
  const Finished text = plumb({"solve", file.string()});
  EXPECT_NE(text.out.find("solved: residual"), std::string::npos) << text.out;
}

TEST(Problem, says_what_is_asked_wrongly) {
  const std::filesystem::path folder = fresh_folder("problem-wrong");
  const auto expect = [&](const std::vector<std::string>& arguments, const std::string& words) {
    const Finished run = plumb(arguments);
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
  };
  const std::string out = (folder / "x.hdf5").string();
  expect({"problem", "A7", "--out", out}, "scene A7 is not worked out: it has joints");
  expect({"problem", "stacking", "--out", out}, "names several scenes");
  expect({"problem", "G2", "--out", out}, "scene G2 has 40000 contacts; at most 2000 are solved");
  expect({"problem", "D7", "--step", "3", "--out", out}, "--step 3 needs a --backend");
  expect({"problem", "D7", "--param", "mu", "--out", out}, "not name=value");
  expect({"problem", "D7", "--out", "/nowhere/x.hdf5"}, "cannot write /nowhere/x.hdf5: No such file");
  expect({"solve", out}, "there is no such file");
  std::ofstream(folder / "text.hdf5") << "no";
  expect({"solve", (folder / "text.hdf5").string()}, "this is no HDF5 file");
}

/// Programs started meanwhile can write no more than this into a file, as on a disk without room.
class LittleRoom {
 public:
  explicit LittleRoom(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &limit_);
    const rlimit little = {bytes, limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &little);
  }
  ~LittleRoom() {
    setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, handler_);
  }
  LittleRoom(const LittleRoom&) = delete;
  LittleRoom& operator=(const LittleRoom&) = delete;

 private:
  void (*handler_)(int);
  rlimit limit_{};
};

TEST(Problem, that_has_no_room_leaves_what_was_there_and_says_so) {
  const std::filesystem::path folder = fresh_folder("problem-room");
  const std::filesystem::path file = folder / "d7.hdf5";
  std::ofstream(file) << "before";
  Finished run;
  {
    const LittleRoom room(1024);
    run = plumb({"problem", "D7", "--out", file.string()});
  }
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("cannot write " + file.string() + ": File too large"), std::string::npos) << run.err;
  EXPECT_EQ(std::filesystem::file_size(file), 6u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()), 1);
}

}  // namespace
}  // namespace plumb::harness::testing
