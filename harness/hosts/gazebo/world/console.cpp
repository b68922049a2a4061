#include "hosts/gazebo/world/console.hpp"

#include <ignition/common/Console.hh>
#include <set>

namespace plumb::gazebo {

void complain(const std::string& sentence) { ignerr << "plumb: " << sentence << std::endl; }

void warn(const std::string& sentence) { ignwarn << "plumb: " << sentence << std::endl; }

void warn_once(const std::string& sentence) {
  static std::set<std::string> said;
  if (said.insert(sentence).second) warn(sentence);
}

}  // namespace plumb::gazebo
