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
      EXPECT_EQ(finished.status, row.at("outcome") == "failed" ? 1 : 0) << finished.err;
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

}  // namespace
}  // namespace plumb::harness::testing
