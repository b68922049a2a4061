// The words of a manifest for what plumb.h numbers.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "plumb/plumb.h"

namespace plumb::wire {

using Words = std::span<const char* const>;

inline constexpr const char* kKindWords[PLUMB_CAP_COUNT] = {
    "shape",  "pair",     "joint",      "joint_feature",     "query",    "read",       "write",
    "need",   "event",    "phase_time", "residual",          "snapshot", "host_jobs",  "child_material",
    "modify", "manifold", "closest",    "triangle_material", "cooking",  "host_memory"};
static_assert(kKindWords[PLUMB_CAP_COUNT - 1] != nullptr, "a capability has no word");
inline constexpr const char* kShapeWords[PLUMB_SHAPE_TYPE_COUNT] = {
    "sphere", "box", "capsule", "cylinder", "hull", "mesh", "height_field", "plane", "compound"};
inline constexpr const char* kMotionWords[PLUMB_MOTION_COUNT] = {"static", "kinematic", "dynamic"};
inline constexpr const char* kJointWords[PLUMB_JOINT_TYPE_COUNT] = {
    "ball", "hinge", "slider", "distance", "fixed", "universal", "generic", "swing_twist", "gear", "rack_and_pinion"};
inline constexpr const char* kFeatureWords[PLUMB_JOINT_FEATURE_COUNT] = {"limits",   "motors",    "springs", "breaks",
                                                                         "reaction", "stiffness", "targets"};
inline constexpr const char* kQueryWords[PLUMB_QUERY_KIND_COUNT] = {"ray", "cast", "overlap", "penetration",
                                                                    "turning_cast"};
inline constexpr const char* kFieldWords[PLUMB_FIELD_COUNT] = {"pose",
                                                               "velocity",
                                                               "force",
                                                               "torque",
                                                               "impulse",
                                                               "angular_impulse",
                                                               "force_at_point",
                                                               "impulse_at_point",
                                                               "awake",
                                                               "kinematic_target",
                                                               "mass",
                                                               "material",
                                                               "gravity_scale",
                                                               "damping",
                                                               "surface_velocity",
                                                               "filter",
                                                               "rolling_friction"};
inline constexpr const char* kNeedWords[PLUMB_NEED_COUNT] = {
    "rotation",         "collision",       "friction", "restitution",          "joints",          "ccd",
    "sleeping",         "events",          "contacts", "contact_impulses",     "sensors",         "kinematic",
    "gyroscopic",       "damping",         "forces",   "axis_locks",           "filters",         "queries",
    "surface_velocity", "joint_reactions", "snapshot", "contact_modification", "rolling_friction"};
inline constexpr const char* kEventWords[PLUMB_EVENT_COUNT] = {
    "contact_begin", "contact_end", "sensor_enter", "sensor_leave", "wake", "sleep", "joint_broken"};
inline constexpr const char* kDegreeWords[] = {"none", "approximate", "emulated", "native"};

/// The words that the two arguments of a question may have; empty where it takes none.
struct ArgumentWords {
  Words first, second;
};
[[nodiscard]] inline ArgumentWords argument_words(PlumbCapability kind) {
  switch (kind) {
    case PLUMB_CAP_SHAPE: return {kShapeWords, kMotionWords};
    case PLUMB_CAP_PAIR: return {kShapeWords, kShapeWords};
    case PLUMB_CAP_JOINT: return {kJointWords, {}};
    case PLUMB_CAP_JOINT_FEATURE: return {kJointWords, kFeatureWords};
    case PLUMB_CAP_QUERY: return {kQueryWords, kShapeWords};
    case PLUMB_CAP_FIELD_READ:
    case PLUMB_CAP_FIELD_WRITE: return {kFieldWords, {}};
    case PLUMB_CAP_NEED: return {kNeedWords, {}};
    case PLUMB_CAP_EVENT: return {kEventWords, {}};
    default: return {};
  }
}

}  // namespace plumb::wire
