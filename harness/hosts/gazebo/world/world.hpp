// A world of Gazebo over a world of Plumb. Entities are records that may change at any time; before a step bodies and
// joints of the engine are made, or made anew, from those that did.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "hosts/gazebo/world/engine.hpp"
#include "hosts/gazebo/world/entities.hpp"

namespace plumb::gazebo {

/// Two shapes of this world that touched in the last step.
struct Touch {
  const Shape* first = nullptr;
  const Shape* second = nullptr;
  Vector point;
  Vector normal;  ///< unit, towards the first
  Vector force;   ///< N, on the first, mean of the step; NaN where the engine does not tell
  double depth = 0;
};

class World {
 public:
  /// Throws Error where the backend cannot be opened.
  World(std::size_t number, const std::string& called, const std::string& engine);
  ~World();

  [[nodiscard]] std::size_t id() const { return id_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  std::vector<std::unique_ptr<Model>> models;

  /// Another backend from the next step on; bodies go on as they move. Throws Error and keeps the old one.
  void use_engine(const std::string& engine);
  [[nodiscard]] const std::string& engine() const { return engine_; }
  [[nodiscard]] const Backend& backend() const { return backend_; }

  [[nodiscard]] const Vector& gravity() const { return gravity_; }
  void set_gravity(const Vector& gravity);  ///< stays, with a sentence, where the engine fails

  /// The record changed in a way of which the engine knows nothing yet: shapes, mass, motion of a link; frames, limits
  /// of a joint.
  void rebuild(Link& link);
  void rebuild(Joint& joint);
  /// Before a record goes: nothing of the engine points to it any more.
  void forget(Link& link);
  void forget(Joint& joint);

  /// Throws Error when the engine fails.
  void step(double dt);
  [[nodiscard]] std::vector<Touch> touches();  ///< Throws Error likewise.
  /// Force and torque of the parent on the child at its frame, world axes; false where the engine does not tell.
  bool reaction(Joint& joint, Vector& force, Vector& torque);

  /// Every link, in order of creation within its model.
  template <class Action>
  void for_each_link(Action&& action) {
    for (const auto& model : models) for_each_link(*model, action);
  }
  template <class Action>
  static void for_each_link(Model& model, Action&& action) {
    for (const auto& link : model.links) action(*link);
    for (const auto& nested : model.models) for_each_link(*nested, action);
  }
  template <class Action>
  void for_each_joint(Action&& action) {
    for (const auto& model : models) for_each_joint(*model, action);
  }
  template <class Action>
  static void for_each_joint(Model& model, Action&& action) {
    for (const auto& joint : model.joints) action(*joint);
    for (const auto& nested : model.models) for_each_joint(*nested, action);
  }

 private:
  /// Whether a call of the engine was answered; else says why not, for Gazebo knows no failure there.
  bool report(PlumbResult result);
  void build();
  void build_link(Link& link);
  void build_joint(Joint& joint);
  Part add_part(Link& link, std::span<Shape* const> shapes);
  void remove_parts(Link& link);
  void remove_joint(Joint& joint);
  void place();
  void drive(double dt);
  void read(double dt);
  void write(PlumbField field, const std::vector<PlumbBody>& bodies, const std::vector<double>& rows);

  std::size_t id_;
  std::string name_;
  std::string engine_;
  Backend backend_;
  PlumbNeeds needs_ = 0;
  Vector gravity_{0, 0, -9.80665};
  std::unique_ptr<IPhysicsWorld> physics_;
  bool changed_ = true;
  double dt_ = 0;
  std::unordered_map<PlumbBody, std::pair<Link*, std::size_t>> owners_;  ///< link and part
  std::vector<Link*> moving_;
  std::vector<PlumbBody> moving_bodies_;
};

}  // namespace plumb::gazebo
