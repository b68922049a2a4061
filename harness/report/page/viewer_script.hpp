// The viewer of replays, one script, taken into the program when it is built. Empty where the build had no node.
#pragma once

#include <string_view>

namespace plumb::harness {

extern const std::string_view viewer_script;

}  // namespace plumb::harness
