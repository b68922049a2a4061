#include "replay/title.hpp"

#include "base/format.hpp"

namespace plumb::harness {

std::string replay_title(const Json& header) {
  std::string title = header.value("scene", "");
  const Json parameters = header.value("params", Json::object());
  for (const auto& [name, value] : parameters.items()) title += " " + name + "=" + value_text(value);
  return title;
}

}  // namespace plumb::harness
