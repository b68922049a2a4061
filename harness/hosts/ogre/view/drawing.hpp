// The game as OGRE draws it: a node for each thing, one for the character, lights, and words over it all.
#pragma once

#include <OgreCamera.h>
#include <OgreRenderWindow.h>
#include <OgreSceneManager.h>
#include <OgreTextAreaOverlayElement.h>

#include <optional>
#include <string>
#include <vector>

#include "hosts/ogre/game/camera.hpp"
#include "hosts/ogre/game/game.hpp"

namespace plumb::ogre {

class Drawing {
 public:
  Drawing(Ogre::SceneManager& scene, Ogre::RenderWindow& window, const Game& game);

  /// How the game is now.
  void update(const Game& game, const Camera& camera);

 private:
  struct Drawn {
    Ogre::SceneNode* node;
    Ogre::Entity* entity;
    std::string material;
  };
  void light();
  void add_grid();
  void add_words();
  Drawn add(const std::string& name, const PlumbShapeDesc& shape, std::uint32_t colour);
  void tell(const Game& game);

  Ogre::SceneManager& scene_;
  Ogre::SceneNode* camera_node_ = nullptr;
  Ogre::Camera* camera_ = nullptr;
  std::vector<Drawn> things_;  // as the game's
  Drawn character_{};
  Ogre::TextAreaOverlayElement* status_ = nullptr;
  Ogre::TextAreaOverlayElement* notice_ = nullptr;
  std::optional<std::size_t> held_;
};

}  // namespace plumb::ogre
