// Triangles of a mesh that Gazebo has loaded.
#pragma once

#include <ignition/common/Mesh.hh>

#include "hosts/gazebo/world/geometry.hpp"

namespace plumb::gazebo {

/// Without triangles where it has none.
[[nodiscard]] Geometry mesh_of(const ignition::common::Mesh& mesh, const Vector& scale);
/// Of a file; without triangles where it cannot be read, of which the console is told.
[[nodiscard]] Geometry mesh_of(const std::string& uri, const std::string& submesh, const Vector& scale);

}  // namespace plumb::gazebo
