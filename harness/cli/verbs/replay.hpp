// plumb replay: runs a recorded trace again on backends, and says where they first part from it.
#pragma once

#include <CLI/CLI.hpp>

namespace plumb::harness {

/// Adds the verb to the program. When it is used, it prints its answer and sets status: 0 the same, 1 something
/// differs. What is asked wrongly (no such file or backend, a file that is no trace) is thrown as UsageError.
void add_replay(CLI::App& program, int& status);

}  // namespace plumb::harness
