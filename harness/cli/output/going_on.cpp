#include "cli/output/going_on.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace plumb::harness {

std::string typed_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string line, word;
  while (std::getline(file, word, '\0')) {
    if (line.empty()) word = std::filesystem::path(word).filename().string();
    const bool plain = !word.empty() && word.find_first_of(" '\"\\$*?;&|<>()") == std::string::npos;
    line += (line.empty() ? "" : " ") + (plain ? word : "'" + word + "'");
  }
  return line;
}

std::string count_of(std::size_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

void say_how_to_go_on(std::size_t finished, const std::string& folder) {
  if (folder.empty()) {
    fmt::print(stderr, "plumb: stopped after {}; with --out DIR they are kept, and the same line goes on\n",
               count_of(finished, "cell"));
  } else {
    fmt::print(stderr, "plumb: stopped; {} finished so far, kept in {}; the same line goes on: {}\n",
               count_of(finished, "cell"), folder, typed_line());
  }
}

}  // namespace plumb::harness
