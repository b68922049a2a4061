#include "hosts/gazebo/tests/host.hpp"

#include <chrono>
#include <cstdlib>
#include <ignition/common/Mesh.hh>
#include <ignition/common/SubMesh.hh>
#include <ignition/math/eigen3/Conversions.hh>
#include <ignition/physics/ConstructEmpty.hh>
#include <ignition/physics/FixedJoint.hh>
#include <ignition/physics/ForwardStep.hh>
#include <ignition/physics/FrameSemantics.hh>
#include <ignition/physics/FreeGroup.hh>
#include <ignition/physics/GetBoundingBox.hh>
#include <ignition/physics/GetContacts.hh>
#include <ignition/physics/GetEntities.hh>
#include <ignition/physics/Joint.hh>
#include <ignition/physics/Link.hh>
#include <ignition/physics/RemoveEntities.hh>
#include <ignition/physics/RequestEngine.hh>
#include <ignition/physics/Shape.hh>
#include <ignition/physics/World.hh>
#include <ignition/physics/mesh/MeshShape.hh>
#include <ignition/physics/sdf/ConstructCollision.hh>
#include <ignition/physics/sdf/ConstructJoint.hh>
#include <ignition/physics/sdf/ConstructLink.hh>
#include <ignition/physics/sdf/ConstructModel.hh>
#include <ignition/physics/sdf/ConstructNestedModel.hh>
#include <ignition/physics/sdf/ConstructWorld.hh>
#include <ignition/plugin/Loader.hh>
#include <sdf/Collision.hh>
#include <sdf/Joint.hh>
#include <sdf/JointAxis.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/Root.hh>
#include <sdf/World.hh>
#include <stdexcept>

namespace plumb::gazebo::tests {
namespace {

namespace physics = ignition::physics;
using ignition::math::eigen3::convert;

/// What gz-sim asks for at least, and what it uses where it is there.
struct Wanted
    : physics::FeatureList<
          physics::GetEntities, physics::RemoveEntities, physics::FindFreeGroupFeature, physics::SetFreeGroupWorldPose,
          physics::SetFreeGroupWorldVelocity, physics::FreeGroupFrameSemantics, physics::LinkFrameSemantics,
          physics::ModelFrameSemantics, physics::ForwardStep, physics::sdf::ConstructSdfWorld,
          physics::sdf::ConstructSdfModel, physics::sdf::ConstructSdfNestedModel, physics::sdf::ConstructSdfLink,
          physics::sdf::ConstructSdfCollision, physics::sdf::ConstructSdfJoint, physics::GetBasicJointProperties,
          physics::GetBasicJointState, physics::SetBasicJointState, physics::SetJointVelocityCommandFeature,
          physics::SetJointPositionLimitsFeature, physics::GetJointTransmittedWrench, physics::AttachFixedJointFeature,
          physics::SetJointTransformFromParentFeature, physics::DetachJointFeature, physics::AddLinkExternalForceTorque,
          physics::GetContactsFromLastStepFeature, physics::CollisionFilterMaskFeature, physics::GetModelBoundingBox,
          physics::Gravity, physics::Solver, physics::mesh::AttachMeshShapeFeature> {};

Vector from(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d to(const Vector& v) { return {v.X(), v.Y(), v.Z()}; }

std::string plugin_file(const std::string& engine) {
  if (engine == "dartsim") return PLUMB_DARTSIM_FILE;
  setenv("PLUMB_GAZEBO_BACKEND", engine.c_str(), 1);
  return PLUMB_GAZEBO_FILE;
}

}  // namespace

struct Host::Impl {
  explicit Impl(const std::string& name) {
    const std::string file = plugin_file(name);
    for (const std::string& plugin : loader.LoadLib(file)) {
      engine = physics::RequestEngine3d<Wanted>::From(loader.Instantiate(plugin));
      if (engine) return;
    }
    throw std::runtime_error(file + " has no plugin of the features that are wanted");
  }

  [[nodiscard]] auto model(const std::string& name) const {
    auto found = world->GetModel(name);
    if (!found) throw std::runtime_error("no model " + name);
    return found;
  }
  [[nodiscard]] auto link(const std::string& name) const {
    auto found = model(name.substr(0, name.find("::")))->GetLink(name.substr(name.find("::") + 2));
    if (!found) throw std::runtime_error("no link " + name);
    return found;
  }
  [[nodiscard]] auto joint(const std::string& name) const {
    auto found = model(name.substr(0, name.find("::")))->GetJoint(name.substr(name.find("::") + 2));
    if (!found) throw std::runtime_error("no joint " + name);
    return found;
  }

  ignition::plugin::Loader loader;
  physics::Engine3dPtr<Wanted> engine;
  physics::World3dPtr<Wanted> world;
  std::unique_ptr<physics::FixedJoint3dPtr<Wanted>> weld;
  physics::ForwardStep::Output output;
  physics::ForwardStep::State state;
};

Host::Host(const std::string& engine) : impl_(std::make_unique<Impl>(engine)) {}
Host::~Host() = default;

bool Host::load(const std::string& text) {
  sdf::Root root;
  for (const sdf::Error& error : root.LoadSdfString(text)) throw std::runtime_error(error.Message());
  impl_->world = impl_->engine->ConstructWorld(*root.WorldByIndex(0));
  return static_cast<bool>(impl_->world);
}

bool Host::load_in_pieces(const std::string& text) {
  sdf::Root root;
  for (const sdf::Error& error : root.LoadSdfString(text)) throw std::runtime_error(error.Message());
  const sdf::World& whole = *root.WorldByIndex(0);
  sdf::World world;
  world.SetName(whole.Name());
  world.SetGravity(whole.Gravity());
  impl_->world = impl_->engine->ConstructWorld(world);
  if (!impl_->world) return false;
  for (std::uint64_t m = 0; m < whole.ModelCount(); ++m) {
    const sdf::Model& said = *whole.ModelByIndex(m);
    sdf::Model bare;
    bare.SetName(said.Name());
    bare.SetRawPose(said.RawPose());
    bare.SetStatic(said.Static());
    bare.SetSelfCollide(said.SelfCollide());
    auto model = impl_->world->ConstructModel(bare);
    for (std::uint64_t l = 0; l < said.LinkCount(); ++l) {
      const sdf::Link& part = *said.LinkByIndex(l);
      sdf::Link link;
      link.SetName(part.Name());
      link.SetRawPose(part.RawPose());
      link.SetInertial(part.Inertial());
      auto made = model->ConstructLink(link);
      for (std::uint64_t c = 0; c < part.CollisionCount(); ++c) made->ConstructCollision(*part.CollisionByIndex(c));
    }
    for (std::uint64_t j = 0; j < said.JointCount(); ++j) {
      const sdf::Joint& part = *said.JointByIndex(j);
      sdf::Joint joint;
      joint.SetName(part.Name());
      joint.SetType(part.Type());
      joint.SetParentLinkName(part.ParentLinkName());
      joint.SetChildLinkName(part.ChildLinkName());
      joint.SetRawPose(part.RawPose());
      for (unsigned i = 0; i < 2 && part.Axis(i) != nullptr; ++i) {
        sdf::JointAxis axis;  // no copy, which would remember its file's frames
        if (!axis.SetXyz(part.Axis(i)->Xyz()).empty()) return false;
        joint.SetAxis(i, axis);
      }
      model->ConstructJoint(joint);
    }
  }
  return true;
}

bool Host::add_massless() {
  sdf::Model model;
  model.SetName("feather");
  sdf::Link link;
  link.SetName("massless");
  ignition::math::Inertiald inertia;
  inertia.SetMassMatrix({0, Vector::Zero, Vector::Zero});
  link.SetInertial(inertia);
  return static_cast<bool>(impl_->world->ConstructModel(model)->ConstructLink(link));
}

void Host::step(double dt, int steps) {
  physics::ForwardStep::Input input;
  input.Get<std::chrono::steady_clock::duration>() =
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(dt));
  for (int i = 0; i < steps; ++i) impl_->world->Step(impl_->output, impl_->state, input);
}
std::size_t Host::changed() const { return impl_->output.Get<physics::ChangedWorldPoses>().entries.size(); }

Pose Host::pose(const std::string& link) const { return convert(impl_->link(link)->FrameDataRelativeToWorld().pose); }
Vector Host::velocity(const std::string& link) const {
  return from(impl_->link(link)->FrameDataRelativeToWorld().linearVelocity);
}
Vector Host::spin(const std::string& link) const {
  return from(impl_->link(link)->FrameDataRelativeToWorld().angularVelocity);
}
Vector Host::acceleration(const std::string& link) const {
  return from(impl_->link(link)->FrameDataRelativeToWorld().linearAcceleration);
}
Pose Host::model_pose(const std::string& model) const {
  return convert(impl_->model(model)->FrameDataRelativeToWorld().pose);
}
ignition::math::AxisAlignedBox Host::bounds(const std::string& model) const {
  const auto box = impl_->model(model)->GetAxisAlignedBoundingBox();
  return {from(box.min()), from(box.max())};
}
void Host::push(const std::string& link, const Vector& force, const Vector& at) {
  impl_->link(link)->AddExternalForce(physics::RelativeForce3d(physics::FrameID::World(), to(force)),
                                      physics::RelativePosition3d(physics::FrameID::World(), to(at)));
}
void Host::twist(const std::string& link, const Vector& torque) {
  impl_->link(link)->AddExternalTorque(physics::RelativeTorque3d(physics::FrameID::World(), to(torque)));
}

bool Host::has_model(const std::string& model) const { return static_cast<bool>(impl_->world->GetModel(model)); }
bool Host::has_joint(const std::string& joint) const {
  return static_cast<bool>(
      impl_->model(joint.substr(0, joint.find("::")))->GetJoint(joint.substr(joint.find("::") + 2)));
}
std::size_t Host::links(const std::string& model) const { return impl_->model(model)->GetLinkCount(); }
std::size_t Host::shapes(const std::string& link) const { return impl_->link(link)->GetShapeCount(); }
bool Host::remove(const std::string& model) { return impl_->model(model)->Remove(); }

bool Host::is_free(const std::string& model) const { return static_cast<bool>(impl_->model(model)->FindFreeGroup()); }
void Host::place(const std::string& model, const Pose& pose) {
  impl_->model(model)->FindFreeGroup()->SetWorldPose(convert(pose));
}
void Host::move(const std::string& model, const Vector& velocity, const Vector& spin) {
  auto group = impl_->model(model)->FindFreeGroup();
  group->SetWorldAngularVelocity(to(spin));
  group->SetWorldLinearVelocity(to(velocity));
}

double Host::position(const std::string& joint, std::size_t axis) const {
  return impl_->joint(joint)->GetPosition(axis);
}
double Host::rate(const std::string& joint, std::size_t axis) const { return impl_->joint(joint)->GetVelocity(axis); }
void Host::set_position(const std::string& joint, double value, std::size_t axis) {
  impl_->joint(joint)->SetPosition(axis, value);
}
void Host::set_rate(const std::string& joint, double value, std::size_t axis) {
  impl_->joint(joint)->SetVelocity(axis, value);
}
void Host::set_force(const std::string& joint, double value, std::size_t axis) {
  impl_->joint(joint)->SetForce(axis, value);
}
void Host::command(const std::string& joint, double velocity, std::size_t axis) {
  impl_->joint(joint)->SetVelocityCommand(axis, velocity);
}
void Host::limit(const std::string& joint, double lower, double upper) {
  impl_->joint(joint)->SetMinPosition(0, lower);
  impl_->joint(joint)->SetMaxPosition(0, upper);
}
Vector Host::transmitted_force(const std::string& joint) const {
  return from(impl_->joint(joint)->GetTransmittedWrench().force);
}
void Host::detach(const std::string& joint) { impl_->joint(joint)->Detach(); }
bool Host::weld(const std::string& child, const std::string& parent) {
  auto other = impl_->link(parent);
  const auto between =
      other->FrameDataRelativeToWorld().pose.inverse() * impl_->link(child)->FrameDataRelativeToWorld().pose;
  impl_->weld = std::make_unique<physics::FixedJoint3dPtr<Wanted>>(impl_->link(child)->AttachFixedJoint(other, "weld"));
  if (!*impl_->weld) return false;
  (*impl_->weld)->SetTransformFromParent(between);
  return true;
}
void Host::detach_weld() { (*impl_->weld)->Detach(); }

std::vector<ContactSeen> Host::contacts() const {
  using ContactPoint = physics::World3d<Wanted>::ContactPoint;
  using ExtraContactData = physics::World3d<Wanted>::ExtraContactData;
  std::vector<ContactSeen> seen;
  for (const auto& contact : impl_->world->GetContactsFromLastStep()) {
    const auto& point = contact.Get<ContactPoint>();
    ContactSeen one{point.collision1->GetName(), point.collision2->GetName(), from(point.point), {}, {}, 0};
    if (const auto* extra = contact.Query<ExtraContactData>()) {
      one.normal = from(extra->normal);
      one.force = from(extra->force);
      one.depth = extra->depth;
    }
    seen.push_back(one);
  }
  return seen;
}
void Host::set_mask(const std::string& link, std::uint16_t mask) {
  impl_->link(link)->GetShape(0)->SetCollisionFilterMask(mask);
}
void Host::set_gravity(const Vector& gravity) { impl_->world->SetGravity(to(gravity)); }
Vector Host::gravity() const { return from(impl_->world->GetGravity()); }
void Host::set_solver(const std::string& solver) { impl_->world->SetSolver(solver); }
std::string Host::solver() const { return impl_->world->GetSolver(); }

bool Host::attach_tetrahedron(const std::string& link, const std::vector<Vector>& corners) {
  ignition::common::SubMesh faces;
  for (const Vector& corner : corners) {
    faces.AddVertex(corner);
    faces.AddNormal(corner);
  }
  for (const unsigned corner : {0U, 2U, 1U, 0U, 1U, 3U, 1U, 2U, 3U, 2U, 0U, 3U}) faces.AddIndex(corner);
  ignition::common::Mesh mesh;
  mesh.AddSubMesh(faces);
  return static_cast<bool>(impl_->link(link)->AttachMeshShape("tetrahedron", mesh));
}

}  // namespace plumb::gazebo::tests
