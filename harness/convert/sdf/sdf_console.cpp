#include "convert/sdf/sdf_console.hpp"

#include <regex>

namespace plumb::harness {

std::vector<std::string> SdfConsole::lines() const {
  static const std::regex colour("\x1b\\[[0-9;]*m"), prefix("^(Error|Warning|Msg|Dbg)?:? *\\[[^\\]]*\\] *");
  std::vector<std::string> lines;
  std::istringstream text(said_.str());
  for (std::string line; std::getline(text, line);) {
    line = std::regex_replace(std::regex_replace(line, colour, ""), prefix, "");
    while (!line.empty() && line.back() == '.') line.pop_back();
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

}  // namespace plumb::harness
