// The window: OGRE set up without questions, and what keys and mouse do in it as actions.
#pragma once

#include <OgreApplicationContext.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hosts/ogre/game/actions.hpp"
#include "hosts/ogre/view/drawing.hpp"

namespace plumb::ogre {

class Window final : private OgreBites::ApplicationContext, private OgreBites::InputListener {
 public:
  /// smooth: without stairs along edges, which takes a processor that renders three times as long. Throws
  /// std::runtime_error with a sentence when there is no display, or OGRE lacks a part.
  Window(const Game& game, Camera& camera, bool smooth);
  ~Window() override;

  /// Draws a frame.
  void show(const Game& game);
  /// What was done since it was asked last.
  [[nodiscard]] std::vector<Action> take_actions();
  /// Also when the program was asked to end, as by Ctrl-C.
  [[nodiscard]] bool is_closed() const;
  void save_picture(const std::string& file);

 private:
  void createRoot() override;
  bool oneTimeConfig() override;
  void locateResources() override;

  void windowResized(Ogre::RenderWindow* window) override;
  bool windowClosing(Ogre::RenderWindow* window) override;
  bool keyPressed(const OgreBites::KeyboardEvent& event) override;
  bool keyReleased(const OgreBites::KeyboardEvent& event) override;
  bool mousePressed(const OgreBites::MouseButtonEvent& event) override;
  bool mouseReleased(const OgreBites::MouseButtonEvent& event) override;
  bool mouseMoved(const OgreBites::MouseMotionEvent& event) override;
  bool mouseWheelRolled(const OgreBites::MouseWheelEvent& event) override;

  [[nodiscard]] Point place(int x, int y) const;
  [[nodiscard]] Walk walk() const;

  Camera& camera_;
  bool smooth_;
  std::optional<Drawing> drawing_;
  std::vector<Action> actions_;
  std::set<OgreBites::Keycode> keys_;
  std::set<int> buttons_;
  bool walks_ = false;
  bool closed_ = false;
};

}  // namespace plumb::ogre
