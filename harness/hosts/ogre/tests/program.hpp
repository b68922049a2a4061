// Runs the program as a shell would.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <stdexcept>
#include <string>

namespace plumb::ogre::tests {

struct Ended {
  int status = 0;
  std::string text;  ///< of standard output, and of standard error where asked for
};

[[nodiscard]] inline Ended run_line(const std::string& line) {
  std::FILE* pipe = popen(line.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + line);
  Ended ended;
  char part[4096];
  for (std::size_t size = 0; (size = std::fread(part, 1, sizeof(part), pipe)) > 0;) ended.text.append(part, size);
  const int status = pclose(pipe);
  ended.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  return ended;
}

}  // namespace plumb::ogre::tests
