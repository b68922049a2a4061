// Files of contact problems: what is written comes back, every layout is read, and broken files are named.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "problems.hpp"
#include "reference/fclib.hpp"
#include "reference/hdf5_file.hpp"
#include "reference/solver.hpp"

namespace plumb::reference {
namespace {

using Eigen::VectorXd;

std::filesystem::path file_named(const std::string& name) {
  return std::filesystem::path(::testing::TempDir()) / ("plumb-" + name + ".hdf5");
}

std::filesystem::path written(const std::string& name, const std::string& bytes) {
  std::ofstream(file_named(name), std::ios::binary) << bytes;
  return file_named(name);
}

std::string bytes_with(const std::string& path) {
  Hdf5File file = Hdf5File::in_memory();
  file.put(path, 1);
  return file.bytes();
}

TEST(Fclib, WhatIsWrittenComesBack) {
  std::mt19937 random(4);
  FclibProblem given;
  given.problem = random_problem(random, 4, 9, 0.4).problem();
  given.title = "nine contacts";
  given.description = "of four bodies";
  given.impulse = solve(given.problem).impulse;
  const FclibProblem read = read_fclib(written("same", fclib_bytes(given)));
  EXPECT_EQ(read.problem.w, given.problem.w);
  EXPECT_EQ(read.problem.q, given.problem.q);
  EXPECT_EQ(read.problem.mu, given.problem.mu);
  EXPECT_EQ(read.title, given.title);
  EXPECT_EQ(read.description, given.description);
  ASSERT_TRUE(read.impulse.has_value());
  EXPECT_EQ(*read.impulse, *given.impulse);
  EXPECT_LT(residual(read.problem, *read.impulse).natural_map, 1e-10);
}

/// The file of one cube on the ground, each part of which a test may leave out or change.
struct Parts {
  int spacedim = 2, m = 4, n = 4, nz = 6;
  std::vector<int> p{0, 0, 1, 1, 2, 3}, i{0, 1, 0, 1, 2, 3};
  std::vector<double> x{2, 1, 1, 2, 2, 2}, q{-1, 0.25, -1, 3}, mu{0.5, 0.25};
  std::string without;
  std::function<void(Hdf5File&)> more;

  std::filesystem::path write(const std::string& name) const {
    Hdf5File file = Hdf5File::in_memory();
    const auto put = [&](const std::string& path, const auto& value) {
      if (path != without) file.put("/fclib_local/" + path, value);
    };
    put("spacedim", spacedim);
    put("W/m", m);
    put("W/n", n);
    put("W/nz", nz);
    put("W/nzmax", static_cast<int>(x.size()));
    put("W/p", p);
    put("W/i", i);
    put("W/x", x);
    put("vectors/q", q);
    put("vectors/mu", mu);
    if (more) more(file);
    return written(name, file.bytes());
  }
};

Eigen::MatrixXd plane_part(const FclibProblem& read) {
  Eigen::MatrixXd w(4, 4);
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) w.block<2, 2>(2 * a, 2 * b) = read.problem.w.block<2, 2>(3 * a, 3 * b);
  return w;
}

TEST(Fclib, EveryLayoutIsRead) {
  Eigen::MatrixXd expected = Eigen::Vector4d(2, 2, 2, 2).asDiagonal();
  expected(0, 1) = expected(1, 0) = 1;
  const FclibProblem triplets = read_fclib(Parts().write("triplets"));
  EXPECT_EQ(plane_part(triplets), expected);
  Parts lines;
  lines.p = {0, 2, 4, 5, 6};
  lines.i = {0, 1, 0, 1, 2, 3};
  for (const int by : {-1, -2}) {
    lines.nz = by;
    EXPECT_EQ(plane_part(read_fclib(lines.write("lines"))), expected) << by;
  }
  // The plane's second contact slides: r = (1/2, -mu/2).
  const Solution solution = solve(triplets.problem);
  ASSERT_TRUE(solution.converged);
  EXPECT_LT((solution.impulse.tail<3>() - Eigen::Vector3d(0.5, -0.125, 0)).norm(), 1e-10);
}

TEST(Fclib, EquationsAreSolvedFor) {
  // V' r + R l + s = 0 with one l that both normals feel: W_nn - 1/R, q_n - s/R.
  Parts parts;
  parts.more = [](Hdf5File& file) {
    for (const auto& [name, value] :
         {std::pair{"V/m", 4}, {"V/n", 1}, {"V/nz", 2}, {"R/m", 1}, {"R/n", 1}, {"R/nz", 1}})
      file.put(std::string("/fclib_local/") + name, value);
    file.put("/fclib_local/V/p", std::vector<int>{0, 2});
    file.put("/fclib_local/V/i", std::vector<int>{0, 0});
    file.put("/fclib_local/V/x", std::vector<double>{1, 1});
    file.put("/fclib_local/R/p", std::vector<int>{0});
    file.put("/fclib_local/R/i", std::vector<int>{0});
    file.put("/fclib_local/R/x", std::vector<double>{4});
    file.put("/fclib_local/vectors/s", std::vector<double>{2});
  };
  const FclibProblem read = read_fclib(parts.write("equations"));
  EXPECT_EQ(read.problem.w(0, 0), 1.75);
  EXPECT_EQ(read.problem.w(0, 3), -0.25);
  EXPECT_EQ(read.problem.q[3], -1.5);
}

TEST(Fclib, BrokenFilesAreNamed) {
  const auto text_of = [](const std::filesystem::path& path) -> std::string {
    try {
      static_cast<void>(read_fclib(path));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no failure";
  };
  const auto expect = [&](const std::filesystem::path& path, const std::string& words) {
    EXPECT_EQ(text_of(path), path.string() + ": " + words);
  };
  expect("/nowhere/at/all.hdf5", "there is no such file");
  std::ofstream(file_named("text")) << "W, q, mu\n";
  expect(file_named("text"), "this is no HDF5 file");
  expect(written("empty", bytes_with("/other")), "group /fclib_local is missing: this is no problem of FCLIB's");
  expect(written("global", bytes_with("/fclib_global/spacedim")),
         "it holds a global problem (/fclib_global), and only local ones are solved");
  const auto broken = [&](const std::function<void(Parts&)>& breaks, const std::string& words) {
    Parts parts;
    breaks(parts);
    expect(parts.write("broken"), words);
  };
  broken([](Parts& p) { p.without = "vectors/mu"; }, "/fclib_local/vectors/mu is missing");
  broken([](Parts& p) { p.without = "W/x"; }, "/fclib_local/W/x is missing");
  broken([](Parts& p) { p.spacedim = 4; }, "/fclib_local/spacedim is 4, not 2 or 3");
  broken([](Parts& p) { p.m = 5; }, "/fclib_local/W is of 5 rows and 4 columns, not of as many, a multiple of 2");
  broken([](Parts& p) { p.x.pop_back(); }, "/fclib_local/W/x holds 5 numbers, but m, n, nz and p ask for 6");
  broken([](Parts& p) { p.q.pop_back(); }, "/fclib_local/vectors/q holds 3 numbers, but the matrices ask for 4");
  broken([](Parts& p) { p.i[2] = 4; },
         "/fclib_local/W has an entry at row 1, column 4, but is of 4 rows and 4 columns");
  broken([](Parts& p) { p.nz = -3; }, "/fclib_local/W/nz is -3: known are -1 (by columns), -2 (by rows), and counts");
  broken([](Parts& p) { p.m = p.n = 1 << 20; },
         "/fclib_local/W is of 1048576 rows and 1048576 columns; this solver takes at most 2000 contacts");
  broken([](Parts& p) { p.x[1] = 7; }, "W is not symmetric");
  broken([](Parts& p) { p.mu[0] = -0.5; }, "a coefficient of friction is -0.500000, which is below 0");
}

}  // namespace
}  // namespace plumb::reference
