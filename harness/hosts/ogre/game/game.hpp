// The game: a scene, the stage on which it is played, and what the player does. It outlives the engines below.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hosts/ogre/game/stage.hpp"

namespace plumb::ogre {

/// A change of engines that was done, and what the new engine made of what it was given.
struct Switch {
  double time = 0;  ///< s of the game
  std::string from, to;
  std::size_t bodies = 0;     ///< alive after it
  double position_error = 0;  ///< m, the largest
  double velocity_error = 0;  ///< m/s or rad/s, the largest
};

/// A sentence for the player.
struct Notice {
  std::string text;
  double time = 0;  ///< s of the game, when it was said
};

/// What was picked up last.
struct Picked {
  std::size_t thing = 0;
  PlumbVec3 from{};  ///< where it was then, m
  double moved = 0;  ///< m from there, the furthest while it was held
};

class Game {
 public:
  /// Throws Error with the loader's or the engine's sentence.
  explicit Game(const std::string& engine);
  Game(const Game&) = delete;
  Game& operator=(const Game&) = delete;

  void advance(double frame_time);

  void walk(const PlumbVec3& velocity) { steering_.walk = velocity; }
  void jump() { steering_.jump = kJump; }
  void grab(const Ray& ray);
  /// What is held goes along the ray, as far away as it was.
  void drag(const Ray& ray);
  void release() { stage_->release(); }

  /// The running game goes on in another engine; false: it goes on in this one, and a notice says why.
  bool switch_to(const std::string& engine);
  /// To the next of those that are installed, past one that was tried and refused.
  bool switch_to_next();

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] Stage& stage() { return *stage_; }
  [[nodiscard]] const Stage& stage() const { return *stage_; }
  [[nodiscard]] std::string engine() const { return stage_->engine().name; }
  [[nodiscard]] const std::vector<Switch>& switches() const { return switches_; }
  /// Also of switches that were refused.
  [[nodiscard]] const std::vector<Notice>& notices() const { return notices_; }
  [[nodiscard]] const std::optional<Picked>& picked() const { return picked_; }

  static constexpr double kWalk = 3;  ///< m/s
  static constexpr double kJump = 5;  ///< m/s

 private:
  Scene scene_;
  std::unique_ptr<Stage> stage_;
  Steering steering_;
  std::optional<Picked> picked_;
  double reach_ = 0;        // m along the ray to what is held
  std::string last_tried_;  // engine
  std::vector<Switch> switches_;
  std::vector<Notice> notices_;
};

}  // namespace plumb::ogre
