// Scripts bundled by node with their libraries and taken into the program when it is built: the viewer of replays, and
// what draws the page's tables and diagrams. Empty where the build had no node.
#pragma once

#include <string_view>

namespace plumb::harness {

extern const std::string_view viewer_script;
extern const std::string_view page_script;

}  // namespace plumb::harness
