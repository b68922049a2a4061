// What Gazebo speaks of: models of links with shapes, and the joints between them. Plain records; the world builds
// bodies and joints of the engine from them when it is stepped, and again when they change.
#pragma once

#include <cstdint>
#include <ignition/math/Inertial.hh>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hosts/gazebo/world/geometry.hpp"

namespace plumb::gazebo {

class World;
struct Link;
struct Joint;
struct Model;

constexpr std::uint16_t kTouchesAll = 0xffff;

struct Shape {
  std::size_t id = 0;
  std::string name;
  Link* link = nullptr;
  Placement pose;  ///< in the link
  Geometry geometry;
  double friction = 1;
  double restitution = 0;
  std::uint16_t mask = kTouchesAll;
};

/// A body of the engine. A link is one, or where it stands still one for each shape that nothing can be joined with.
struct Part {
  PlumbBody body = 0;
  Placement offset;               ///< of the body's frame in the link's
  std::vector<Shape*> shapes;     ///< by child
  std::vector<PlumbShape> owned;  ///< the body's own first, then its children
};

struct Link {
  std::size_t id = 0;
  std::string name;
  Model* model = nullptr;
  ignition::math::Inertiald inertial;
  bool gravity = true;
  std::vector<std::unique_ptr<Shape>> shapes;
  std::vector<Joint*> joints;  ///< that it is part of, also of other models

  Placement pose;
  Vector velocity, spin;  ///< of the centre of mass; world axes
  Vector acceleration, spin_acceleration;
  Vector force, torque;  ///< of the host for the next step, about the centre of mass

  std::vector<Part> parts;
  bool built = false;
  bool moved = false;             ///< by the host, since the engine was told
  std::optional<Placement> told;  ///< what the host heard of it last

  [[nodiscard]] Vector centre() const { return pose.CoordPositionAdd(inertial.Pose().Pos()); }
  [[nodiscard]] Vector velocity_at(const Vector& point) const { return velocity + spin.Cross(point - centre()); }
  void add_force(const Vector& more, const Vector& point) {
    force += more;
    torque += (point - centre()).Cross(more);
  }
};

enum class JointKind { fixed, revolute, prismatic, ball, universal };

/// One of a joint's coordinates.
struct JointAxis {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double effort = std::numeric_limits<double>::infinity();
  double damping = 0, friction = 0, stiffness = 0, rest = 0;
  double force = 0;               ///< of the host for the next step
  double applied = 0;             ///< in the last step, with spring and damper
  std::optional<double> command;  ///< velocity that a motor holds
  double position = 0;            ///< with the turns that were made
  double rate = 0, acceleration = 0;
};

struct Joint {
  std::size_t id = 0;
  std::string name;
  Model* model = nullptr;
  JointKind kind = JointKind::fixed;
  Link* parent = nullptr;  ///< null: the world
  Link* child = nullptr;
  Placement in_parent, in_child;  ///< the joint's frame
  Rotation turn;                  ///< from the joint's frame to Plumb's, whose x is the first axis and y the second
  std::vector<JointAxis> axes;
  bool attached = true;

  PlumbJoint joint = 0;
  bool built = false;
  bool motors_changed = false;
};

struct Model {
  std::size_t id = 0;
  std::size_t group = 0;  ///< the number of all its links as one free group
  std::string name;
  World* world = nullptr;
  Model* parent = nullptr;
  bool is_static = false;
  bool self_collide = false;
  std::string canonical;  ///< the name of the link that carries the model's frame; "": the first
  Link* carrier = nullptr;
  Placement pose;  ///< in the world; once there is a carrier in that
  std::vector<std::unique_ptr<Link>> links;
  std::vector<std::unique_ptr<Joint>> joints;
  std::vector<std::unique_ptr<Model>> models;

  [[nodiscard]] Placement world_pose() const { return carrier != nullptr ? carrier->pose * pose : pose; }
  [[nodiscard]] const Model& root() const { return parent != nullptr ? parent->root() : *this; }
  [[nodiscard]] bool stands() const { return is_static || (parent != nullptr && parent->stands()); }
};

[[nodiscard]] inline PlumbMotion motion_of(const Link& link) {
  return link.model->stands() ? PLUMB_STATIC : PLUMB_DYNAMIC;
}

}  // namespace plumb::gazebo
