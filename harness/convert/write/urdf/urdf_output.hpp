// What a URDF file is written with.
#pragma once

#include <map>
#include <string>

#include "convert/imported.hpp"
#include "convert/write/xml.hpp"

namespace plumb::harness {

struct UrdfOutput {
  const Scene& scene;
  std::string name;  ///< of the robot, with which names of mesh files begin
  Remarks& remarks;
  Xml xml{};
  std::map<std::string, std::string> meshes{};  ///< OBJ texts by file name
};

/// <origin>: a frame in the one around it.
void write_origin(Xml& xml, const referee::Pose& pose);

}  // namespace plumb::harness
