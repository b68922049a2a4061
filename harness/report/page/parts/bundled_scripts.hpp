// Scripts bundled by node with their libraries and taken into the program when it is built: the viewer of replays, and
// what draws the page's tables and diagrams. Empty where the build had no node.
#pragma once

#include <string_view>

namespace plumb::harness {

extern const std::string_view viewer_script;
extern const std::string_view page_script;

/// Whether the program was built with the viewer that plays replays.
[[nodiscard]] inline bool has_viewer() { return !viewer_script.empty(); }
/// Whether it was built with the script that draws tables and diagrams: without, a page has words alone, and says so.
[[nodiscard]] inline bool has_page_script() { return !page_script.empty(); }

}  // namespace plumb::harness
