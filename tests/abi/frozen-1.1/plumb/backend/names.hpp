// The words for what plumb.h numbers, for sentences of backends and hosts.
#pragma once

#include <cstdint>

#include "plumb/plumb.h"

namespace plumb::backend {

[[nodiscard]] constexpr const char* shape_name(PlumbShapeType type) {
  constexpr const char* names[PLUMB_SHAPE_TYPE_COUNT] = {
      "sphere", "box", "capsule", "cylinder", "convex hull", "triangle mesh", "height field", "plane", "compound"};
  return type < PLUMB_SHAPE_TYPE_COUNT ? names[type] : "unknown shape";
}

[[nodiscard]] constexpr const char* motion_name(PlumbMotion motion) {
  constexpr const char* names[PLUMB_MOTION_COUNT] = {"static", "kinematic", "dynamic"};
  return motion < PLUMB_MOTION_COUNT ? names[motion] : "unknown motion";
}

[[nodiscard]] constexpr const char* joint_name(PlumbJointType type) {
  constexpr const char* names[PLUMB_JOINT_TYPE_COUNT] = {"ball",  "hinge",     "slider", "distance",
                                                         "fixed", "universal", "generic"};
  return type < PLUMB_JOINT_TYPE_COUNT ? names[type] : "unknown joint";
}

[[nodiscard]] constexpr const char* field_name(PlumbField field) {
  constexpr const char* names[PLUMB_FIELD_COUNT] = {"pose",
                                                    "velocity",
                                                    "force",
                                                    "torque",
                                                    "impulse",
                                                    "angular impulse",
                                                    "force at point",
                                                    "impulse at point",
                                                    "awake",
                                                    "kinematic target",
                                                    "mass",
                                                    "material",
                                                    "gravity scale",
                                                    "damping",
                                                    "surface velocity",
                                                    "filter"};
  return field < PLUMB_FIELD_COUNT ? names[field] : "unknown field";
}

/// "PLUMB_NEED_FRICTION" of its bit's index.
[[nodiscard]] constexpr const char* need_name(std::uint32_t index) {
  constexpr const char* names[PLUMB_NEED_COUNT] = {
      "PLUMB_NEED_ROTATION",         "PLUMB_NEED_COLLISION",       "PLUMB_NEED_FRICTION",
      "PLUMB_NEED_RESTITUTION",      "PLUMB_NEED_JOINTS",          "PLUMB_NEED_CCD",
      "PLUMB_NEED_SLEEPING",         "PLUMB_NEED_EVENTS",          "PLUMB_NEED_CONTACTS",
      "PLUMB_NEED_CONTACT_IMPULSES", "PLUMB_NEED_SENSORS",         "PLUMB_NEED_KINEMATIC",
      "PLUMB_NEED_GYROSCOPIC",       "PLUMB_NEED_DAMPING",         "PLUMB_NEED_FORCES",
      "PLUMB_NEED_AXIS_LOCKS",       "PLUMB_NEED_FILTERS",         "PLUMB_NEED_QUERIES",
      "PLUMB_NEED_SURFACE_VELOCITY", "PLUMB_NEED_JOINT_REACTIONS", "PLUMB_NEED_SNAPSHOT"};
  return index < PLUMB_NEED_COUNT ? names[index] : "an unknown need";
}

[[nodiscard]] constexpr bool is_convex(PlumbShapeType type) {
  return type == PLUMB_SPHERE || type == PLUMB_BOX || type == PLUMB_CAPSULE || type == PLUMB_CYLINDER ||
         type == PLUMB_CONVEX_HULL;
}

}  // namespace plumb::backend
