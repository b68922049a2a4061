// Completion of the program's line in bash, zsh and fish, made from the option table. What only the machine knows
// (scenes, backends) the scripts ask of the program itself: plumb completion --words KIND.
#pragma once

#include <string>

#include "cli/manual/option_table.hpp"

namespace plumb::harness {

[[nodiscard]] std::string bash_completion(const ProgramTable& program);
[[nodiscard]] std::string zsh_completion(const ProgramTable& program);
[[nodiscard]] std::string fish_completion(const ProgramTable& program);

}  // namespace plumb::harness
