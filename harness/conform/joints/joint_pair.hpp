// What the checks of joints work on: two cubes with a joint between them, or one cube and the world.
#pragma once

#include "conform/probe.hpp"
#include "referee/joints.hpp"

namespace plumb::harness::conform {

inline constexpr PlumbNeeds kJointNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS;

/// Two cubes side by side along x with the joint between them, or one cube and the world.
struct JointPair {
  Probe probe;
  PlumbBody a = 0, b = 0;
  PlumbJointDesc desc;

  JointPair(Conformance& c, PlumbJointType type, bool to_world, PlumbNeeds needs, const Vec& gravity = Vec::Zero())
      : probe(c, needs, gravity), desc(joint_desc(type)) {
    PlumbBodyDesc cube = dynamic_desc(probe.box({0.25, 0.25, 0.25}), {0, 0, 0});
    cube.material.friction = 0;
    if (!to_world) a = probe.body(cube);
    cube.pose.position.x = 1;
    b = probe.body(cube);
    desc.body_a = a;
    desc.body_b = b;
    desc.frame_a.position = {0.5, 0, 0};
    desc.frame_b.position = {-0.5, 0, 0};
    desc.rest_length = 0;
    if (type == PLUMB_JOINT_DISTANCE) {
      desc.frame_a.position = desc.frame_b.position = {0, 0, 0};
      desc.rest_length = 1;
    }
    for (PlumbAxisMode& mode : desc.axis_modes) mode = PLUMB_AXIS_LOCKED;
  }

  referee::Pose pose(PlumbBody body) {
    if (body == 0) return {};
    return {probe.orientation(body).toRotationMatrix(), probe.position(body)};
  }
  referee::JointError error() { return referee::joint_error(desc, pose(a), pose(b)); }
  double coordinate(std::size_t axis) { return referee::joint_coordinates(desc, pose(a), pose(b))[axis]; }
};

/// Axes that a type leaves free, as bits.
constexpr std::uint32_t free_axes(PlumbJointType type) {
  constexpr std::uint32_t axes[PLUMB_JOINT_TYPE_COUNT] = {0b111000, 0b001000, 0b000001, 0b111111, 0,
                                                          0b011000, 0,        0b111000, 0,        0};
  return axes[type];
}

}  // namespace plumb::harness::conform
