// impulse_hashes: the state hashes of scenes after 300 steps, to be the same on every machine.
//
// usage: impulse_hashes BACKEND [--record | --check | --times] [--steps N] [--threads N] [SCENE]...
// Without more it prints a name and a hash a line. --record prints them as recorded.inc has them; --check compares them
// with recorded.inc and ends with 1 where one differs; --times adds seconds.
#include <charconv>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <string_view>

#include "plugin/physics_revision.hpp"
#include "tests/hashes/scene.hpp"

namespace {

using namespace plumb::impulse::test;

struct Recorded {
  const char* name;
  std::uint64_t hash;
  int revision;
  const char* from;
};
const std::vector<Recorded> kRecorded = {
#define RECORDED(name, hash, revision, from) {name, hash, revision, from},
#include "tests/hashes/recorded.inc"
#undef RECORDED
};

const Recorded* find(std::string_view name) {
  for (const Recorded& row : kRecorded)
    if (name == row.name) return &row;
  return nullptr;
}

enum class Mode { kPrint, kRecord, kCheck, kTimes };

struct Question {
  std::string backend;
  Mode mode = Mode::kPrint;
  int steps = 300;
  std::uint32_t threads = 1;
  std::vector<std::string_view> scenes;  ///< empty: all
};

template <class T>
bool take_number(std::string_view text, T& value) {
  const auto end = text.data() + text.size();
  return std::from_chars(text.data(), end, value).ptr == end && !text.empty();
}

bool parse(int count, char** words, Question& question) {
  for (int i = 1; i < count; ++i) {
    const std::string_view word = words[i], next = i + 1 < count ? words[i + 1] : "";
    if (word == "--record")
      question.mode = Mode::kRecord;
    else if (word == "--check")
      question.mode = Mode::kCheck;
    else if (word == "--times")
      question.mode = Mode::kTimes;
    else if (word == "--steps" && take_number(next, question.steps))
      ++i;
    else if (word == "--threads" && take_number(next, question.threads))
      ++i;
    else if (word.starts_with("--"))
      return false;
    else if (question.backend.empty())
      question.backend = word;
    else
      question.scenes.push_back(word);
  }
  return !question.backend.empty();
}

bool wanted(const Question& question, std::string_view name) {
  if (question.scenes.empty()) return true;
  for (const std::string_view scene : question.scenes)
    if (scene == name) return true;
  return false;
}

/// Says so and returns false where the hash is not the recorded one.
bool agrees(const NamedScene& scene, std::uint64_t hash) {
  const Recorded* recorded = find(scene.name);
  if (recorded == nullptr) {
    std::printf("%s is not recorded\n", scene.name);
    return false;
  }
  if (recorded->revision != PLUMB_IMPULSE_PHYSICS_REVISION) {
    std::printf("%s was recorded with physics revision %d; this is %d: record it anew\n", scene.name,
                recorded->revision, PLUMB_IMPULSE_PHYSICS_REVISION);
    return false;
  }
  if (recorded->hash == hash) return true;
  std::printf("%s: %016" PRIx64 ", but %s gave %016" PRIx64
              ". Results that changed on purpose need a higher physics revision and a new recording\n",
              scene.name, hash, recorded->from, recorded->hash);
  return false;
}

std::string origin(const plumb::Backend& backend) {
  const std::string device = backend.info().device;
  return device == "cpu" ? device : "gpu: " + device;
}

plumb::Backend open(const std::string& backend) {
#if defined(__wasm__)  // which loads nothing at run time: the engine is linked in
  return plumb::Backend(plumb::negotiate(&plumb_backend_open, backend));
#else
  return plumb::open_backend(backend);
#endif
}

int run(const Question& question) {
  const plumb::Backend backend = open(question.backend);
  int left_out = 0, wrong = 0;
  for (const NamedScene& scene : named_scenes()) {
    if (!wanted(question, scene.name)) continue;
    if (const std::string lacks = missing(backend, scene); !lacks.empty()) {
      std::fprintf(stderr, "%s is left out: %s has no %s\n", scene.name, backend.info().name, lacks.c_str());
      left_out += find(scene.name) != nullptr;
      continue;
    }
    const auto start = std::chrono::steady_clock::now();
    const std::unique_ptr<Scene> built = build(backend, scene, question.threads);
    built->run(question.steps);
    const std::uint64_t hash = built->hash();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    if (question.mode == Mode::kRecord)
      std::printf("RECORDED(\"%s\", 0x%016" PRIx64 ", %d, \"%s\")\n", scene.name, hash, PLUMB_IMPULSE_PHYSICS_REVISION,
                  origin(backend).c_str());
    else if (question.mode == Mode::kTimes)
      std::printf("%s %016" PRIx64 " %.2f s\n", scene.name, hash, seconds.count());
    else if (question.mode == Mode::kPrint)
      std::printf("%s %016" PRIx64 "\n", scene.name, hash);
    else if (!agrees(scene, hash))
      ++wrong;
    std::fflush(stdout);
  }
  return question.mode == Mode::kCheck && (wrong != 0 || left_out != 0) ? 1 : 0;
}

}  // namespace

int main(int count, char** words) {
  Question question;
  if (!parse(count, words, question)) {
    std::fprintf(stderr,
                 "usage: impulse_hashes BACKEND [--record | --check | --times] [--steps N] [--threads N] [SCENE]...\n");
    return 2;
  }
  try {
    return run(question);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "impulse_hashes: %s\n", error.what());
    return 2;
  }
}
