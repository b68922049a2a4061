// What libsdformat prints, as lines: much that it drops it tells its console alone.
#pragma once

#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace plumb::harness {

/// As long as it lives, what is printed to stderr is kept instead.
class SdfConsole {
 public:
  SdfConsole() : was_(std::cerr.rdbuf(said_.rdbuf())) {}
  ~SdfConsole() { std::cerr.rdbuf(was_); }
  SdfConsole(const SdfConsole&) = delete;
  SdfConsole& operator=(const SdfConsole&) = delete;

  /// Without colours and places in libsdformat's own source.
  [[nodiscard]] std::vector<std::string> lines() const;

 private:
  std::ostringstream said_;
  std::streambuf* was_;
};

}  // namespace plumb::harness
