#include "hosts/ogre/view/window.hpp"

#include <OgreLogManager.h>
#include <OgreOverlaySystem.h>
#include <OgreRTShaderSystem.h>
#include <OgreRoot.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "hosts/ogre/game/vectors.hpp"

namespace plumb::ogre {
namespace {

constexpr const char* kTitle = "plumb-ogre";
constexpr double kTurn = 0.005;  // rad for a pixel of the mouse
constexpr std::array kRenderSystems{"OpenGL 3+ Rendering Subsystem", "OpenGL Rendering Subsystem"};

}  // namespace

Window::Window(const Game& game, Camera& camera, bool smooth)
    : OgreBites::ApplicationContext(kTitle), camera_(camera), smooth_(smooth) {
  try {
    initApp();
    Ogre::SceneManager* scene = mRoot->createSceneManager();
    scene->addRenderQueueListener(mOverlaySystem);
    mShaderGenerator->addSceneManager(scene);
    drawing_.emplace(*scene, *getRenderWindow(), game);
  } catch (const Ogre::Exception& error) {
    throw std::runtime_error("there is no window: " + error.getDescription() +
                             ": run it on a desktop, or without one by xvfb-run -a plumb-ogre --frames 300");
  }
  windowResized(getRenderWindow());
  addInputListener(this);
}

Window::~Window() { closeApp(); }

void Window::createRoot() {
  // OGRE's log would lie beside whatever the player started the game in.
  (new Ogre::LogManager)->createLog(kTitle, true, false, true);
  mRoot = new Ogre::Root("", "", "");
  for (const char* plugin : {"RenderSystem_GL3Plus", "RenderSystem_GL", "Codec_STBI"})
    mRoot->loadPlugin(std::string(PLUMB_OGRE_PLUGINS "/") + plugin);
  mOverlaySystem = new Ogre::OverlaySystem;
}

bool Window::oneTimeConfig() {
  for (const char* name : kRenderSystems)
    if (Ogre::RenderSystem* system = mRoot->getRenderSystemByName(name)) {
      system->setConfigOption("Full Screen", "No");
      system->setConfigOption("Video Mode", "960 x 600");
      system->setConfigOption("FSAA", smooth_ ? "4" : "0");
      mRoot->setRenderSystem(system);
      return true;
    }
  return false;
}

void Window::locateResources() {
  Ogre::ResourceGroupManager& groups = Ogre::ResourceGroupManager::getSingleton();
  const std::string media = PLUMB_OGRE_MEDIA "/";
  for (const char* folder : {"ShadowVolume", "RTShaderLib/materials", "RTShaderLib/GLSL"})
    groups.addResourceLocation(media + folder, "FileSystem", Ogre::RGN_INTERNAL);
  groups.addResourceLocation(media + "packs/SdkTrays.zip", "Zip", "Essential");
}

void Window::show(const Game& game) {
  drawing_->update(game, camera_);
  mRoot->renderOneFrame();
}

bool Window::is_closed() const { return closed_ || mRoot->endRenderingQueued(); }

void Window::save_picture(const std::string& file) { getRenderWindow()->writeContentsToFile(file); }

std::vector<Action> Window::take_actions() {
  // Told again while keys are down, for the camera may turn meanwhile.
  const Walk now = walk();
  const bool walks = now.x != 0 || now.z != 0;
  if (walks || walks_) actions_.push_back(now);
  walks_ = walks;
  return std::exchange(actions_, {});
}

Walk Window::walk() const {
  using namespace OgreBites;
  const auto down = [this](std::initializer_list<Keycode> keys) {
    for (const Keycode key : keys)
      if (keys_.count(key) != 0) return 1.0;
    return 0.0;
  };
  const double right = down({'d', SDLK_RIGHT}) - down({'a', SDLK_LEFT});
  const double ahead = down({'w', SDLK_UP}) - down({'s', SDLK_DOWN});
  const PlumbVec3 forward{-std::sin(camera_.yaw), 0, -std::cos(camera_.yaw)};
  const PlumbVec3 way = add(scale(right, camera_.right()), scale(ahead, forward));
  const double far = length(way);
  return far == 0 ? Walk{} : Walk{Game::kWalk * way.x / far, Game::kWalk * way.z / far};
}

void Window::windowResized(Ogre::RenderWindow* window) {
  camera_.aspect = static_cast<double>(window->getWidth()) / std::max(window->getHeight(), 1U);
}

bool Window::windowClosing(Ogre::RenderWindow*) {
  closed_ = true;
  return true;
}

bool Window::keyPressed(const OgreBites::KeyboardEvent& event) {
  if (event.repeat != 0) return true;
  keys_.insert(event.keysym.sym);
  if (event.keysym.sym == OgreBites::SDLK_SPACE) actions_.emplace_back(Jump{});
  if (event.keysym.sym == 'b') actions_.emplace_back(SwitchTo{});
  if (event.keysym.sym == OgreBites::SDLK_ESCAPE) closed_ = true;
  return true;
}

bool Window::keyReleased(const OgreBites::KeyboardEvent& event) {
  keys_.erase(event.keysym.sym);
  return true;
}

Point Window::place(int x, int y) const {
  const Ogre::RenderWindow* window = getRenderWindow();
  return {(x + 0.5) / window->getWidth(), (y + 0.5) / window->getHeight()};
}

bool Window::mousePressed(const OgreBites::MouseButtonEvent& event) {
  buttons_.insert(event.button);
  const Point at = place(event.x, event.y);
  if (event.button == OgreBites::BUTTON_LEFT) actions_.emplace_back(Press{at.x, at.y});
  return true;
}

bool Window::mouseReleased(const OgreBites::MouseButtonEvent& event) {
  buttons_.erase(event.button);
  if (event.button == OgreBites::BUTTON_LEFT) actions_.emplace_back(Release{});
  return true;
}

bool Window::mouseMoved(const OgreBites::MouseMotionEvent& event) {
  if (buttons_.count(OgreBites::BUTTON_LEFT) != 0) actions_.emplace_back(place(event.x, event.y));
  if (buttons_.count(OgreBites::BUTTON_RIGHT) != 0)
    actions_.emplace_back(Turn{-kTurn * event.xrel, kTurn * event.yrel});
  return true;
}

bool Window::mouseWheelRolled(const OgreBites::MouseWheelEvent& event) {
  actions_.emplace_back(Zoom{event.y > 0 ? 0.9 : 1.1});
  return true;
}

}  // namespace plumb::ogre
