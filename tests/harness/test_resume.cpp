// A study that was killed, its workers too, goes on where it was and loses nothing.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <zstd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <set>
#include <thread>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

std::vector<Json> readable_rows(const std::filesystem::path& file) {
  std::vector<Json> rows;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (Json row = Json::parse(line, nullptr, false); row.is_object()) rows.push_back(std::move(row));
  }
  return rows;
}

// The program's children.
std::vector<pid_t> workers_of(pid_t parent) {
  std::vector<pid_t> workers;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream stat(entry.path() / "stat");
    std::string text((std::istreambuf_iterator<char>(stat)), {});
    const auto end = text.rfind(')');
    if (end == std::string::npos) continue;
    char state = 0;
    int ppid = 0;
    if (std::sscanf(text.c_str() + end + 1, " %c %d", &state, &ppid) == 2 && ppid == parent)
      workers.push_back(std::stoi(name));
  }
  return workers;
}

bool wait_until(const std::function<bool()>& condition) {
  for (int i = 0; i < 1000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

bool is_gone(pid_t worker) {
  std::ifstream stat("/proc/" + std::to_string(worker) + "/stat");
  const std::string text((std::istreambuf_iterator<char>(stat)), {});
  return text.empty() || text.find(") Z ") != std::string::npos;
}

void expect_gone(const std::vector<pid_t>& workers) {
  EXPECT_TRUE(wait_until([&] { return std::all_of(workers.begin(), workers.end(), is_gone); }))
      << "a worker outlived its parent";
  for (const pid_t worker : workers)
    if (!is_gone(worker)) kill(worker, SIGKILL);
}

std::vector<std::string> study(const std::filesystem::path& folder) {
  return {"compare",   particle_scene(folder), "--backend", MISBEHAVING_BACKEND,
          "--backend", SAMPLE_BACKEND,         "--repeat",  "2",
          "--set",     "pause=0.005",          "--out",     (folder / "out").string()};
}

void expect_complete(const std::filesystem::path& folder) {
  const Finished finished = plumb(study(folder));
  EXPECT_EQ(finished.status, 0) << finished.err;
  const std::vector<Json> rows = readable_rows(folder / "out" / "results.jsonl");
  std::set<std::string> cells;
  for (const Json& row : rows) {
    EXPECT_EQ(row["status"], "ok") << row.dump();
    EXPECT_TRUE(cells.insert(row["cell"]).second) << "a cell was run twice";
  }
  EXPECT_EQ(cells.size(), 6u) << finished.out << finished.err;
}

void kill_half_way_and_go_on(const std::string& name, bool workers_first) {
  const std::filesystem::path folder = fresh_folder(name);
  const std::filesystem::path file = folder / "out" / "results.jsonl";
  const pid_t pid = start_plumb(study(folder));
  ASSERT_TRUE(wait_until([&] { return readable_rows(file).size() >= 2; }));
  const std::vector<pid_t> workers = workers_of(pid);
  EXPECT_FALSE(workers.empty());
  if (workers_first) {
    for (const pid_t worker : workers) kill(worker, SIGKILL);
  }
  kill(pid, SIGKILL);
  waitpid(pid, nullptr, 0);
  expect_gone(workers);
  EXPECT_LT(readable_rows(file).size(), 6u);
  expect_complete(folder);
}

TEST(Resume, after_the_program_was_killed) { kill_half_way_and_go_on("killed", false); }
TEST(Resume, after_program_and_workers_were_killed) { kill_half_way_and_go_on("all_killed", true); }

TEST(Resume, two_at_once_in_one_folder_share_the_cells) {
  const std::filesystem::path folder = fresh_folder("two_at_once");
  const std::vector<std::string> arguments = study(folder);
  const pid_t other = start_plumb(arguments);
  const Finished finished = plumb(arguments);
  int status = 0;
  waitpid(other, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(finished.status, 0) << finished.err;
  for (const char* backend : {"misbehaving", "sample"})
    EXPECT_NE(finished.out.find(backend), std::string::npos) << "each shows all rows: " << finished.out;
  EXPECT_EQ(readable_rows(folder / "out" / "results.jsonl").size(), 6u);
  expect_complete(folder);
}

TEST(Resume, a_cell_whose_worker_was_killed_says_that_it_was_repeated) {
  const std::filesystem::path folder = fresh_folder("repeated");
  const std::filesystem::path traces = folder / "out" / "traces";
  const pid_t pid = start_plumb({"run", particle_scene(folder), "--backend", MISBEHAVING_BACKEND, "--param",
                                 "height=10", "--set", "pause=0.02", "--trace", "--out", (folder / "out").string()});
  // The worker that has begun a trace has a second of steps before it.
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(traces) && !std::filesystem::is_empty(traces); }));
  for (const pid_t worker : workers_of(pid)) kill(worker, SIGKILL);
  waitpid(pid, nullptr, 0);
  const std::vector<Json> rows = readable_rows(folder / "out" / "results.jsonl");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0]["status"], "ok") << rows[0].dump();
  EXPECT_EQ(rows[0]["restarted"], 1);
}

TEST(Resume, a_worker_that_hangs_dies_with_the_program) {
  const std::filesystem::path folder = fresh_folder("hanging");
  const std::filesystem::path traces = folder / "out" / "traces";
  const pid_t pid = start_plumb({"run", particle_scene(folder), "--backend", MISBEHAVING_BACKEND, "--set",
                                 "misbehaviour=hang", "--trace", "--out", (folder / "out").string()});
  // The worker that has begun a trace is a few steps from where it hangs and hears of nothing any more.
  const auto has_begun = [&] { return std::filesystem::exists(traces) && !std::filesystem::is_empty(traces); };
  ASSERT_TRUE(wait_until(has_begun));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const std::vector<pid_t> workers = workers_of(pid);
  EXPECT_EQ(workers.size(), 1u);
  kill(pid, SIGKILL);
  waitpid(pid, nullptr, 0);
  expect_gone(workers);
}

TEST(Resume, torn_last_line_is_run_again) {
  const std::filesystem::path folder = fresh_folder("torn");
  ASSERT_EQ(plumb(study(folder)).status, 0);
  const std::filesystem::path file = folder / "out" / "results.jsonl";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 40);
  EXPECT_EQ(readable_rows(file).size(), 5u);
  expect_complete(folder);
  const Finished again = plumb(study(folder));
  EXPECT_NE(again.err.find("6 cells were finished already"), std::string::npos) << again.err;
}

TEST(Resume, packed_rows_are_finished) {
  const std::filesystem::path folder = fresh_folder("packed");
  ASSERT_EQ(plumb(study(folder)).status, 0);
  const std::filesystem::path file = folder / "out" / "results.jsonl";
  std::ifstream in(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  std::string packed(ZSTD_compressBound(text.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), text.data(), text.size(), 3));
  std::ofstream(file.string() + ".zst", std::ios::binary) << packed;
  std::filesystem::remove(file);
  const Finished again = plumb(study(folder));
  EXPECT_NE(again.err.find("6 cells were finished already"), std::string::npos) << again.err;
  EXPECT_TRUE(readable_rows(file).empty());
}

TEST(Resume, terminate_kills_the_workers_and_ends_by_the_signal) {
  const std::filesystem::path folder = fresh_folder("terminated");
  const pid_t pid = start_plumb(study(folder));
  ASSERT_TRUE(wait_until(
      [&] { return std::filesystem::exists(folder / "out" / "results.jsonl") && !workers_of(pid).empty(); }));
  const std::vector<pid_t> workers = workers_of(pid);
  kill(pid, SIGTERM);
  int status = 0;
  waitpid(pid, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) << status;
  expect_complete(folder);
}

}  // namespace
}  // namespace plumb::harness::testing
