#include "hosts/gazebo/features/entities.hpp"

#include "hosts/gazebo/features/listed.hpp"

namespace plumb::gazebo {
namespace {

const std::string kNothing;

const std::string& called(const auto* entity) { return entity != nullptr ? name_of(*entity) : kNothing; }

const Listed<Model>* models_of(const World* world) { return world != nullptr ? &world->models : nullptr; }
const Listed<Model>* models_of(const Model* model) { return model != nullptr ? &model->models : nullptr; }
const Listed<Link>* links_of(const Model* model) { return model != nullptr ? &model->links : nullptr; }
const Listed<Joint>* joints_of(const Model* model) { return model != nullptr ? &model->joints : nullptr; }
const Listed<Shape>* shapes_of(const Link* link) { return link != nullptr ? &link->shapes : nullptr; }

const Listed<Model>* siblings_of(const Model* model) {
  if (model == nullptr) return nullptr;
  return model->parent != nullptr ? &model->parent->models : &model->world->models;
}

}  // namespace

const std::string& EntityFeatures::GetEngineName(const Identity& /*engine*/) const {
  static const std::string name = "plumb";
  return name;
}
std::size_t EntityFeatures::GetEngineIndex(const Identity& /*engine*/) const { return 0; }

std::size_t EntityFeatures::GetWorldCount(const Identity& /*engine*/) const { return worlds_.size(); }
Identity EntityFeatures::GetWorld(const Identity& /*engine*/, std::size_t index) const {
  return identity_of(at(&worlds_, index));
}
Identity EntityFeatures::GetWorld(const Identity& /*engine*/, const std::string& name) const {
  return identity_of(named(&worlds_, name));
}
const std::string& EntityFeatures::GetWorldName(const Identity& world) const { return called(world_of(world)); }
std::size_t EntityFeatures::GetWorldIndex(const Identity& world) const {
  return index_in<World>(&worlds_, world_of(world));
}
Identity EntityFeatures::GetEngineOfWorld(const Identity& /*world*/) const { return GenerateIdentity(0); }

std::size_t EntityFeatures::GetModelCount(const Identity& world) const { return count(models_of(world_of(world))); }
Identity EntityFeatures::GetModel(const Identity& world, std::size_t index) const {
  return identity_of(at(models_of(world_of(world)), index));
}
Identity EntityFeatures::GetModel(const Identity& world, const std::string& name) const {
  return identity_of(named(models_of(world_of(world)), name));
}
const std::string& EntityFeatures::GetModelName(const Identity& model) const { return called(model_of(model)); }
std::size_t EntityFeatures::GetModelIndex(const Identity& model) const {
  return index_in<Model>(siblings_of(model_of(model)), model_of(model));
}
Identity EntityFeatures::GetWorldOfModel(const Identity& model) const {
  const Model* found = model_of(model);
  return identity_of(found != nullptr ? found->world : nullptr);
}

std::size_t EntityFeatures::GetNestedModelCount(const Identity& model) const {
  return count(models_of(model_of(model)));
}
Identity EntityFeatures::GetNestedModel(const Identity& model, std::size_t index) const {
  return identity_of(at(models_of(model_of(model)), index));
}
Identity EntityFeatures::GetNestedModel(const Identity& model, const std::string& name) const {
  return identity_of(named(models_of(model_of(model)), name));
}

std::size_t EntityFeatures::GetLinkCount(const Identity& model) const { return count(links_of(model_of(model))); }
Identity EntityFeatures::GetLink(const Identity& model, std::size_t index) const {
  return identity_of(at(links_of(model_of(model)), index));
}
Identity EntityFeatures::GetLink(const Identity& model, const std::string& name) const {
  return identity_of(named(links_of(model_of(model)), name));
}
const std::string& EntityFeatures::GetLinkName(const Identity& link) const { return called(link_of(link)); }
std::size_t EntityFeatures::GetLinkIndex(const Identity& link) const {
  const Link* found = link_of(link);
  return index_in<Link>(found != nullptr ? &found->model->links : nullptr, found);
}
Identity EntityFeatures::GetModelOfLink(const Identity& link) const {
  const Link* found = link_of(link);
  return identity_of(found != nullptr ? found->model : nullptr);
}

std::size_t EntityFeatures::GetJointCount(const Identity& model) const { return count(joints_of(model_of(model))); }
Identity EntityFeatures::GetJoint(const Identity& model, std::size_t index) const {
  return identity_of(at(joints_of(model_of(model)), index));
}
Identity EntityFeatures::GetJoint(const Identity& model, const std::string& name) const {
  return identity_of(named(joints_of(model_of(model)), name));
}
const std::string& EntityFeatures::GetJointName(const Identity& joint) const { return called(joint_of(joint)); }
std::size_t EntityFeatures::GetJointIndex(const Identity& joint) const {
  const Joint* found = joint_of(joint);
  return index_in<Joint>(found != nullptr ? &found->model->joints : nullptr, found);
}
Identity EntityFeatures::GetModelOfJoint(const Identity& joint) const {
  const Joint* found = joint_of(joint);
  return identity_of(found != nullptr ? found->model : nullptr);
}

std::size_t EntityFeatures::GetShapeCount(const Identity& link) const { return count(shapes_of(link_of(link))); }
Identity EntityFeatures::GetShape(const Identity& link, std::size_t index) const {
  return identity_of(at(shapes_of(link_of(link)), index));
}
Identity EntityFeatures::GetShape(const Identity& link, const std::string& name) const {
  return identity_of(named(shapes_of(link_of(link)), name));
}
const std::string& EntityFeatures::GetShapeName(const Identity& shape) const { return called(shape_of(shape)); }
std::size_t EntityFeatures::GetShapeIndex(const Identity& shape) const {
  const Shape* found = shape_of(shape);
  return index_in<Shape>(found != nullptr ? &found->link->shapes : nullptr, found);
}
Identity EntityFeatures::GetLinkOfShape(const Identity& shape) const {
  const Shape* found = shape_of(shape);
  return identity_of(found != nullptr ? found->link : nullptr);
}

bool EntityFeatures::RemoveModelByIndex(const Identity& world, std::size_t index) {
  Model* model = at(models_of(world_of(world)), index);
  if (model != nullptr) remove(*model);
  return model != nullptr;
}
bool EntityFeatures::RemoveModelByName(const Identity& world, const std::string& name) {
  Model* model = named(models_of(world_of(world)), name);
  if (model != nullptr) remove(*model);
  return model != nullptr;
}
bool EntityFeatures::RemoveModel(const Identity& model) {
  Model* found = model_of(model);
  if (found != nullptr) remove(*found);
  return found != nullptr;
}
bool EntityFeatures::ModelRemoved(const Identity& model) const { return model_of(model) == nullptr; }
bool EntityFeatures::RemoveNestedModelByIndex(const Identity& model, std::size_t index) {
  Model* nested = at(models_of(model_of(model)), index);
  if (nested != nullptr) remove(*nested);
  return nested != nullptr;
}
bool EntityFeatures::RemoveNestedModelByName(const Identity& model, const std::string& name) {
  Model* nested = named(models_of(model_of(model)), name);
  if (nested != nullptr) remove(*nested);
  return nested != nullptr;
}

Identity EntityFeatures::ConstructEmptyWorld(const Identity& /*engine*/, const std::string& name) {
  return identity_of(add_world(name));
}
Identity EntityFeatures::ConstructEmptyModel(const Identity& world, const std::string& name) {
  World* found = world_of(world);
  return identity_of(found != nullptr ? &add_model(*found, nullptr, name) : nullptr);
}
Identity EntityFeatures::ConstructEmptyNestedModel(const Identity& model, const std::string& name) {
  Model* found = model_of(model);
  if (found == nullptr) return GenerateInvalidId();
  Model& nested = add_model(*found->world, found, name);
  nested.pose = found->world_pose();
  return identity_of(&nested);
}
Identity EntityFeatures::ConstructEmptyLink(const Identity& model, const std::string& name) {
  Model* found = model_of(model);
  return identity_of(found != nullptr ? &add_link(*found, name, found->world_pose()) : nullptr);
}

}  // namespace plumb::gazebo
