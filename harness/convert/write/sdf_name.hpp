// Names as libsdformat takes them, which reads URDF, too.
#pragma once

#include <string>

namespace plumb::harness {

/// "::" parts names there, and a beginning of "__" is its own.
[[nodiscard]] inline std::string sdf_name(std::string name) {
  for (std::size_t at; (at = name.find("::")) != std::string::npos;) name.replace(at, 2, "/");
  return name.starts_with("__") ? "x" + name : name;
}

}  // namespace plumb::harness
