// A small world of bodies without shapes on joints, through the plugin's face.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "plugin/world.hpp"

namespace plumb::impulse {

constexpr double kPi_ = std::numbers::pi;
constexpr double kGravity = 9.81;

class JointRig {
 public:
  explicit JointRig(PlumbNeeds needs = PLUMB_NEED_ROTATION | PLUMB_NEED_GYROSCOPIC | PLUMB_NEED_JOINTS,
                    PlumbVec3 gravity = {0, -kGravity, 0}, std::uint32_t threads = 1)
      : world_(init(needs, gravity, threads)) {}

  /// A body of that mass and inertia about its principal axes, with its centre of mass at the frame's origin.
  PlumbBody body(const PlumbVec3& at, double mass = 1, const PlumbVec3& inertia = {0.1, 0.1, 0.1},
                 const PlumbQuat& orientation = {0, 0, 0, 1}, const PlumbVec3& velocity = {0, 0, 0},
                 const PlumbVec3& spin = {0, 0, 0}) {
    PlumbBodyDesc desc = body_desc();
    desc.mass_mode = PLUMB_MASS_EXPLICIT;
    desc.mass = mass;
    desc.inertia = inertia;
    desc.pose = {at, orientation};
    desc.linear_velocity = velocity;
    desc.angular_velocity = spin;
    PlumbBody id = ++bodies_ - 1 + (std::uint64_t{1} << 32);
    world_.create_bodies({&desc, 1}, {&id, 1});
    return id;
  }
  PlumbJoint join(PlumbJointDesc desc) {
    PlumbJoint id = ++joints_ - 1 + (std::uint64_t{1} << 32);
    static_cast<IJoints&>(world_).create_joints({&desc, 1}, {&id, 1});
    return id;
  }
  /// Frames at one place with one orientation, both given in world axes.
  PlumbJoint join_at(PlumbJointType type, PlumbBody a, PlumbBody b, const PlumbVec3& at,
                     const PlumbQuat& axes = {0, 0, 0, 1}) {
    PlumbJointDesc desc = joint_desc(type);
    desc.body_a = a;
    desc.body_b = b;
    const auto local = [&](PlumbBody body) {
      if (body == 0) return PlumbPose{at, axes};
      const PlumbPose pose = this->pose(body);
      const QuatD back = conjugate(to_double(pose.orientation));
      const Position p = rotate(back, to_position(at) - to_position(pose.position));
      const QuatD q = back * to_double(axes);
      return PlumbPose{{p.x, p.y, p.z}, {q.x, q.y, q.z, q.w}};
    };
    desc.frame_a = local(a);
    desc.frame_b = local(b);
    return join(desc);
  }

  void step(double dt = 1.0 / 60) {
    world_.step(dt);
    PlumbStepReport report{};
    world_.wait(report);
    EXPECT_EQ(report.nonfinite, 0U);
  }
  void run(double seconds, double dt = 1.0 / 60) {
    for (double t = dt / 2; t < seconds; t += dt) step(dt);
  }

  PlumbPose pose(PlumbBody body) {
    PlumbPose at{};
    world_.read(PLUMB_FIELD_POSE, {&body, 1}, rows_over(std::span(&at, 1)));
    return at;
  }
  struct Speed {
    PlumbVec3 linear, angular;
  };
  Speed speed(PlumbBody body) {
    Speed v{};
    world_.read(PLUMB_FIELD_VELOCITY, {&body, 1}, rows_over(std::span(&v, 1)));
    return v;
  }
  bool is_awake(PlumbBody body) {
    double awake = 0;
    world_.read(PLUMB_FIELD_AWAKE, {&body, 1}, rows_over(std::span(&awake, 1)));
    return awake != 0;
  }
  std::array<double, 6> coordinates(PlumbJoint joint) {
    std::array<double, 6> six{};
    static_cast<IJoints&>(world_).read_joints(PLUMB_JOINT_COORDINATES, {&joint, 1}, rows_over(std::span(&six, 1)));
    return six;
  }
  std::array<double, 6> reaction(PlumbJoint joint) {
    std::array<double, 6> six{};
    static_cast<IJoints&>(world_).read_joints(PLUMB_JOINT_REACTION, {&joint, 1}, rows_over(std::span(&six, 1)));
    return six;
  }
  /// The motor on an axis.
  void drive(PlumbJoint joint, std::size_t axis, double velocity, double max_force) {
    std::array<double, 12> row{};
    static_cast<IJoints&>(world_).read_joints(PLUMB_JOINT_MOTOR, {&joint, 1}, rows_over(std::span(&row, 1)));
    row[2 * axis] = velocity;
    row[2 * axis + 1] = max_force;
    const ConstRows rows(reinterpret_cast<const std::byte*>(row.data()), 1, sizeof row, PLUMB_F64);
    static_cast<IJoints&>(world_).write_joints(PLUMB_JOINT_MOTOR, {&joint, 1}, rows);
  }
  void push(PlumbBody body, const PlumbVec3& impulse) {
    const ConstRows rows(reinterpret_cast<const std::byte*>(&impulse), 1, sizeof impulse, PLUMB_F64);
    world_.write(PLUMB_FIELD_IMPULSE, {&body, 1}, rows);
  }
  std::vector<PlumbEvent> events() {
    const auto told = world_.events();
    return {told.begin(), told.end()};
  }
  /// By number, in the order of the setting's words.
  void choose_solver(double number) {
    constexpr const char* words[] = {"tgs_soft", "si", "jacobi", "xpbd"};
    choose("solver", words[static_cast<int>(number)]);
  }
  void choose(const char* name, const char* word) {
    PlumbSettingValue setting{};
    setting.type = PLUMB_SETTING_CHOICE;
    setting.choice = word;
    EXPECT_EQ(world_.settings()->set_setting(name, setting), PLUMB_OK);
  }
  void set(const char* name, double value) {
    PlumbSettingValue setting{};
    setting.number = value;
    world_.settings()->set_setting(name, setting);
  }

 private:
  static WorldInit init(PlumbNeeds needs, const PlumbVec3& gravity, std::uint32_t threads) {
    WorldInit made{};
    made.desc = world_desc(needs);
    made.desc.gravity = gravity;
    made.desc.threads = threads;
    made.infos = settings_table().infos();
    for (const PlumbSettingInfo& info : made.infos) made.values.push_back(info.default_value);
    return made;
  }

  World world_;
  std::uint64_t bodies_ = 0, joints_ = 0;
};

/// Linear, and angular about the origin, of bodies with inertia diag(d) along their axes.
inline std::array<double, 6> momentum(JointRig& rig, const std::vector<PlumbBody>& bodies, double mass,
                                      const PlumbVec3& d) {
  std::array<double, 6> sum{};
  for (const PlumbBody body : bodies) {
    const PlumbPose pose = rig.pose(body);
    const auto speed = rig.speed(body);
    const QuatD q = to_double(pose.orientation);
    const Position p = mass * to_position(speed.linear), w = rotate_back(q, to_position(speed.angular));
    const Position l = cross(to_position(pose.position), p) + rotate(q, {d.x * w.x, d.y * w.y, d.z * w.z});
    const std::array<double, 6> all = {p.x, p.y, p.z, l.x, l.y, l.z};
    for (std::size_t i = 0; i < all.size(); ++i) sum[i] += all[i];
  }
  return sum;
}

/// The turn by `angle` about a unit axis.
inline PlumbQuat about(const PlumbVec3& axis, double angle) {
  const double s = std::sin(angle / 2);
  return {s * axis.x, s * axis.y, s * axis.z, std::cos(angle / 2)};
}

}  // namespace plumb::impulse
