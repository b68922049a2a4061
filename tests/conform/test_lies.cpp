// Conformance notices lies: each check fails on a backend that is honest but for the one thing that the check is about.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "../harness/program.hpp"
#include "conform/conformance.hpp"

namespace plumb::harness::testing {
namespace {

struct Lie {
  const char *word, *check;
};
constexpr Lie lies[] = {
#define PLUMB_LIE(word, check) {#word, check},
#include "lies.inl"
#undef PLUMB_LIE
};

/// The check's row on the backend in `file` as the liar tells it.
Json told_about(const std::string& file, const Lie& lie) {
  const Finished finished = plumb({"conform", LYING_BACKEND, "--check", lie.check, "--json"},
                                  {{"PLUMB_HONEST", file}, {"PLUMB_LIE", lie.word}});
  for (const Json& row : finished.rows())
    if (row.at("check") == lie.check) {
      EXPECT_EQ(finished.status, row.at("outcome") == "passed" ? 0 : 1) << finished.err;
      return row;
    }
  ADD_FAILURE() << finished.out << finished.err;
  return {{"outcome", "none"}};
}

class Lies : public ::testing::TestWithParam<Lie> {};

TEST_P(Lies, AreNoticed) {
  std::istringstream files(HONEST_BACKENDS);
  for (std::string file; std::getline(files, file, ':');) {
    const Json row = told_about(file, GetParam());
    if (row.at("outcome") == "skipped") continue;  // this one lacks what the lie is about: ask the next
    EXPECT_EQ(row.at("outcome"), "failed") << GetParam().check << " believes " << file;
    return;
  }
  GTEST_SKIP() << "no backend of this build has what " << GetParam().check << " is about";
}

INSTANTIATE_TEST_SUITE_P(Conformance, Lies, ::testing::ValuesIn(lies),
                         [](const auto& lie) { return std::string(lie.param.word); });

TEST(Lies, AreToldAboutEveryCheck) {
  for (const conform::Check& check : conform::all_checks())
    EXPECT_TRUE(std::any_of(std::begin(lies), std::end(lies),
                            [&](const Lie& lie) { return std::string(lie.check) == check.name; }))
        << "no lie makes " << check.name << " fail";
}

/// A backend of few claims is tested in those: the sample has particles under gravity and no more.
class LiesOfFewClaims : public ::testing::TestWithParam<const char*> {};

TEST_P(LiesOfFewClaims, AreNoticed) {
  const Finished finished =
      plumb({"conform", LYING_BACKEND}, {{"PLUMB_HONEST", SAMPLE_BACKEND}, {"PLUMB_LIE", GetParam()}});
  EXPECT_EQ(finished.status, 1) << finished.out << finished.err;
}

INSTANTIATE_TEST_SUITE_P(Conformance, LiesOfFewClaims,
                         ::testing::Values("gravity_one_per_mille_too_strong", "gravity_pulls_along_y_alone",
                                           "steps_one_per_mille_too_long", "gravity_scale_one_percent_off",
                                           "velocities_fade", "positions_a_tenth_of_a_millimetre_off",
                                           "stale_handles_are_read", "bodies_listed_backwards", "bad_gravity_is_done",
                                           "steps_are_not_counted", "hash_is_constant"),
                         [](const auto& lie) { return std::string(lie.param); });

TEST(Untested, IsSaidFirstAndInTheLastLine) {
  const Finished finished = plumb({"conform", SAMPLE_BACKEND});
  EXPECT_EQ(finished.status, 0) << finished.out << finished.err;
  std::istringstream lines(finished.out);
  std::string first, line, last;
  std::getline(lines, first);
  while (std::getline(lines, line)) last = line;
  EXPECT_NE(first.find("NOT TESTED"), std::string::npos) << first;
  EXPECT_NE(last.find("NOT TESTED, "), std::string::npos) << last;
  EXPECT_NE(last.find(" passed, 0 failed"), std::string::npos) << last;
}

TEST(Untested, AloneIsNoSuccess) {
  const Finished finished = plumb({"conform", SAMPLE_BACKEND, "--check", "joints"});
  EXPECT_EQ(finished.status, 1) << finished.out;
}

}  // namespace
}  // namespace plumb::harness::testing
