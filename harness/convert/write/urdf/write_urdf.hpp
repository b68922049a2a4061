// A scene as a robot in URDF (wiki.ros.org/urdf/XML), the format of ROS.
#pragma once

#include "convert/imported.hpp"

namespace plumb::harness {

/// The text, and the files of meshes that it names.
struct UrdfFiles {
  std::string robot;
  std::map<std::string, std::string> meshes;  ///< OBJ texts by file name
};

/// Z is up there. A robot that stands on nothing has its root link's frame at the world's origin, so that it is where
/// the scene has it; one that the world or something static holds hangs on a link "world". The frame of every other
/// link is that of the joint which holds it, and coordinates count from the start. name: of the robot, and what names
/// of mesh files begin with. Throws UsageError for what is no tree of links with joints of one axis; what else URDF has
/// no word for becomes remarks. Of efforts, those that were read with the scene are used.
[[nodiscard]] UrdfFiles write_urdf(Imported& imported, const std::string& name);

}  // namespace plumb::harness
