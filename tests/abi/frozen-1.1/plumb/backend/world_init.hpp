// What a backend's world is made from: the descriptor, with every setting resolved to a value.
#pragma once

#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb {

struct WorldInit {
  PlumbWorldDesc desc;    ///< threads >= 1; settings checked
  const PlumbHost* host;  ///< may be null, and so may each of its functions
  std::span<const PlumbSettingInfo> infos;
  std::vector<PlumbSettingValue> values;  ///< in force at the start: the default, or what desc asks for

  [[nodiscard]] bool needs(PlumbNeeds bits) const { return (desc.needs & bits) == bits; }

  /// The value of one of your own settings.
  [[nodiscard]] const PlumbSettingValue& setting(const char* name) const {
    for (std::size_t i = 0; i < infos.size(); ++i)
      if (std::strcmp(infos[i].name, name) == 0) return values[i];
    throw Error(PLUMB_E_INTERNAL, std::string("backend asks for its own setting ") + name + ", which it does not list");
  }

  void log(PlumbLogLevel level, const std::string& line) const {
    if (host != nullptr && host->log != nullptr) host->log(host->user, level, line.c_str());
  }
};

}  // namespace plumb
