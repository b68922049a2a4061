// What all features share: the entities, by the numbers under which Gazebo knows them.
#pragma once

#include <ignition/physics/Implements.hh>
#include <memory>
#include <unordered_map>
#include <vector>

#include "hosts/gazebo/world/world.hpp"

namespace plumb::gazebo {

namespace physics = ignition::physics;
using physics::Identity;

class Base : public physics::Implements3d<physics::FeatureList<physics::Feature>> {
 public:
  Identity InitiateEngine(std::size_t /*engine*/) override { return GenerateIdentity(0); }

 protected:
  /// Null for what was removed, or is of another kind.
  [[nodiscard]] World* world_of(std::size_t id) const { return find(worlds_by_id_, id); }
  [[nodiscard]] Model* model_of(std::size_t id) const { return find(models_, id); }
  /// By the number of its links as one free group.
  [[nodiscard]] Model* group_of(std::size_t id) const { return find(groups_, id); }
  [[nodiscard]] Link* link_of(std::size_t id) const { return find(links_, id); }
  [[nodiscard]] Joint* joint_of(std::size_t id) const { return find(joints_, id); }
  [[nodiscard]] Shape* shape_of(std::size_t id) const { return find(shapes_, id); }

  /// Invalid for null.
  template <class Entity>
  [[nodiscard]] Identity identity_of(const Entity* entity) const {
    return entity != nullptr ? GenerateIdentity(entity->id) : GenerateInvalidId();
  }
  [[nodiscard]] Identity identity_of(const World* world) const {
    return world != nullptr ? GenerateIdentity(world->id()) : GenerateInvalidId();
  }

  /// Null, with a sentence on the console, where the engine is not there.
  World* add_world(const std::string& name);
  /// In the world itself where parent is null.
  Model& add_model(World& world, Model* parent, const std::string& name);
  Link& add_link(Model& model, const std::string& name, const Placement& pose);
  /// Null, with a sentence on the console, where the engine or Plumb cannot have it.
  Shape* add_shape(Link& link, const std::string& name, const Placement& pose, Geometry geometry);
  /// Frames and axes as the record says; its links are as they are at its zero.
  Joint* add_joint(Model& model, Joint joint);
  void remove(Model& model);

  std::vector<std::unique_ptr<World>> worlds_;

 private:
  template <class Entity>
  static Entity* find(const std::unordered_map<std::size_t, Entity*>& entities, std::size_t id) {
    const auto found = entities.find(id);
    return found != entities.end() ? found->second : nullptr;
  }
  void forget(Model& model);

  std::size_t next_id_ = 1;  // 0 is the engine
  std::unordered_map<std::size_t, World*> worlds_by_id_;
  std::unordered_map<std::size_t, Model*> models_;
  std::unordered_map<std::size_t, Model*> groups_;
  std::unordered_map<std::size_t, Link*> links_;
  std::unordered_map<std::size_t, Joint*> joints_;
  std::unordered_map<std::size_t, Shape*> shapes_;
};

}  // namespace plumb::gazebo
