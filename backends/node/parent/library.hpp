// What this library starts: its name, the command of its child, and the manifest that the child gave.
#pragma once

#include <string>
#include <vector>

#include "manifest.hpp"

namespace plumb::wire {

/// The words of the command. "@/" at a word's beginning is the folder of this library.
[[nodiscard]] const std::vector<std::string>& child_command();

/// Asked of a child at the first call, which then ends.
[[nodiscard]] const Manifest& manifest();

/// Why no child can be described or the engine is missing, in a sentence; "" where all is well.
[[nodiscard]] std::string why_not();

/// Where the manifest would be asked for in vain.
[[nodiscard]] const PlumbBackendInfo& info_or_name();

}  // namespace plumb::wire
