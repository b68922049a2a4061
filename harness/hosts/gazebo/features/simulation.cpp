#include "hosts/gazebo/features/simulation.hpp"

#include <chrono>

#include "hosts/gazebo/features/eigen.hpp"
#include "hosts/gazebo/world/console.hpp"
#include "hosts/gazebo/world/groups.hpp"

namespace plumb::gazebo {
namespace {

constexpr double kUsualStep = 0.001;  // s, as SDF has it

double step_of(const physics::ForwardStep::Input& input) {
  if (const auto* duration = input.Query<std::chrono::steady_clock::duration>(); duration != nullptr)
    return std::chrono::duration<double>(*duration).count();
  if (const auto* step = input.Query<physics::TimeStep>(); step != nullptr) return step->dt;
  return kUsualStep;
}

/// A host hears of what moved by more than this since it heard of it last.
bool same(const Placement& a, const Placement& b) {
  constexpr double kSame = 1e-6;
  return a.Pos().Equal(b.Pos(), kSame) && a.Rot().Equal(b.Rot(), kSame);
}

SimulationFeatures::FrameData frame_of(const Link& link, const Placement& offset) {
  SimulationFeatures::FrameData data;
  const Placement pose = link.pose * offset;
  const Vector arm = pose.Pos() - link.centre();
  data.pose = to_eigen(pose);
  data.linearVelocity = to_eigen(link.velocity_at(pose.Pos()));
  data.angularVelocity = to_eigen(link.spin);
  data.linearAcceleration =
      to_eigen(link.acceleration + link.spin_acceleration.Cross(arm) + link.spin.Cross(link.spin.Cross(arm)));
  data.angularAcceleration = to_eigen(link.spin_acceleration);
  return data;
}

}  // namespace

void SimulationFeatures::WorldForwardStep(const Identity& id, physics::ForwardStep::Output& output,
                                          physics::ForwardStep::State& /*state*/,
                                          const physics::ForwardStep::Input& input) {
  World* world = world_of(id);
  if (world == nullptr) return complain("a world that is not there was to be stepped");
  const double dt = step_of(input);
  if (!std::isfinite(dt) || dt <= 0)
    return complain("world [" + world->name() + "] was to step by " + std::to_string(dt) + " s; it must be above 0");
  try {
    world->step(dt);
  } catch (const Error& error) {
    return complain("world [" + world->name() + "] was not stepped: " + error.what());
  }
  auto& all = output.Get<physics::WorldPoses>().entries;
  auto& changed = output.Get<physics::ChangedWorldPoses>().entries;
  all.clear();
  changed.clear();
  world->for_each_link([&](Link& link) {
    all.push_back({link.pose, link.id});
    if (link.told && same(*link.told, link.pose)) return;
    link.told = link.pose;
    changed.push_back(all.back());
  });
}

std::vector<SimulationFeatures::ContactInternal> SimulationFeatures::GetContactsFromLastStep(const Identity& id) const {
  std::vector<ContactInternal> contacts;
  World* world = world_of(id);
  if (world == nullptr) return contacts;
  try {
    for (const Touch& touch : world->touches()) {
      physics::CompositeData more;
      auto& extra = more.Get<ExtraContactData>();
      extra.force = to_eigen(touch.force);
      extra.normal = to_eigen(touch.normal);
      extra.depth = touch.depth;
      contacts.push_back({identity_of(touch.first), identity_of(touch.second), to_eigen(touch.point), more});
    }
  } catch (const Error& error) {
    complain("world [" + world->name() + "] tells no contacts: " + error.what());
  }
  return contacts;
}

SimulationFeatures::FrameData SimulationFeatures::FrameDataRelativeToWorld(const physics::FrameID& id) const {
  if (const Link* link = link_of(id.ID())) return frame_of(*link, Placement::Zero);
  if (const Shape* shape = shape_of(id.ID())) return frame_of(*shape->link, shape->pose);
  if (const Joint* joint = joint_of(id.ID()); joint != nullptr && joint->child != nullptr)
    return frame_of(*joint->child, joint->in_child);
  if (Model* group = group_of(id.ID()); group != nullptr && root_of(*group) != nullptr)
    return frame_of(*root_of(*group), Placement::Zero);
  FrameData still;
  if (const Model* model = model_of(id.ID())) {
    if (model->carrier != nullptr) return frame_of(*model->carrier, model->pose);
    still.pose = to_eigen(model->pose);
  }
  return still;
}

void SimulationFeatures::AddLinkExternalForceInWorld(const Identity& id, const physics::LinearVector3d& force,
                                                     const physics::LinearVector3d& position) {
  Link* link = link_of(id);
  if (link == nullptr) return complain("a force was to act on a link that is not there");
  if (!force.allFinite() || !position.allFinite())
    return complain("a force on link [" + link->name + "] is left out: force and position must be finite");
  link->add_force(from_eigen(force), from_eigen(position));
}

void SimulationFeatures::AddLinkExternalTorqueInWorld(const Identity& id, const physics::AngularVector3d& torque) {
  Link* link = link_of(id);
  if (link == nullptr) return complain("a torque was to act on a link that is not there");
  if (!torque.allFinite()) return complain("a torque on link [" + link->name + "] is left out: it must be finite");
  link->torque += from_eigen(torque);
}

void SimulationFeatures::SetWorldGravity(const Identity& id, const physics::LinearVector3d& gravity) {
  World* world = world_of(id);
  if (world == nullptr) return complain("gravity was to be set of a world that is not there");
  if (!gravity.allFinite()) return complain("gravity of world [" + world->name() + "] stays: it must be finite");
  world->set_gravity(from_eigen(gravity));
}

physics::LinearVector3d SimulationFeatures::GetWorldGravity(const Identity& id) const {
  const World* world = world_of(id);
  return world != nullptr ? to_eigen(world->gravity()) : Eigen::Vector3d(0, 0, 0);
}

void SimulationFeatures::SetWorldSolver(const Identity& id, const std::string& solver) {
  World* world = world_of(id);
  if (world == nullptr) return complain("a solver was to be set of a world that is not there");
  try {
    world->use_engine(solver);
  } catch (const Error& error) {
    complain("world [" + world->name() + "] keeps its backend " + world->engine() + ": " + error.what());
  }
}

const std::string& SimulationFeatures::GetWorldSolver(const Identity& id) const {
  static const std::string none;
  const World* world = world_of(id);
  return world != nullptr ? world->engine() : none;
}

}  // namespace plumb::gazebo
