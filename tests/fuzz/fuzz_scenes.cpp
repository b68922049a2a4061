// Mutated scene files: each is read or refused in words (UsageError), and nothing else happens.
//
// usage: fuzz_scenes COUNT [SEED]
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>

#include "scene/catalogue.hpp"

namespace {

namespace fs = std::filesystem;
using plumb::harness::SceneFile;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A few small wounds: bytes changed, pieces dropped, doubled or moved, numbers and words exchanged.
std::string mutate(std::string text, std::mt19937_64& random) {
  static const char* const kWords[] = {"null",       "true",    "-1",           "1e999", "\"1/0\"", "[]",
                                       "{}",         "\"H\"",   "1e30",         "0",     "\"\"",    "\"box\"",
                                       "\"sphere\"", "\"pi*\"", "\"friction\"", "3.5"};
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  for (std::size_t wounds = 1 + below(3); wounds > 0 && text.size() > 8; --wounds) {
    const std::size_t at = below(text.size() - 4), length = 1 + below(std::min<std::size_t>(40, text.size() - at));
    switch (below(6)) {
      case 0: text[at] = static_cast<char>(random()); break;
      case 1: text.erase(at, length); break;
      case 2: text.insert(at, text.substr(below(text.size() - length), length)); break;
      case 3: text.insert(at, std::string(1, "{}[]\",:0-"[below(9)])); break;
      default: {  // a value for another value
        const std::size_t colon = text.find(':', at);
        if (colon == std::string::npos) break;
        const std::size_t end = text.find_first_of(",}\n", colon);
        if (end != std::string::npos) text.replace(colon + 1, end - colon - 1, kWords[below(std::size(kWords))]);
      }
    }
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: fuzz_scenes COUNT [SEED]\n");
    return 2;
  }
  std::mt19937_64 random(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
  std::vector<SceneFile> scenes = plumb::harness::all_scenes();
  std::vector<std::string> texts;
  for (const SceneFile& scene : scenes) texts.push_back(text_of(scene.path));
  std::string folder = (fs::temp_directory_path() / "plumb-fuzz-XXXXXX").string();
  if (texts.empty() || mkdtemp(folder.data()) == nullptr) {
    std::fprintf(stderr, "no scenes or no temporary folder\n");
    return 2;
  }
  std::uint64_t read = 0, refused = 0;
  for (std::uint64_t left = std::strtoull(argv[1], nullptr, 10); left > 0; --left) {
    const std::size_t which = random() % texts.size();
    const fs::path file = fs::path(folder) / scenes[which].path.filename();
    const std::string text = mutate(texts[which], random);
    std::ofstream(file) << text;
    try {
      (void)SceneFile::load(file).instantiate({});
      ++read;
    } catch (const plumb::harness::UsageError& error) {
      ++refused;
      if (*error.what() == '\0') return std::fprintf(stderr, "refused without a word:\n%s\n", text.c_str()), 1;
    } catch (const std::exception& error) {
      return std::fprintf(stderr, "escaped: %s\n%s\n", error.what(), text.c_str()), 1;
    }
  }
  fs::remove_all(folder);
  std::printf("%llu read, %llu refused\n", static_cast<unsigned long long>(read),
              static_cast<unsigned long long>(refused));
  return 0;
}
