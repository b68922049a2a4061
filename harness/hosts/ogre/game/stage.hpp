// All of the game that lives in an engine: a world, its bodies, who walks in it and what is held. It can be told as a
// moment, which knows no engine, and be made of one: that is how a running game changes engines.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hosts/ogre/game/camera.hpp"
#include "hosts/ogre/game/hand.hpp"
#include "hosts/ogre/game/scene.hpp"
#include "plumb/helpers/character_controller.hpp"
#include "plumb/helpers/fixed_step.hpp"
#include "plumb/loader.hpp"

namespace plumb::ogre {

struct Velocity {
  PlumbVec3 linear{}, angular{};
};

struct Hold {
  std::size_t thing = 0;
  PlumbVec3 at{};      ///< in its frame
  PlumbVec3 target{};  ///< where the hand goes, world
};

/// It climbs what is lower than a box, which it pushes.
constexpr helpers::CharacterSettings kCharacter{.step_up = 0.2};

/// The game between two steps, in no engine's terms.
struct Moment {
  double time = 0;     ///< s of the game
  double pending = 0;  ///< s of the last frame that no step has taken yet
  std::vector<PlumbPose> poses;
  std::vector<Velocity> velocities;
  PlumbVec3 character{}, character_velocity{};
  std::optional<Hold> hold;
};

/// How a scene begins.
[[nodiscard]] Moment beginning(const Scene& scene);

struct Steering {
  PlumbVec3 walk{};  ///< m/s
  double jump = 0;   ///< m/s upwards, spent by the next step
};

class Stage {
 public:
  static constexpr PlumbNeeds needs = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                                      helpers::CharacterController::needs | helpers::FixedStep::needs | Hand::needs;
  static constexpr double dt = 1.0 / 60;  ///< s

  /// engine: a name or a file. scene outlives this. Throws Error with a sentence when the engine is not there, cannot
  /// be opened beside another, or lacks what the game needs.
  Stage(const std::string& engine, const Scene& scene, const Moment& moment);

  [[nodiscard]] const PlumbBackendInfo& engine() const { return backend_.info(); }
  [[nodiscard]] IPhysicsWorld& world() { return *world_; }
  [[nodiscard]] Moment moment();

  void advance(double frame_time, Steering& steering);

  /// The first thing on the ray that can be moved is held where the ray meets it. How far away that is, m; none: air,
  /// or something that stands fast.
  std::optional<double> grab(const Ray& ray);
  /// Where what is held goes.
  void drag(const PlumbVec3& target);
  void release();
  [[nodiscard]] const std::optional<Hold>& hold() const { return hold_; }

  // At the time of the last frame, blended between the last two steps.
  [[nodiscard]] std::span<const PlumbPose> poses() const { return steps_->poses(); }
  [[nodiscard]] PlumbVec3 character() const;

  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] std::size_t things_alive() const;
  /// Which thing the character stands on.
  [[nodiscard]] std::optional<std::size_t> ground() const;
  [[nodiscard]] const helpers::CharacterController& walker() const { return *walker_; }

 private:
  void create_bodies(const Moment& moment);
  void drive(double dt, Steering& steering);
  [[nodiscard]] std::optional<std::size_t> thing_of(PlumbBody body) const;

  const Scene& scene_;
  Backend backend_;
  std::unique_ptr<IPhysicsWorld> world_;
  std::vector<PlumbBody> bodies_;  // of the scene's things, in their order
  std::optional<helpers::FixedStep> steps_;
  std::optional<helpers::CharacterController> walker_;
  PlumbVec3 walker_before_{};  // a step ago
  std::optional<Hand> hand_;
  std::optional<Hold> hold_;
  double time_ = 0;
  double alpha_ = 0;  // where the last frame lies between the last two steps
};

}  // namespace plumb::ogre
