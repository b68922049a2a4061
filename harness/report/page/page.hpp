// The report as one HTML file: no network, no fonts, no libraries; diagrams are inline SVG made here.
#pragma once

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "run/json.hpp"

namespace plumb::harness {

/// What a scene file says of itself.
struct SceneText {
  std::string title, doc;
};

struct PageOptions {
  std::string written;  ///< when, as it shall stand on the page
  std::string source;   ///< where the results came from
  std::map<std::string, SceneText>
      scenes;  ///< by scene id as rows have it; scenes without an entry show their id alone
};

void write_page(std::ostream& out, const std::vector<Json>& rows, const PageOptions& options);

}  // namespace plumb::harness
