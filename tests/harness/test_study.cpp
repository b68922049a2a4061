// Studies: which cells a file makes, that none is lost or run twice however a study ends, and what a budget leaves.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "program.hpp"
#include "rows/results_folder.hpp"
#include "scene/scene.hpp"
#include "study/study_file.hpp"

namespace plumb::harness::testing {
namespace {

using Rows = std::map<std::string, std::vector<Json>>;  ///< by cell

Rows rows_in(const std::filesystem::path& folder) {
  Rows rows;
  for (const std::filesystem::path& file : results_files(folder)) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
      if (Json row = Json::parse(line, nullptr, false); row.is_object()) rows[row["cell"]].push_back(row);
    }
  }
  return rows;
}

/// What a run must give again, whoever ran it: everything that is measured but times.
Json lasting(const Json& row) {
  return {row["scene"], row["params"], row["backend"], row["settings"], row["dt"],
          row["needs"], row["status"], row["metrics"], row["hash"],     row["repeats"]};
}

void expect_same(const Rows& a, const Rows& b) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [cell, rows] : a) {
    EXPECT_EQ(rows.size(), 1u) << "a cell was run twice: " << rows.front().dump();
    ASSERT_TRUE(b.contains(cell)) << rows.front().dump();
    EXPECT_EQ(b.at(cell).size(), 1u) << "a cell was run twice";
    EXPECT_EQ(lasting(rows.front()), lasting(b.at(cell).front()));
  }
}

/// A study of falling particles, with everything in it that makes cells; a step takes `pause` seconds.
std::string small_study(const std::filesystem::path& folder, double pause, const std::string& more = "") {
  const Json study = Json::parse(R"({"name": "small", "shuffle": 7, "sets": [{
    "scenes": ")" + particle_scene(folder) +
                                 R"(", "params": {"height": [10, 20]}, "along": [{"role": "quality", "type": "int"}],
    "dt": [0.02, 0.005], "needs": ["scene", "scene+rotation"], "settings": {"pause": )" +
                                 std::to_string(pause) + "}" +
                                 (more.find("repetitions") == std::string::npos ? R"(, "repetitions": 2)" : "") + more +
                                 "}]}");
  const std::string file = (folder / "study.json").string();
  std::ofstream(file) << study.dump(2);
  return file;
}

std::vector<std::string> line(const std::filesystem::path& folder, double pause,
                              const std::vector<std::string>& more = {"--fixed"}, const char* out = "out",
                              const std::string& keys = "") {
  std::vector<std::string> arguments{
      "study", small_study(folder, pause, keys), "--backend", MISBEHAVING_BACKEND, "--backend", SAMPLE_BACKEND,
      "--out", (folder / out).string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

template <class Condition>
bool wait_until(const Condition& condition) {
  for (int i = 0; i < 3000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

std::string refusal(const std::string& text) {
  try {
    (void)read_study("some.json", text);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(StudyFiles, presets_are_studies) {
  EXPECT_EQ(study_presets().size(), 4u);
  for (const auto& [name, text] : study_presets()) {
    EXPECT_EQ(read_study(name, text).name, name);
    const Finished printed = plumb({"study", name, "--print"});
    EXPECT_EQ(printed.out, text);
  }
  EXPECT_EQ(find_study("quick").budget, 300.0);
}

TEST(StudyFiles, schema_and_reader_know_the_same_keys) {
  std::ifstream file(STUDY_SCHEMA);
  const auto schema = nlohmann::json::parse(file);
  for (const auto& [name, keys] : study_keys()) {
    const auto& properties =
        name.empty() ? schema.at("properties") : schema.at("definitions").at(name).at("properties");
    std::set<std::string> in_schema;
    for (const auto& [key, ignored] : properties.items()) in_schema.insert(key);
    EXPECT_EQ(in_schema, std::set<std::string>(keys.begin(), keys.end())) << "definition " << name;
  }
}

TEST(StudyFiles, errors_name_the_line_and_the_remedy) {
  EXPECT_EQ(refusal("{\"name\": \"x\",\n\"sets\": [{\"scenes\": \"A1\",\n\"repetitons\": 3}]}"),
            "some.json:3: sets[0]: unknown key \"repetitons\"; did you mean \"repetitions\"?");
  EXPECT_EQ(
      refusal("{\"name\": \"x\",\n\"sets\": [{\"scenes\": \"A1\",\n\"needs\": \"scene+sleping\"}]}"),
      "some.json:3: sets[0].needs: needs scene+sleping: there is no need \"sleping\"; did you mean \"sleeping\"?");
  EXPECT_EQ(refusal("{\"name\": \"x\",\n\"budget\": \"5 mins\", \"sets\": [{\"scenes\": \"A1\"}]}"),
            "some.json:2: budget: budget 5 mins: a time is a number above 0 and s, min or h: 90s, 20min, 2h");
  EXPECT_NE(refusal("{\"name\": \"x\", \"sets\": [{\"scenes\": \"A1\", \"dt\": 0}]}").find("above 0"),
            std::string::npos);
  EXPECT_NE(refusal("{\"name\": \"x\", \"sets\": [{\"scenes\": \"A1\", \"along\": {\"role\": \"qualty\"}}]}")
                .find("did you mean \"quality\"?"),
            std::string::npos);
}

TEST(StudyFiles, the_program_refuses_what_its_backends_and_scenes_do_not_have) {
  const Finished preset = plumb({"study", "qick"});
  EXPECT_EQ(preset.status, 2);
  EXPECT_NE(preset.err.find("did you mean \"quick\"?"), std::string::npos) << preset.err;
  const std::filesystem::path folder = fresh_folder("refused");
  const auto with = [&](const std::string& keys) { return plumb(line(folder, 0, {}, "out", keys)).err; };
  EXPECT_NE(with(R"(, "over": "misbehavior")").find("did you mean \"misbehaviour\"?"), std::string::npos);
  EXPECT_NE(with(R"(, "backends": "sampel")").find("did you mean \"sample\"?"), std::string::npos);
  EXPECT_EQ(with(R"(, "over": {"name": "wings", "optional": true}, "repetitions": 1)"
                 R"(, "seconds": 0.02)")
                .find("wings"),
            std::string::npos);
}

TEST(Studies, fixed_ones_have_the_cells_that_the_dry_run_names) {
  const std::filesystem::path folder = fresh_folder("fixed");
  const Finished dry = plumb(line(folder, 0, {"--fixed", "--dry-run"}));
  ASSERT_EQ(dry.status, 0) << dry.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  const Finished finished = plumb(line(folder, 0));
  ASSERT_EQ(finished.status, 0) << finished.err;
  const Rows rows = rows_in(folder / "out");
  std::size_t rungs = 0, steps = 0, needs = 0;
  for (const auto& [cell, same] : rows) {
    EXPECT_NE(dry.out.find(cell), std::string::npos);
    ASSERT_EQ(same.size(), 1u);
    const Json& row = same.front();
    EXPECT_EQ(row["study"], "small");
    EXPECT_EQ(row["repeats"], row["status"] == "ok" ? 2 : 1) << row.dump();
    EXPECT_TRUE(row.contains("contended"));
    EXPECT_EQ(row["time"]["runs"].empty(), row["status"] != "ok");
    if (row["settings"].value("substeps", 1) != 1 || row["settings"].value("iterations", 10) != 10) ++rungs;
    if (row["dt"] != 0.01) ++steps;
    if (row["needs"] == "scene+rotation") ++needs;
  }
  EXPECT_EQ(rungs, 2 * 12u) << "five rungs of a knob, one of them the base; two knobs and one, two bases of each";
  EXPECT_EQ(steps, 2 * 2 * 2u);
  EXPECT_EQ(needs, 2 * 2u);
  EXPECT_EQ(rows.size(), 2 * 2u + rungs + steps + needs);
  const Json record = Json::parse(std::ifstream(folder / "out" / "study.json"));
  EXPECT_EQ(record["name"], "small");
  EXPECT_EQ(record["study"]["shuffle"], 7);
  EXPECT_TRUE(record["command"].get<std::string>().starts_with("plumb study "));
}

TEST(Studies, killed_ones_go_on_and_end_as_if_nothing_had_been) {
  const std::filesystem::path folder = fresh_folder("killed");
  ASSERT_EQ(plumb(line(folder, 0.002, {"--fixed"}, "whole")).status, 0);
  const Rows whole = rows_in(folder / "whole");
  std::srand(static_cast<unsigned>(getpid()));
  for (int kills = 0; kills < 3; ++kills) {
    const std::size_t before = rows_in(folder / "out").size();
    const std::size_t until = before + static_cast<std::size_t>(1 + std::rand() % 6);
    const pid_t pid = start_plumb(line(folder, 0.002));
    ASSERT_TRUE(wait_until([&] { return rows_in(folder / "out").size() >= std::min(until, whole.size()); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(std::rand() % 150));
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
  }
  EXPECT_LT(rows_in(folder / "out").size(), whole.size());
  ASSERT_EQ(plumb(line(folder, 0.002)).status, 0);
  expect_same(rows_in(folder / "out"), whole);
  const Finished again = plumb(line(folder, 0.002));
  EXPECT_NE(again.err.find("0 cells run, " + std::to_string(whole.size()) + " finished already"), std::string::npos)
      << again.err;
}

Environment as_rank(int rank, int size) {
  return {{"OMPI_COMM_WORLD_RANK", std::to_string(rank)},
          {"OMPI_COMM_WORLD_SIZE", std::to_string(size)},
          {"OMPI_COMM_WORLD_LOCAL_SIZE", std::to_string(size)}};
}

TEST(Studies, ranks_share_the_cells_and_take_over_from_a_dead_one) {
  const std::filesystem::path folder = fresh_folder("ranks");
  ASSERT_EQ(plumb(line(folder, 0.002, {"--fixed"}, "alone")).status, 0);
  const Rows alone = rows_in(folder / "alone");
  std::vector<pid_t> ranks;
  const std::vector<std::string> arguments = line(folder, 0.002);
  for (int rank = 0; rank < 4; ++rank) ranks.push_back(start_plumb(arguments, as_rank(rank, 4)));
  EXPECT_TRUE(wait_until([&] { return rows_in(folder / "out").size() >= 4; }));
  kill(ranks[2], SIGKILL);
  for (const pid_t rank : ranks) waitpid(rank, nullptr, 0);
  EXPECT_GT(results_files(folder / "out").size(), 1u) << "each has a file of its own";
  std::size_t contended = 0;
  for (const auto& [cell, rows] : rows_in(folder / "out")) contended += rows.front()["contended"].is_null() ? 0 : 1;
  if (std::thread::hardware_concurrency() < 4) {
    EXPECT_GT(contended, 0u) << "four at once on fewer cores";
  }
  ASSERT_EQ(plumb(arguments, as_rank(0, 4)).status, 0) << "what the dead one had is free again";
  expect_same(rows_in(folder / "out"), alone);
  EXPECT_EQ(plumb({"report", (folder / "out").string(), "--json"}).rows().size(), alone.size());
}

TEST(Studies, four_ranks_of_mpirun_are_as_one) {
  if (std::system("mpirun --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no mpirun";
  const std::filesystem::path folder = fresh_folder("mpirun");
  ASSERT_EQ(plumb(line(folder, 0.002, {"--fixed"}, "alone")).status, 0);
  std::string command = "mpirun --allow-run-as-root --oversubscribe -n 4 " PLUMB_PROGRAM;
  for (const std::string& word : line(folder, 0.002)) command += " '" + word + "'";
  const auto rows = [&] { return rows_in(folder / "out"); };
  // One of the four is killed, which may end the others.
  const std::string kill_one = command +
                               " >/dev/null 2>&1 & job=$!; for i in $(seq 3000); do sleep 0.01; "
                               "[ -s '" +
                               (folder / "out" / "results-3.jsonl").string() +
                               "' ] && break; done; "
                               "kill -9 $(pgrep -P $job | tail -n 1); wait $job";
  (void)std::system(kill_one.c_str());
  EXPECT_FALSE(rows().empty());
  EXPECT_EQ(std::system((command + " >/dev/null 2>&1").c_str()), 0);
  expect_same(rows(), rows_in(folder / "alone"));
}

TEST(Studies, a_budget_ends_them_in_good_order) {
  const std::filesystem::path folder = fresh_folder("budget");
  const auto start = std::chrono::steady_clock::now();
  const Finished finished = plumb(line(folder, 0.01, {"--budget", "4s"}));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  ASSERT_EQ(finished.status, 0) << finished.err;
  EXPECT_LT(took.count(), 12) << "4 s and the start of two workers on a busy machine";
  EXPECT_NE(finished.err.find("left out by the budget"), std::string::npos) << finished.err;
  for (const auto& [cell, rows] : rows_in(folder / "out")) EXPECT_EQ(rows.size(), 1u);
  const Finished bad = plumb(line(folder, 0, {"--budget", "soon"}));
  EXPECT_EQ(bad.status, 2);
}

TEST(Studies, adaptive_ones_leave_out_idle_knobs) {
  const std::filesystem::path folder = fresh_folder("adaptive");
  const Finished finished = plumb(line(folder, 0, {}, "out", R"(, "repetitions": {"at_least": 2, "at_most": 4})"));
  ASSERT_EQ(finished.status, 0) << finished.err;
  std::set<int> iterations;
  for (const auto& [cell, rows] : rows_in(folder / "out")) {
    ASSERT_EQ(rows.size(), 1u);
    const Json& row = rows.front();
    if (row["settings"].contains("iterations")) iterations.insert(row["settings"]["iterations"].get<int>());
    if (row["status"] != "ok") continue;
    EXPECT_GE(row["repeats"], 2);
    EXPECT_LE(row["repeats"], 4);
    if (row["time"]["runs"].size() < 2) continue;  // the others met a busy machine
    ASSERT_EQ(row["time"]["ci95"].size(), 2u) << row.dump();
    EXPECT_LE(row["time"]["ci95"][0], row["time"]["ci95"][1]);
  }
  EXPECT_EQ(iterations, (std::set<int>{2, 10})) << "the base and the probe of a knob that does nothing";
  EXPECT_NE(finished.err.find("whose knob does nothing there"), std::string::npos) << finished.err;
}

TEST(Studies, adaptive_ones_put_points_where_an_error_level_is_crossed) {
  const std::filesystem::path folder = fresh_folder("refined");
  const std::string file = (folder / "study.json").string();
  std::ofstream(file) << R"({"name": "fall", "sets": {"scenes": "A1", "along": "substeps"}})";
  const std::vector<std::string> arguments{
      "study", file, "--backend", MISBEHAVING_BACKEND, "--out", (folder / "out").string()};
  ASSERT_EQ(plumb(arguments).status, 0);
  std::set<int> substeps;
  for (const auto& [cell, rows] : rows_in(folder / "out"))
    substeps.insert(rows.front()["settings"]["substeps"].get<int>());
  // The error is 1/120 over the substeps: 0.1 % lies between 8 and 16, then between 8 and 11.
  EXPECT_EQ(substeps, (std::set<int>{1, 2, 4, 8, 9, 11, 16}));
  const std::size_t cells = rows_in(folder / "out").size();
  EXPECT_EQ(plumb(arguments).status, 0);
  EXPECT_EQ(rows_in(folder / "out").size(), cells) << "the second start finds the same points";
}

}  // namespace
}  // namespace plumb::harness::testing
