#include "hosts/gazebo/world/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hosts/gazebo/world/console.hpp"
#include "hosts/gazebo/world/joint_frames.hpp"

namespace plumb::gazebo {
namespace {

/// What Gazebo may ask of a world later, which is too late to declare it.
constexpr PlumbNeeds kWanted = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                               PLUMB_NEED_RESTITUTION | PLUMB_NEED_JOINTS | PLUMB_NEED_CONTACTS |
                               PLUMB_NEED_CONTACT_IMPULSES | PLUMB_NEED_GYROSCOPIC | PLUMB_NEED_FORCES |
                               PLUMB_NEED_FILTERS | PLUMB_NEED_JOINT_REACTIONS;

std::unique_ptr<IPhysicsWorld> create(const Backend& backend, PlumbNeeds needs, const Vector& gravity) {
  PlumbWorldDesc desc = world_desc(needs);
  desc.gravity = to_plumb(gravity);
  return backend.create_world(desc);
}

}  // namespace

World::World(std::size_t number, const std::string& called, const std::string& engine)
    : id_(number),
      name_(called),
      engine_(engine),
      backend_(open_engine(engine)),
      needs_(backend_.offered(kWanted)),
      physics_(create(backend_, needs_, gravity_)) {}

World::~World() = default;

void World::use_engine(const std::string& engine) {
  const Backend backend = open_engine(engine);
  const PlumbNeeds needs = backend.offered(kWanted);
  physics_ = create(backend, needs, gravity_);
  backend_ = backend;
  needs_ = needs;
  engine_ = engine;
  changed_ = true;
  owners_.clear();
  for_each_link([](Link& link) {
    link.parts.clear();
    link.built = false;
  });
  for_each_joint([](Joint& joint) {
    joint.joint = 0;
    joint.built = false;
  });
}

void World::set_gravity(const Vector& gravity) {
  if (report(physics_->set_gravity(to_plumb(gravity)))) gravity_ = gravity;
}

bool World::report(PlumbResult result) {
  try {
    check(*physics_, result);
    return true;
  } catch (const Error& error) {
    complain("world [" + name_ + "]: " + error.what());
    return false;
  }
}

void World::rebuild(Link& link) {
  link.built = false;
  changed_ = true;
}

void World::rebuild(Joint& joint) {
  joint.built = false;
  changed_ = true;
}

void World::step(double dt) {
  build();
  place();
  drive(dt);
  check(*physics_, physics_->step(dt));
  PlumbStepReport report{};
  report.struct_size = sizeof(report);
  check(*physics_, physics_->wait(report));
  dt_ = dt;
  read(dt);
}

void World::write(PlumbField field, const std::vector<PlumbBody>& bodies, const std::vector<double>& rows) {
  if (bodies.empty()) return;
  const std::size_t columns = rows.size() / bodies.size();
  check(*physics_, physics_->write(field, bodies,
                                   ConstRows(reinterpret_cast<const std::byte*>(rows.data()), bodies.size(),
                                             columns * sizeof(double), PLUMB_F64)));
}

/// Tells the engine where the host has put things.
void World::place() {
  std::vector<PlumbBody> placed, set_moving;
  std::vector<double> poses, velocities;
  for_each_link([&](Link& link) {
    if (!std::exchange(link.moved, false)) return;
    for (const Part& part : link.parts) {
      const PlumbPose pose = to_plumb(link.pose * part.offset);
      const PlumbQuat& q = pose.orientation;
      placed.push_back(part.body);
      poses.insert(poses.end(), {pose.position.x, pose.position.y, pose.position.z, q.x, q.y, q.z, q.w});
      if (motion_of(link) != PLUMB_DYNAMIC) continue;
      set_moving.push_back(part.body);
      const Vector &v = link.velocity, &w = link.spin;
      velocities.insert(velocities.end(), {v.X(), v.Y(), v.Z(), w.X(), w.Y(), w.Z()});
    }
  });
  write(PLUMB_FIELD_POSE, placed, poses);
  write(PLUMB_FIELD_VELOCITY, set_moving, velocities);
}

void World::read(double dt) {
  std::vector<std::array<double, 7>> poses(moving_.size());
  std::vector<std::array<double, 6>> velocities(moving_.size());
  if (!moving_.empty()) {
    check(*physics_, physics_->read(PLUMB_FIELD_POSE, moving_bodies_, rows_over(std::span(poses))));
    check(*physics_, physics_->read(PLUMB_FIELD_VELOCITY, moving_bodies_, rows_over(std::span(velocities))));
  }
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    Link& link = *moving_[i];
    const auto& p = poses[i];
    const auto& v = velocities[i];
    const Placement body({p[0], p[1], p[2]}, Rotation(p[6], p[3], p[4], p[5]));
    link.pose = body * link.parts[0].offset.Inverse();
    const Vector velocity(v[0], v[1], v[2]), spin(v[3], v[4], v[5]);
    link.acceleration = (velocity - link.velocity) / dt;
    link.spin_acceleration = (spin - link.spin) / dt;
    link.velocity = velocity;
    link.spin = spin;
  }
  for_each_joint([dt](Joint& joint) {
    if (!joint.attached) return;
    for (std::size_t i = 0; i < joint.axes.size(); ++i) {
      JointAxis& axis = joint.axes[i];
      const double rate = rate_of(joint, i);
      axis.acceleration = (rate - axis.rate) / dt;
      axis.rate = rate;
      const double now = coordinate_of(joint, i);
      const bool turns = joint.kind == JointKind::revolute || joint.kind == JointKind::universal;
      axis.position = turns ? now + 2 * M_PI * std::round((axis.position - now) / (2 * M_PI)) : now;
    }
  });
}

}  // namespace plumb::gazebo
