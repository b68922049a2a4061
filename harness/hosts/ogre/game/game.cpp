#include "hosts/ogre/game/game.hpp"

#include <algorithm>

#include "hosts/ogre/game/vectors.hpp"

namespace plumb::ogre {

Game::Game(const std::string& engine)
    : scene_(make_scene()), stage_(std::make_unique<Stage>(engine, scene_, beginning(scene_))), last_tried_(engine) {}

void Game::advance(double frame_time) {
  stage_->advance(frame_time, steering_);
  if (!stage_->hold()) return;
  const PlumbVec3& now = stage_->poses()[picked_->thing].position;
  picked_->moved = std::max(picked_->moved, distance(picked_->from, now));
}

void Game::grab(const Ray& ray) {
  const auto reach = stage_->grab(ray);
  if (!reach) return;
  reach_ = *reach;
  const std::size_t thing = stage_->hold()->thing;
  picked_ = Picked{thing, stage_->poses()[thing].position, 0};
}

void Game::drag(const Ray& ray) { stage_->drag(add(ray.origin, scale(reach_, ray.direction))); }

bool Game::switch_to(const std::string& engine) {
  last_tried_ = engine;
  const Moment before = stage_->moment();
  std::unique_ptr<Stage> next;
  try {
    next = std::make_unique<Stage>(engine, scene_, before);
  } catch (const Error& error) {
    notices_.push_back(
        {"The game stays in " + this->engine() + ", as " + engine + " cannot take it: " + error.what(), before.time});
    return false;
  }
  const Moment after = next->moment();
  Switch done{before.time, this->engine(), next->engine().name, next->things_alive(), 0, 0};
  for (std::size_t i = 0; i < scene_.things.size(); ++i) {
    done.position_error = std::max(done.position_error, distance(before.poses[i].position, after.poses[i].position));
    if (scene_.things[i].body.motion != PLUMB_DYNAMIC) continue;
    done.velocity_error =
        std::max({done.velocity_error, distance(before.velocities[i].linear, after.velocities[i].linear),
                  distance(before.velocities[i].angular, after.velocities[i].angular)});
  }
  notices_.push_back(
      {"The game goes on in " + done.to + ", with all of " + std::to_string(done.bodies) + " bodies.", before.time});
  switches_.push_back(done);
  stage_ = std::move(next);
  return true;
}

bool Game::switch_to_next() {
  const std::vector<FoundBackend> found = find_backends();
  const auto tried = std::find_if(found.begin(), found.end(), [&](const auto& one) { return one.name == last_tried_; });
  const std::size_t at = tried == found.end() ? found.size() - 1 : static_cast<std::size_t>(tried - found.begin());
  for (std::size_t i = 1; i <= found.size(); ++i) {
    const std::string& name = found[(at + i) % found.size()].name;
    if (name != engine()) return switch_to(name);
  }
  notices_.push_back({"There is no other engine than " + engine() + ": set PLUMB_BACKEND_PATH to a folder with more.",
                      stage_->time()});
  return false;
}

}  // namespace plumb::ogre
