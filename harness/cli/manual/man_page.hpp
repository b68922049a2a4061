// Manual pages of the program and of its verbs, in the man macros, made from the option table.
#pragma once

#include <string>

#include "cli/manual/option_table.hpp"

namespace plumb::harness {

/// plumb(1); version: "plumb 1.0.0".
[[nodiscard]] std::string man_page(const ProgramTable& program, const std::string& version);
/// plumb-VERB(1).
[[nodiscard]] std::string man_page(const ProgramTable& program, const VerbEntry& verb, const std::string& version);

}  // namespace plumb::harness
