// plumb worlds: a scene in many worlds at once, and what becomes of it where a backend goes wrong.
#include <gtest/gtest.h>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

std::vector<std::string> asked_of(const std::string& backend, const std::string& folder,
                                  const std::vector<std::string>& more) {
  std::vector<std::string> words{
      "worlds", particle_scene(fresh_folder(folder)), "--backend", backend, "--param", "height=50", "--json"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(ManyWorlds, each_ends_as_one_alone) {
  const Finished finished =
      plumb(asked_of(SAMPLE_BACKEND, "many_worlds", {"--count", "1", "--count", "9", "--over", "3"}));
  EXPECT_EQ(finished.status, 0) << finished.err;
  const std::vector<Json> rows = finished.rows();
  ASSERT_EQ(rows.size(), 2u) << finished.out;
  const Json alone = plumb({"run", particle_scene(fresh_folder("many_worlds_alone")), "--backend", SAMPLE_BACKEND,
                            "--param", "height=50", "--json"})
                         .rows()
                         .at(0);
  for (const Json& row : rows) {
    EXPECT_EQ(row.at("status"), "ok") << row.dump();
    EXPECT_EQ(row.at("differ"), 0);
    EXPECT_EQ(row.at("over"), 3);
    EXPECT_EQ(row.at("hash"), alone.at("hash"));
    EXPECT_EQ(row.at("steps"), alone.at("time").at("steps"));
    const double each = row.at("us_per_world_step"), all = row.at("step_ms"), count = row.at("count");
    EXPECT_NEAR(each * count, 1e3 * all, 1e-6 * each * count);
  }
}

TEST(ManyWorlds, are_a_table_for_people) {
  std::vector<std::string> words = asked_of(SAMPLE_BACKEND, "many_worlds_table", {"--count", "2"});
  std::erase(words, "--json");
  const Finished finished = plumb(words);
  EXPECT_NE(finished.out.find("us a world"), std::string::npos) << finished.out;
  EXPECT_NE(finished.out.find(" all\n"), std::string::npos) << finished.out;
}

TEST(ManyWorlds, a_world_that_differs_is_counted) {
  const Finished finished =
      plumb(asked_of(MISBEHAVING_BACKEND, "many_worlds_differ", {"--count", "4", "--set", "misbehaviour=disturb"}));
  ASSERT_EQ(finished.rows().size(), 1u) << finished.err;
  EXPECT_EQ(finished.rows()[0].at("differ"), 4) << finished.out;
}

TEST(ManyWorlds, a_crash_is_a_row_and_the_next_count_is_asked) {
  const Finished finished = plumb(asked_of(MISBEHAVING_BACKEND, "many_worlds_crash",
                                           {"--count", "2", "--count", "3", "--set", "misbehaviour=segfault"}));
  EXPECT_EQ(finished.status, 1) << finished.err;
  const std::vector<Json> rows = finished.rows();
  ASSERT_EQ(rows.size(), 2u) << finished.out << finished.err;
  for (const Json& row : rows) {
    EXPECT_EQ(row.at("status"), "crashed") << row.dump();
    EXPECT_NE(row.at("reason").get<std::string>().find("SIGSEGV"), std::string::npos) << row.dump();
  }
}

}  // namespace
}  // namespace plumb::harness::testing
