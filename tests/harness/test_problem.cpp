// plumb problem writes what plumb solve reads, and both say what is asked wrongly.
#include <gtest/gtest.h>

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
  expect({"problem", "D7", "--step", "3", "--out", out}, "--step 3 needs a --backend");
  expect({"problem", "D7", "--param", "mu", "--out", out}, "not name=value");
  expect({"problem", "D7", "--out", "/nowhere/x.hdf5"}, "cannot write /nowhere/x.hdf5: No such file");
  expect({"solve", out}, "there is no such file");
  std::ofstream(folder / "text.hdf5") << "no";
  expect({"solve", (folder / "text.hdf5").string()}, "this is no HDF5 file");
}

}  // namespace
}  // namespace plumb::harness::testing
