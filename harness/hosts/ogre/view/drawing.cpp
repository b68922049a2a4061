#include "hosts/ogre/view/drawing.hpp"

#include <OgreEntity.h>
#include <OgreLight.h>
#include <OgreManualObject.h>
#include <OgreMaterialManager.h>
#include <OgreOverlay.h>
#include <OgreOverlayContainer.h>
#include <OgreOverlayManager.h>
#include <OgreTechnique.h>
#include <OgreViewport.h>

#include <sstream>

#include "hosts/ogre/view/meshes.hpp"

namespace plumb::ogre {
namespace {

constexpr std::uint32_t kCharacterColour = 0x2a9d8f, kHeld = 0xff3df5, kSky = 0xbfd7ea, kGrid = 0x9a9a90;
constexpr double kNoticeSeconds = 6;
constexpr std::size_t kLetters = 84;  // in a line of the window

Ogre::ColourValue colour_of(std::uint32_t rgb) {
  const auto part = [rgb](int shift) { return static_cast<float>((rgb >> shift) & 0xffU) / 255; };
  return Ogre::ColourValue(part(16), part(8), part(0));
}

Ogre::Vector3 to_ogre(const PlumbVec3& v) {
  return {static_cast<Ogre::Real>(v.x), static_cast<Ogre::Real>(v.y), static_cast<Ogre::Real>(v.z)};
}
Ogre::Quaternion to_ogre(const PlumbQuat& q) {
  return {static_cast<Ogre::Real>(q.w), static_cast<Ogre::Real>(q.x), static_cast<Ogre::Real>(q.y),
          static_cast<Ogre::Real>(q.z)};
}

/// One for all things of a colour.
std::string material_of(std::uint32_t colour) {
  std::ostringstream name;
  name << "plumb/" << std::hex << colour;
  Ogre::MaterialManager& manager = Ogre::MaterialManager::getSingleton();
  if (!manager.resourceExists(name.str(), Ogre::RGN_DEFAULT)) {
    Ogre::Pass* pass = manager.create(name.str(), Ogre::RGN_DEFAULT)->getTechnique(0)->getPass(0);
    pass->setAmbient(colour_of(colour));
    pass->setDiffuse(colour_of(colour));
  }
  return name.str();
}

/// Lines of a length, broken between words.
std::string broken(const std::string& text) {
  std::istringstream words(text);
  std::string lines, word;
  for (std::size_t column = 0; words >> word; column += word.size() + 1) {
    if (column > 0 && column + word.size() > kLetters) {
      lines += '\n';
      column = 0;
    } else if (column > 0) {
      lines += ' ';
    }
    lines += word;
  }
  return lines;
}

Ogre::TextAreaOverlayElement* add_text(Ogre::OverlayContainer& panel, const std::string& name, float top) {
  auto* text = static_cast<Ogre::TextAreaOverlayElement*>(
      Ogre::OverlayManager::getSingleton().createOverlayElement("TextArea", name));
  text->setMetricsMode(Ogre::GMM_PIXELS);
  text->setPosition(12, top);
  text->setFontName("SdkTrays/Caption");
  text->setCharHeight(19);
  text->setColour(colour_of(0x1d3557));
  panel.addChild(text);
  return text;
}

}  // namespace

Drawing::Drawing(Ogre::SceneManager& scene, Ogre::RenderWindow& window, const Game& game) : scene_(scene) {
  light();
  camera_ = scene.createCamera("eye");
  camera_->setNearClipDistance(0.1F);
  camera_node_ = scene.getRootSceneNode()->createChildSceneNode();
  camera_node_->setFixedYawAxis(true);  // its head stays level
  camera_node_->attachObject(camera_);
  window.addViewport(camera_)->setBackgroundColour(colour_of(kSky));
  for (const Thing& thing : game.scene().things) things_.push_back(add(thing.name, thing.shape, thing.colour));
  things_[0].entity->setCastShadows(false);  // there is nothing below the ground
  PlumbShapeDesc capsule = shape_desc(PLUMB_CAPSULE);
  capsule.radius = kCharacter.radius;
  capsule.half_height = kCharacter.half_height;
  character_ = add("character", capsule, kCharacterColour);
  add_grid();
  add_words();
}

void Drawing::light() {
  scene_.setShadowTechnique(Ogre::SHADOWTYPE_STENCIL_MODULATIVE);
  scene_.setShadowColour(Ogre::ColourValue(0.6F, 0.6F, 0.65F));
  scene_.setAmbientLight(Ogre::ColourValue(0.45F, 0.45F, 0.5F));
  Ogre::Light* sun = scene_.createLight();
  sun->setType(Ogre::Light::LT_DIRECTIONAL);
  sun->setDiffuseColour(Ogre::ColourValue(0.65F, 0.63F, 0.58F));
  Ogre::SceneNode* node = scene_.getRootSceneNode()->createChildSceneNode();
  node->setDirection({-0.45F, -1, -0.5F}, Ogre::Node::TS_WORLD);
  node->attachObject(sun);
}

Drawing::Drawn Drawing::add(const std::string& name, const PlumbShapeDesc& shape, std::uint32_t colour) {
  const std::string material = material_of(colour);
  Ogre::Entity* entity = scene_.createEntity(make_mesh(scene_, shape, name, material));
  Ogre::SceneNode* node = scene_.getRootSceneNode()->createChildSceneNode();
  node->attachObject(entity);
  return {node, entity, material};
}

/// Lines a metre apart, that one sees how far things are.
void Drawing::add_grid() {
  const std::string material = material_of(kGrid);
  Ogre::ManualObject* grid = scene_.createManualObject("grid");
  grid->begin(material, Ogre::RenderOperation::OT_LINE_LIST);
  constexpr float above = 0.005F;
  constexpr int half = 12;  // m
  for (int i = -half; i <= half; ++i) {
    const auto at = static_cast<float>(i), end = static_cast<float>(half);
    for (const Ogre::Vector3& point : {Ogre::Vector3(at, above, -end), Ogre::Vector3(at, above, end),
                                       Ogre::Vector3(-end, above, at), Ogre::Vector3(end, above, at)}) {
      grid->position(point);
      grid->normal(0, 1, 0);
    }
  }
  grid->end();
  grid->setCastShadows(false);
  scene_.getRootSceneNode()->attachObject(grid);
}

void Drawing::add_words() {
  Ogre::OverlayManager& manager = Ogre::OverlayManager::getSingleton();
  Ogre::Overlay* overlay = manager.create("words");
  auto* panel = static_cast<Ogre::OverlayContainer*>(manager.createOverlayElement("Panel", "words/panel"));
  status_ = add_text(*panel, "words/status", 10);
  add_text(*panel, "words/keys", 34)
      ->setCaption("WASD walk, space jump, left mouse drag, right mouse look, wheel zoom, B next engine");
  notice_ = add_text(*panel, "words/notice", 62);
  notice_->setColour(colour_of(0x9d0208));
  overlay->add2D(panel);
  overlay->show();
}

void Drawing::update(const Game& game, const Camera& camera) {
  const auto poses = game.stage().poses();
  for (std::size_t i = 0; i < things_.size(); ++i) {
    things_[i].node->setPosition(to_ogre(poses[i].position));
    things_[i].node->setOrientation(to_ogre(poses[i].orientation));
  }
  character_.node->setPosition(to_ogre(game.stage().character()));
  const auto& hold = game.stage().hold();
  const auto held = hold ? std::optional(hold->thing) : std::nullopt;
  if (held != held_) {
    if (held_) things_[*held_].entity->setMaterialName(things_[*held_].material);
    if (held) things_[*held].entity->setMaterialName(material_of(kHeld));
    held_ = held;
  }
  camera_->setFOVy(Ogre::Radian(static_cast<Ogre::Real>(camera.field_of_view)));
  camera_->setAspectRatio(static_cast<Ogre::Real>(camera.aspect));
  camera_node_->setPosition(to_ogre(camera.eye()));
  camera_node_->lookAt(to_ogre(camera.target), Ogre::Node::TS_WORLD);
  tell(game);
}

void Drawing::tell(const Game& game) {
  const PlumbBackendInfo& engine = game.stage().engine();
  std::ostringstream status;
  status << engine.name << ' ' << engine.version << ", " << game.stage().things_alive() << " bodies";
  if (game.stage().hold()) status << ", holding the " << game.scene().things[game.stage().hold()->thing].name;
  status_->setCaption(status.str());
  const bool fresh = !game.notices().empty() && game.stage().time() - game.notices().back().time < kNoticeSeconds;
  notice_->setCaption(fresh ? broken(game.notices().back().text) : "");
}

}  // namespace plumb::ogre
