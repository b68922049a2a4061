// Which engine is below: the one string that exchanges it.
#pragma once

#include <string>

#include "plumb/loader.hpp"

namespace plumb::gazebo {

/// $PLUMB_GAZEBO_BACKEND, or impulse.
[[nodiscard]] std::string default_engine();

/// A backend by name or file, from the loader's folders and from plumb/ beside this plugin. Throws Error; where there
/// is none of that name the sentence lists those that are installed.
[[nodiscard]] Backend open_engine(const std::string& name);

}  // namespace plumb::gazebo
