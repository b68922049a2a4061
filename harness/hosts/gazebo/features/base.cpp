#include "hosts/gazebo/features/base.hpp"

#include <algorithm>

#include "hosts/gazebo/world/console.hpp"
#include "hosts/gazebo/world/groups.hpp"

namespace plumb::gazebo {
namespace {

PlumbJointType type_of(JointKind kind) {
  constexpr PlumbJointType kTypes[] = {PLUMB_JOINT_FIXED, PLUMB_JOINT_HINGE, PLUMB_JOINT_SLIDER, PLUMB_JOINT_BALL,
                                       PLUMB_JOINT_UNIVERSAL};
  return kTypes[static_cast<std::size_t>(kind)];
}

}  // namespace

World* Base::add_world(const std::string& name) {
  try {
    worlds_.push_back(std::make_unique<World>(next_id_, name, default_engine()));
  } catch (const Error& error) {
    complain("there is no world [" + name + "]: " + error.what());
    return nullptr;
  }
  World* world = worlds_.back().get();
  worlds_by_id_[next_id_++] = world;
  return world;
}

Model& Base::add_model(World& world, Model* parent, const std::string& name) {
  auto& models = parent != nullptr ? parent->models : world.models;
  models.push_back(std::make_unique<Model>());
  Model& model = *models.back();
  model.id = next_id_++;
  model.group = next_id_++;
  model.name = name;
  model.world = &world;
  model.parent = parent;
  models_[model.id] = &model;
  groups_[model.group] = &model;
  return model;
}

Link& Base::add_link(Model& model, const std::string& name, const Placement& pose) {
  model.links.push_back(std::make_unique<Link>());
  Link& link = *model.links.back();
  link.id = next_id_++;
  link.name = name;
  link.model = &model;
  link.pose = pose;
  link.inertial = ignition::math::Inertiald({1, Vector::One, Vector::Zero}, Placement::Zero);
  if (name == model.canonical || (model.canonical.empty() && model.carrier == nullptr)) {
    model.pose = pose.Inverse() * model.world_pose();
    model.carrier = &link;
  }
  links_[link.id] = &link;
  model.world->rebuild(link);
  return link;
}

Shape* Base::add_shape(Link& link, const std::string& name, const Placement& pose, Geometry geometry) {
  const std::string what = "collision [" + name + "] of link [" + link.name + "]";
  std::string fault = pose.IsFinite() ? fault_of(geometry) : "its pose is not finite";
  const PlumbMotion motion = motion_of(link);
  const World& world = *link.model->world;
  if (fault.empty() && geometry.form == Form::plane && motion == PLUMB_DYNAMIC)
    fault = "a plane cannot move; make the model static, or use a box";
  const PlumbShapeType shape_type = type_of(geometry, motion);
  if (fault.empty() && world.backend().capability(PLUMB_CAP_SHAPE, shape_type, motion) == PLUMB_NONE)
    fault = "the backend " + world.engine() +
            " has no such shape: " + world.backend().capability_note(PLUMB_CAP_SHAPE, shape_type, motion);
  if (!fault.empty()) {
    complain(what + " is left out: " + fault);
    return nullptr;
  }
  link.shapes.push_back(std::make_unique<Shape>());
  Shape& shape = *link.shapes.back();
  shape.id = next_id_++;
  shape.name = name;
  shape.link = &link;
  shape.pose = pose;
  shape.geometry = std::move(geometry);
  shapes_[shape.id] = &shape;
  link.model->world->rebuild(link);
  return &shape;
}

Joint* Base::add_joint(Model& model, Joint record) {
  World& world = *model.world;
  const PlumbJointType joint_type = type_of(record.kind);
  if (world.backend().capability(PLUMB_CAP_JOINT, joint_type) == PLUMB_NONE) {
    complain("joint [" + record.name + "] of model [" + model.name + "] is left out: the backend " + world.engine() +
             " has no such joint: " + world.backend().capability_note(PLUMB_CAP_JOINT, joint_type));
    return nullptr;
  }
  model.joints.push_back(std::make_unique<Joint>(std::move(record)));
  Joint& joint = *model.joints.back();
  joint.id = next_id_++;
  joint.model = &model;
  joints_[joint.id] = &joint;
  joint.child->joints.push_back(&joint);
  if (joint.parent != nullptr) joint.parent->joints.push_back(&joint);
  refresh(joint);
  world.rebuild(joint);
  return &joint;
}

void Base::forget(Model& model) {
  for (const auto& nested : model.models) forget(*nested);
  for (const auto& joint : model.joints) {
    model.world->forget(*joint);
    joints_.erase(joint->id);
  }
  for (const auto& link : model.links) {
    model.world->forget(*link);
    for (const auto& shape : link->shapes) shapes_.erase(shape->id);
    links_.erase(link->id);
  }
  models_.erase(model.id);
  groups_.erase(model.group);
}

void Base::remove(Model& model) {
  forget(model);
  auto& siblings = model.parent != nullptr ? model.parent->models : model.world->models;
  std::erase_if(siblings, [&](const auto& other) { return other.get() == &model; });
}

}  // namespace plumb::gazebo
