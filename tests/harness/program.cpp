#include "program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

extern char** environ;

namespace plumb::harness::testing {

namespace {

pid_t start(std::vector<std::string> arguments, const Environment& more, const std::string& out,
            const std::string& err) {
  std::vector<std::string> environment;
  for (char** entry = environ; *entry != nullptr; ++entry) environment.emplace_back(*entry);
  for (const auto& [name, value] : more) environment.push_back(name + "=" + value);
  // Sanitizers would turn a segmentation fault into an exit; here the signal itself is what is looked for.
  environment.emplace_back("ASAN_OPTIONS=handle_segv=0:handle_abort=0:detect_leaks=0");
  arguments.insert(arguments.begin(), "plumb");
  const auto pointers = [](std::vector<std::string>& texts) {
    std::vector<char*> list;
    for (std::string& text : texts) list.push_back(text.data());
    list.push_back(nullptr);
    return list;
  };
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  pid_t pid = -1;
  const int failure =
      posix_spawn(&pid, PLUMB_PROGRAM, &actions, nullptr, pointers(arguments).data(), pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw std::runtime_error("cannot start " PLUMB_PROGRAM);
  return pid;
}

std::string text_of(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

std::vector<Json> Finished::rows() const {
  std::vector<Json> rows;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) rows.push_back(Json::parse(line));
  return rows;
}

Finished plumb(const std::vector<std::string>& arguments, const Environment& environment) {
  const std::string stem = std::string(HARNESS_TEST_FOLDER) + "/output-" + std::to_string(getpid());
  const pid_t pid = start(arguments, environment, stem + ".out", stem + ".err");
  int status = 0;
  waitpid(pid, &status, 0);
  Finished finished;
  finished.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  finished.out = text_of(stem + ".out");
  finished.err = text_of(stem + ".err");
  std::filesystem::remove(stem + ".out");
  std::filesystem::remove(stem + ".err");
  return finished;
}

pid_t start_plumb(const std::vector<std::string>& arguments, const Environment& environment) {
  return start(arguments, environment, "/dev/null", "/dev/null");
}

std::filesystem::path fresh_folder(const std::string& name) {
  // Each test runs in a process of its own, and several at a time: none may take another's folder away.
  struct OwnFolder {
    std::filesystem::path path = std::filesystem::path(HARNESS_TEST_FOLDER) / std::to_string(getpid());
    ~OwnFolder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const OwnFolder own;
  const std::filesystem::path folder = own.path / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

std::string particle_scene(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "T1-particles.json";
  std::ofstream(file) << R"({
  "id": "T1", "slug": "particles", "title": "Falling particles", "doc": "Particles fall without a shape.",
  "parameters": { "height": { "default": 10, "unit": "m", "doc": "of the start", "minimum": 1, "maximum": 100 } },
  "variants": [{ "sweep": { "height": [10, 20, 30] } }],
  "needs": [], "dt": 0.01, "seconds": 0.5,
  "bodies": [{ "name": "particle", "position": [0, "height", 0], "mass": 1, "flags": ["no_rotation"] }],
  "measure": { "kind": "free_fall", "body": "particle" },
  "metrics": {}
})";
  return file.string();
}

}  // namespace plumb::harness::testing
