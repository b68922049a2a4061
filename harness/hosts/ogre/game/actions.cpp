#include "hosts/ogre/game/actions.hpp"

namespace plumb::ogre {
namespace {

struct Performer {
  Game& game;
  Camera& camera;

  void operator()(const Walk& walk) const { game.walk({walk.x, 0, walk.z}); }
  void operator()(const Jump&) const { game.jump(); }
  void operator()(const Press& press) const { game.grab(camera.ray(press.x, press.y)); }
  void operator()(const Point& point) const { game.drag(camera.ray(point.x, point.y)); }
  void operator()(const Release&) const { game.release(); }
  void operator()(const SwitchTo& to) const {
    if (to.engine.empty())
      game.switch_to_next();
    else
      game.switch_to(to.engine);
  }
  void operator()(const Turn& turn) const { camera.turn(turn.yaw, turn.pitch); }
  void operator()(const Zoom& zoom) const { camera.zoom(zoom.factor); }
};

}  // namespace

void perform(const Action& action, Game& game, Camera& camera) { std::visit(Performer{game, camera}, action); }

}  // namespace plumb::ogre
