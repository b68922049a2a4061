// Shapes of the interface as meshes of OGRE.
#pragma once

#include <OgreMesh.h>
#include <OgreSceneManager.h>

#include <string>

#include "plumb/physics_world.hpp"

namespace plumb::ogre {

/// A sphere, box, capsule or cylinder, closed, with the edges that its shadow needs.
[[nodiscard]] Ogre::MeshPtr make_mesh(Ogre::SceneManager& scene, const PlumbShapeDesc& shape, const std::string& name,
                                      const std::string& material);

}  // namespace plumb::ogre
