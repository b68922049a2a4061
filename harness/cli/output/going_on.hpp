// What a run that was stopped on its way says: what of it is kept, and how it goes on.
#pragma once

#include <cstddef>
#include <string>

namespace plumb::harness {

/// The line that started this program, as somebody would type it again.
[[nodiscard]] std::string typed_line();

/// "3 cells"
[[nodiscard]] std::string count_of(std::size_t count, const char* thing);

/// On standard error. folder: of the results; empty: none.
void say_how_to_go_on(std::size_t finished, const std::string& folder);

}  // namespace plumb::harness
