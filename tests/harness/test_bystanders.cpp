// The measure that runs a scene with and without bodies that nothing touches.
#include <gtest/gtest.h>

#include <fstream>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

/// Two particles and three far off, which come last or first.
std::string scene_with_bystanders(const std::string& folder, bool last) {
  const std::filesystem::path file = fresh_folder(folder) / "T1-bystanders.json";
  const std::string near =
      R"({ "name": "near{i}", "repeat": { "i": 2 }, "position": ["i", 0, 0], "mass": 1, "flags": ["no_rotation"] })";
  const std::string far =
      R"({ "name": "far{i}", "repeat": { "i": 3 }, "position": ["50 + i", 0, 0], "mass": 1, "flags": ["no_rotation"] })";
  std::ofstream(file) << R"({
  "id": "T1", "slug": "bystanders", "title": "Bystanders", "doc": "Particles fall, and others far away.",
  "needs": [], "dt": 0.01, "seconds": 0.5,
  "bodies": [)" << (last ? near + ", " + far : far + ", " + near)
                      << R"(],
  "measure": { "kind": "bystanders", "bystanders": "far", "size": 2 },
  "metrics": { "same": { "unit": "1", "doc": "d", "threshold": 0 }, "deviation": { "unit": "m", "doc": "d", "threshold": 0 } }
})";
  return file.string();
}

Finished run(const std::string& scene, const std::string& misbehaviour) {
  return plumb({"run", scene, "--backend", MISBEHAVING_BACKEND, "--json", "--set", "misbehaviour=" + misbehaviour});
}

Json row_of(const std::string& scene, const std::string& misbehaviour) {
  const Finished finished = run(scene, misbehaviour);
  const std::vector<Json> rows = finished.rows();
  EXPECT_EQ(rows.size(), 1u) << finished.out << finished.err;
  return rows.empty() ? Json::object() : rows.front();
}

TEST(Bystanders, do_not_matter_to_an_honest_engine) {
  const Json row = row_of(scene_with_bystanders("bystanders_honest", true), "none");
  EXPECT_EQ(row.value("status", ""), "ok") << row.dump();
  EXPECT_EQ(row["metrics"]["same"]["value"], 1);
  EXPECT_EQ(row["metrics"]["deviation"]["value"], 0);
}

TEST(Bystanders, who_matter_are_seen) {
  const Json row = row_of(scene_with_bystanders("bystanders_jostled", true), "jostle");
  EXPECT_EQ(row.value("status", ""), "failed") << row.dump();
  EXPECT_EQ(row["metrics"]["same"]["value"], 0);
  EXPECT_NEAR(row["metrics"]["deviation"]["value"].get<double>(), 0.01 * 3 / 2, 1e-12) << "three more, two a side";
}

TEST(Bystanders, that_are_not_the_last_bodies_are_refused) {
  const Finished finished = run(scene_with_bystanders("bystanders_first", false), "none");
  EXPECT_EQ(finished.status, 2);
  EXPECT_NE(finished.err.find("scene T1: bystanders are the last bodies"), std::string::npos) << finished.err;
}

}  // namespace
}  // namespace plumb::harness::testing
