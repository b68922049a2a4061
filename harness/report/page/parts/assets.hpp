// The page's style, and the script that must run before anything is painted, taken into the program when it is built.
#pragma once

#include <string_view>

namespace plumb::harness {

extern const std::string_view page_style;
extern const std::string_view page_theme_script;

}  // namespace plumb::harness
