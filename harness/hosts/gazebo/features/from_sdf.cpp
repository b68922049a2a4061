#include "hosts/gazebo/features/from_sdf.hpp"

#include <sdf/Model.hh>
#include <sdf/World.hh>

#include "hosts/gazebo/features/listed.hpp"
#include "hosts/gazebo/sdf/read.hpp"
#include "hosts/gazebo/world/console.hpp"

namespace plumb::gazebo {
namespace {

/// "arm::hand" is the link hand of the nested model arm.
Link* link_named(const Model& model, const std::string& name) {
  const std::size_t colons = name.find("::");
  if (colons == std::string::npos) return named(&model.links, name);
  const Model* nested = named(&model.models, name.substr(0, colons));
  return nested != nullptr ? link_named(*nested, name.substr(colons + 2)) : nullptr;
}

}  // namespace

Model& SdfFeatures::make(World& world, Model* parent, const sdf::Model& said) {
  Model& model = add_model(world, parent, said.Name());
  model.is_static = said.Static();
  model.self_collide = said.SelfCollide();
  model.canonical = said.CanonicalLinkName();
  const Placement pose = pose_of(said.SemanticPose());
  model.pose = parent != nullptr ? parent->world_pose() * pose : pose;
  for (std::uint64_t i = 0; i < said.ModelCount(); ++i) make(world, &model, *said.ModelByIndex(i));
  for (std::uint64_t i = 0; i < said.LinkCount(); ++i) make(model, *said.LinkByIndex(i));
  for (std::uint64_t i = 0; i < said.JointCount(); ++i) make(model, *said.JointByIndex(i));
  return model;
}

Link* SdfFeatures::make(Model& model, const sdf::Link& said) {
  const Placement pose = pose_of(said.SemanticPose());
  const std::string fault = !pose.IsFinite() ? "its pose is not finite"
                            : model.stands() ? ""
                                             : fault_of(said.Inertial());
  if (!fault.empty()) {
    complain("link [" + said.Name() + "] of model [" + model.name + "] is left out: " + fault);
    return nullptr;
  }
  Link& link = add_link(model, said.Name(), model.world_pose() * pose);
  link.inertial = said.Inertial();
  link.gravity = gravity_of(said);
  for (std::uint64_t i = 0; i < said.CollisionCount(); ++i) make(link, *said.CollisionByIndex(i));
  return &link;
}

Shape* SdfFeatures::make(Link& link, const sdf::Collision& said) {
  std::optional<Geometry> geometry = read_geometry(said);
  if (!geometry) return nullptr;
  Shape* shape = add_shape(link, said.Name(), pose_of(said.SemanticPose()), std::move(*geometry));
  if (shape == nullptr) return nullptr;
  const Surface surface = surface_of(said);
  shape->friction = surface.friction;
  shape->restitution = surface.restitution;
  shape->mask = surface.mask;
  return shape;
}

Joint* SdfFeatures::make(Model& model, const sdf::Joint& said) {
  std::string parent_name, child_name;
  if (!said.ResolveParentLink(parent_name).empty()) parent_name = said.ParentLinkName();
  if (!said.ResolveChildLink(child_name).empty()) child_name = said.ChildLinkName();
  Link* child = link_named(model, child_name);
  Link* parent = parent_name == "world" ? nullptr : link_named(model, parent_name);
  if (child == nullptr || (parent == nullptr && parent_name != "world") || child == parent) {
    complain("joint [" + said.Name() + "] of model [" + model.name + "] is left out: it joins [" + parent_name +
             "] with [" + child_name + "], and both must be links of the model, the first one may be \"world\"");
    return nullptr;
  }
  std::optional<Joint> joint = read_joint(said, child->pose.Rot().Inverse() * model.world_pose().Rot());
  if (!joint) return nullptr;
  joint->child = child;
  joint->parent = parent;
  const Placement frame = child->pose * joint->in_child;
  joint->in_parent = parent != nullptr ? parent->pose.Inverse() * frame : frame;
  return add_joint(model, std::move(*joint));
}

Identity SdfFeatures::ConstructSdfWorld(const Identity& /*engine*/, const sdf::World& said) {
  World* world = add_world(said.Name());
  if (world == nullptr) return GenerateInvalidId();
  if (said.Gravity().IsFinite())
    world->set_gravity(said.Gravity());
  else
    complain("the gravity of world [" + said.Name() + "] is not finite; it is left as it is");
  for (std::uint64_t i = 0; i < said.ModelCount(); ++i) make(*world, nullptr, *said.ModelByIndex(i));
  return identity_of(world);
}

Identity SdfFeatures::ConstructSdfModel(const Identity& world, const sdf::Model& model) {
  return ConstructSdfNestedModel(world, model);
}

Identity SdfFeatures::ConstructSdfNestedModel(const Identity& parent, const sdf::Model& said) {
  if (Model* model = model_of(parent)) return identity_of(&make(*model->world, model, said));
  if (World* world = world_of(parent)) return identity_of(&make(*world, nullptr, said));
  complain("model [" + said.Name() + "] is left out: what it was to be in is gone");
  return GenerateInvalidId();
}

Identity SdfFeatures::ConstructSdfLink(const Identity& id, const sdf::Link& said) {
  Model* model = model_of(id);
  if (model != nullptr) return identity_of(make(*model, said));
  complain("link [" + said.Name() + "] is left out: its model is gone");
  return GenerateInvalidId();
}

Identity SdfFeatures::ConstructSdfCollision(const Identity& id, const sdf::Collision& said) {
  Link* link = link_of(id);
  if (link != nullptr) return identity_of(make(*link, said));
  complain("collision [" + said.Name() + "] is left out: its link is gone");
  return GenerateInvalidId();
}

Identity SdfFeatures::ConstructSdfJoint(const Identity& id, const sdf::Joint& said) {
  Model* model = model_of(id);
  if (model != nullptr) return identity_of(make(*model, said));
  complain("joint [" + said.Name() + "] is left out: its model is gone");
  return GenerateInvalidId();
}

}  // namespace plumb::gazebo
