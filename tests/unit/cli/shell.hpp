// Runs a line in bash and gathers what it said.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>

namespace plumb::harness::testing {

struct Said {
  int status = -1;
  std::string text;  ///< standard output and error together
};

inline Said in_bash(const std::string& line) {
  std::string quoted;
  for (const char c : line) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  Said said;
  std::FILE* pipe = popen(("bash -c '" + quoted + "' 2>&1").c_str(), "r");
  if (pipe == nullptr) return said;
  std::array<char, 4096> buffer{};
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
    said.text.append(buffer.data(), count);
  said.status = WEXITSTATUS(pclose(pipe));
  return said;
}

inline bool has_command(const std::string& name) { return in_bash("command -v " + name).status == 0; }

}  // namespace plumb::harness::testing
