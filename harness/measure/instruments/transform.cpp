#include "measure/instruments/transform.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace plumb::harness {
namespace {

using referee::Quat;
using referee::vec;
using referee::Vec3;

PlumbVec3 times(const PlumbVec3& v, double factor) { return {v.x * factor, v.y * factor, v.z * factor}; }

PlumbQuat quaternion(const Quat& q) { return {q.x(), q.y(), q.z(), q.w()}; }

PlumbPose turned(const PlumbPose& pose, const Quat& turn) {
  return {referee::plain(turn * vec(pose.position)), quaternion(turn * referee::quat(pose.orientation))};
}

void scale_shape(SceneShape& shape, double scale) {
  shape.desc.radius *= scale;
  shape.desc.half_height *= scale;
  shape.desc.half_extents = times(shape.desc.half_extents, scale);
  shape.desc.spacing = times(shape.desc.spacing, scale);
  for (double& coordinate : shape.vertices) coordinate *= scale;
  for (double& height : shape.heights) height *= scale;
  for (SceneShape::Child& child : shape.children) child.pose.position = times(child.pose.position, scale);
}

/// One by stiffness.
void strengthen(PlumbSpring& spring, double stiffness, double damping) {
  spring.frequency *= stiffness;
  spring.damping_ratio *= damping;
}

void scale_joint(PlumbJointDesc& joint, double scale) {
  const double speed = std::sqrt(scale), force = std::pow(scale, 3), torque = std::pow(scale, 4);
  joint.frame_a.position = times(joint.frame_a.position, scale);
  joint.frame_b.position = times(joint.frame_b.position, scale);
  joint.rest_length *= scale;
  if (joint.type == PLUMB_JOINT_RACK_AND_PINION) joint.ratio /= scale;
  joint.break_force *= force;
  joint.break_torque *= torque;
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const bool linear = axis < 3;
    joint.limits[axis].lower *= linear ? scale : 1;
    joint.limits[axis].upper *= linear ? scale : 1;
    joint.motors[axis].target_velocity *= linear ? speed : 1 / speed;
    joint.motors[axis].max_force *= linear ? force : torque;
    joint.springs[axis].rest *= linear ? scale : 1;
    if (joint.springs[axis].mode == PLUMB_SPRING_FREQUENCY)
      joint.springs[axis].frequency /= speed;
    else
      strengthen(joint.springs[axis], linear ? force / scale : torque, linear ? force / speed : torque * speed);
  }
}

}  // namespace

Scene scaled(Scene scene, double scale) {
  const double time = std::sqrt(scale), mass = std::pow(scale, 3);
  scene.dt *= time;
  scene.seconds *= time;
  for (SceneShape& shape : scene.shapes) scale_shape(shape, scale);
  for (SceneBody& body : scene.bodies) {
    PlumbBodyDesc& desc = body.desc;
    desc.pose.position = times(desc.pose.position, scale);
    desc.linear_velocity = times(desc.linear_velocity, time);  // scale / time
    desc.angular_velocity = times(desc.angular_velocity, 1 / time);
    desc.material.surface_velocity = times(desc.material.surface_velocity, time);
    desc.mass *= mass;
    desc.centre_of_mass = times(desc.centre_of_mass, scale);
    desc.inertia = times(desc.inertia, mass * scale * scale);
    desc.linear_damping /= time;
    desc.angular_damping /= time;
    desc.rolling_friction *= scale;
    desc.spinning_friction *= scale;
  }
  for (SceneJoint& joint : scene.joints) scale_joint(joint.desc, scale);
  return scene;
}

Scene heavier(Scene scene, double factor) {
  for (SceneBody& body : scene.bodies) {
    body.desc.density *= factor;
    body.desc.mass *= factor;
    body.desc.inertia = times(body.desc.inertia, factor);
  }
  for (SceneJoint& joint : scene.joints) {
    joint.desc.break_force *= factor;
    joint.desc.break_torque *= factor;
    for (PlumbMotor& motor : joint.desc.motors) motor.max_force *= factor;
    for (PlumbSpring& spring : joint.desc.springs)
      if (spring.mode == PLUMB_SPRING_STIFFNESS) strengthen(spring, factor, factor);
  }
  return scene;
}

Scene translated(Scene scene, const Vec3& offset) {
  for (SceneBody& body : scene.bodies) body.desc.pose.position = referee::plain(vec(body.desc.pose.position) + offset);
  for (SceneJoint& joint : scene.joints)
    if (!joint.body_a) joint.desc.frame_a.position = referee::plain(vec(joint.desc.frame_a.position) + offset);
  return scene;
}

Scene boosted(Scene scene, const Vec3& velocity) {
  for (SceneBody& body : scene.bodies) {
    if (body.desc.motion != PLUMB_DYNAMIC) throw std::logic_error("body " + body.name + " would be left behind");
    body.desc.linear_velocity = referee::plain(vec(body.desc.linear_velocity) + velocity);
  }
  for (const SceneJoint& joint : scene.joints)
    if (!joint.body_a) throw std::logic_error("joint " + joint.name + " holds on to the world");
  return scene;
}

Scene rotated(Scene scene, const Quat& turn) {
  scene.gravity = referee::plain(turn * vec(scene.gravity));
  for (SceneBody& body : scene.bodies) {
    if (body.desc.locks != 0) throw std::logic_error("body " + body.name + " has locked axes, which do not turn");
    body.desc.pose = turned(body.desc.pose, turn);
    body.desc.linear_velocity = referee::plain(turn * vec(body.desc.linear_velocity));
    body.desc.angular_velocity = referee::plain(turn * vec(body.desc.angular_velocity));
  }
  for (SceneJoint& joint : scene.joints)
    if (!joint.body_a) joint.desc.frame_a = turned(joint.desc.frame_a, turn);
  return scene;
}

Scene mirrored(Scene scene) {
  const auto place = [](PlumbVec3& v) { v.x = -v.x; };
  const auto turn = [](PlumbQuat& q) { q.y = -q.y, q.z = -q.z; };  // the axis of a turn is a pseudovector
  const auto spin = [](PlumbVec3& w) { w.y = -w.y, w.z = -w.z; };
  place(scene.gravity);
  for (SceneShape& shape : scene.shapes) {
    if (shape.desc.type == PLUMB_COMPOUND || shape.desc.type == PLUMB_HEIGHT_FIELD)
      throw std::logic_error("shape " + shape.name + " is of a type that is not mirrored");
    for (std::size_t i = 0; i < shape.vertices.size(); i += 3) shape.vertices[i] = -shape.vertices[i];
    for (std::size_t i = 0; i + 2 < shape.indices.size(); i += 3) std::swap(shape.indices[i + 1], shape.indices[i + 2]);
  }
  for (SceneBody& body : scene.bodies) {
    if (body.desc.locks != 0) throw std::logic_error("body " + body.name + " has locked axes");
    place(body.desc.pose.position);
    turn(body.desc.pose.orientation);
    place(body.desc.linear_velocity);
    spin(body.desc.angular_velocity);
    place(body.desc.material.surface_velocity);
    place(body.desc.centre_of_mass);
    turn(body.desc.inertia_orientation);
  }
  for (SceneJoint& joint : scene.joints) {
    if (joint.desc.type != PLUMB_JOINT_BALL && joint.desc.type != PLUMB_JOINT_DISTANCE)
      throw std::logic_error("joint " + joint.name + " is of a type that is not mirrored");
    for (PlumbPose* frame : {&joint.desc.frame_a, &joint.desc.frame_b}) {
      place(frame->position);
      turn(frame->orientation);
    }
  }
  return scene;
}

Scene permuted(const Scene& scene, std::span<const std::size_t> order) {
  Scene result = scene;
  std::vector<std::size_t> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    result.bodies[i] = scene.bodies[order[i]];
    place[order[i]] = i;
  }
  for (SceneJoint& joint : result.joints) {
    if (joint.body_a) joint.body_a = place[*joint.body_a];
    joint.body_b = place[joint.body_b];
  }
  return result;
}

}  // namespace plumb::harness
