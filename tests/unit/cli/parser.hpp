// The program's parser alone: no verb does anything.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/verbs/verbs.hpp"

namespace plumb::harness::testing {

struct Parsed {};

/// Throws Parsed when it has taken a line, before a verb does anything.
struct Parser {
  Parser() : program("the program", "plumb") {
    add_verbs(program, status);
    program.parse_complete_callback([] { throw Parsed(); });
  }
  int status = 0;
  CLI::App program;
};

}  // namespace plumb::harness::testing
