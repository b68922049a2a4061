// The page's style and scripts, taken into the program from page.css, theme.js and page.js when it is built.
#pragma once

#include <string_view>

namespace plumb::harness {

extern const std::string_view page_style;
extern const std::string_view page_theme_script;
extern const std::string_view page_script;

}  // namespace plumb::harness
