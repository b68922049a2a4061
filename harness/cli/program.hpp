// The program as a function of its line.
#pragma once

namespace plumb::harness {

/// Does what the line asks for and returns the exit status: that of the verb, or 2 where the question was wrong, which
/// is said on stderr. What a signal interrupts ends by that signal.
int run_program(int count, char** arguments);

}  // namespace plumb::harness
