// What went wrong, in a sentence that names the value and the remedy, on Gazebo's console.
#pragma once

#include <string>

namespace plumb::gazebo {

void complain(const std::string& sentence);
/// What is done all the same, but not as asked.
void warn(const std::string& sentence);
/// Likewise, once for each sentence: for what would be said in every step.
void warn_once(const std::string& sentence);

}  // namespace plumb::gazebo
