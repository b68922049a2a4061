#include "hosts/gazebo/features/free_groups.hpp"

#include "hosts/gazebo/features/eigen.hpp"
#include "hosts/gazebo/world/console.hpp"
#include "hosts/gazebo/world/groups.hpp"

namespace plumb::gazebo {

Identity FreeGroupFeatures::FindFreeGroupForModel(const Identity& id) const {
  Model* model = model_of(id);
  bool held = false;
  if (model == nullptr || links_as_one(*model, &held).empty() || held) return GenerateInvalidId();
  return GenerateIdentity(model->group);
}

Identity FreeGroupFeatures::FindFreeGroupForLink(const Identity& id) const {
  Link* link = link_of(id);
  bool held = false;
  if (link == nullptr || connected(*link, nullptr, &held).empty() || held) return GenerateInvalidId();
  return identity_of(root_of(*link));
}

Link* FreeGroupFeatures::root(std::size_t group) const {
  if (Model* model = group_of(group)) return root_of(*model);
  return link_of(group);
}

std::vector<Link*> FreeGroupFeatures::links(std::size_t group) const {
  if (Model* model = group_of(group)) return links_as_one(*model);
  Link* link = link_of(group);
  return link != nullptr ? connected(*link) : std::vector<Link*>();
}

Identity FreeGroupFeatures::GetFreeGroupRootLink(const Identity& group) const { return identity_of(root(group)); }

void FreeGroupFeatures::SetFreeGroupWorldPose(const Identity& group, const PoseType& pose) {
  const Link* first = root(group);
  if (first == nullptr) return complain("a free group that is not there was to be placed");
  if (!pose.matrix().allFinite())
    return complain("the free group of link [" + first->name + "] stays: its pose must be finite");
  carry(links(group), from_eigen(pose) * first->pose.Inverse(), nullptr);
}

void FreeGroupFeatures::SetFreeGroupWorldLinearVelocity(const Identity& group, const LinearVelocity& velocity) {
  const Link* first = root(group);
  if (first == nullptr) return complain("a free group that is not there was to be moved");
  if (!velocity.allFinite())
    return complain("the free group of link [" + first->name + "] moves on: its velocity must be finite");
  const Vector change = from_eigen(velocity) - first->velocity_at(first->pose.Pos());
  for (Link* link : links(group)) {
    link->velocity += change;
    link->moved = true;
  }
}

void FreeGroupFeatures::SetFreeGroupWorldAngularVelocity(const Identity& group, const AngularVelocity& velocity) {
  const Link* first = root(group);
  if (first == nullptr) return complain("a free group that is not there was to be turned");
  if (!velocity.allFinite())
    return complain("the free group of link [" + first->name + "] moves on: its angular velocity must be finite");
  const Vector change = from_eigen(velocity) - first->spin, about = first->pose.Pos();
  for (Link* link : links(group)) {
    link->spin += change;
    link->velocity += change.Cross(link->centre() - about);
    link->moved = true;
  }
}

}  // namespace plumb::gazebo
