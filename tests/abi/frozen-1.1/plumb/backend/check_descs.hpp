// Ranges of the numbers in shape, body and joint descriptors: what every engine may rely on.
#pragma once

#include "plumb/backend/checks.hpp"
#include "plumb/backend/names.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::backend {

inline void check_material(const Where& where, const char* member, const PlumbMaterial& material) {
  const std::string name(member);
  require_not_negative(where, (name + ".friction").c_str(), material.friction);
  if (!(material.restitution >= 0 && material.restitution <= 1))
    refuse_value(where, (name + ".restitution").c_str(), material.restitution, "from 0 to 1");
  require_finite(where, (name + ".surface_velocity").c_str(), material.surface_velocity);
}

inline void check_vertices(const Where& where, const PlumbShapeDesc& desc, std::uint32_t least) {
  if (desc.vertex_count < least)
    refuse(PLUMB_E_INVALID_ARGUMENT, where.member("vertex_count") + " is " + std::to_string(desc.vertex_count) +
                                         "; a " + shape_name(desc.type) + " needs at least " + std::to_string(least));
  require_pointer(desc.vertices, desc.vertex_count, where.member("vertices").c_str());
  for (std::size_t i = 0; i < std::size_t{desc.vertex_count} * 3; ++i)
    if (!std::isfinite(desc.vertices[i]))
      refuse_value(where, ("vertices[" + std::to_string(i) + "]").c_str(), desc.vertices[i], "finite");
}

inline void check_mesh(const Where& where, const PlumbShapeDesc& desc) {
  check_vertices(where, desc, 3);
  if (desc.triangle_count == 0) refuse_value(where, "triangle_count", 0, "at least 1");
  require_pointer(desc.indices, desc.triangle_count, where.member("indices").c_str());
  for (std::size_t i = 0; i < std::size_t{desc.triangle_count} * 3; ++i)
    if (desc.indices[i] >= desc.vertex_count)
      refuse_value(where, ("indices[" + std::to_string(i) + "]").c_str(), desc.indices[i], "below vertex_count");
}

inline void check_height_field(const Where& where, const PlumbShapeDesc& desc) {
  if (desc.rows < 2) refuse_value(where, "rows", desc.rows, "at least 2");
  if (desc.columns < 2) refuse_value(where, "columns", desc.columns, "at least 2");
  require_positive(where, "spacing.x", desc.spacing.x);
  require_positive(where, "spacing.z", desc.spacing.z);
  const std::size_t count = std::size_t{desc.rows} * desc.columns;
  require_pointer(desc.heights, count, where.member("heights").c_str());
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isfinite(desc.heights[i]))
      refuse_value(where, ("heights[" + std::to_string(i) + "]").c_str(), desc.heights[i], "finite");
}

/// All but the children's handles, which need the world.
inline void check_shape(const Where& where, const PlumbShapeDesc& desc) {
  switch (desc.type) {
    case PLUMB_SPHERE: return require_positive(where, "radius", desc.radius);
    case PLUMB_BOX:
      require_positive(where, "half_extents.x", desc.half_extents.x);
      require_positive(where, "half_extents.y", desc.half_extents.y);
      return require_positive(where, "half_extents.z", desc.half_extents.z);
    case PLUMB_CAPSULE:
      require_positive(where, "radius", desc.radius);
      return require_not_negative(where, "half_height", desc.half_height);
    case PLUMB_CYLINDER:
      require_positive(where, "radius", desc.radius);
      return require_positive(where, "half_height", desc.half_height);
    case PLUMB_CONVEX_HULL: return check_vertices(where, desc, 4);
    case PLUMB_TRIANGLE_MESH: return check_mesh(where, desc);
    case PLUMB_HEIGHT_FIELD: return check_height_field(where, desc);
    case PLUMB_PLANE: return;
    case PLUMB_COMPOUND:
      if (desc.child_count == 0) refuse_value(where, "child_count", 0, "at least 1");
      require_pointer(desc.children, desc.child_count, where.member("children").c_str());
      for (std::uint32_t i = 0; i < desc.child_count; ++i) {
        const std::string child = "children[" + std::to_string(i) + "]";
        require_pose(where, (child + ".pose").c_str(), desc.children[i].pose);
        if (desc.children[i].has_material != 0)
          check_material(where, (child + ".material").c_str(), desc.children[i].material);
      }
      return;
    default: refuse_value(where, "type", desc.type, "a PlumbShapeType");
  }
}

inline void check_mass(const Where& where, const PlumbBodyDesc& desc) {
  const bool turns = (desc.flags & PLUMB_BODY_NO_ROTATION) == 0;
  switch (desc.mass_mode) {
    case PLUMB_MASS_FROM_DENSITY:
      require_positive(where, "density", desc.density);
      if (desc.shape == 0)
        refuse(PLUMB_E_INVALID_ARGUMENT,
               where.member("mass_mode") + " is PLUMB_MASS_FROM_DENSITY, but the body has no shape; give its mass");
      return;
    case PLUMB_MASS_FROM_TOTAL:
      require_positive(where, "mass", desc.mass);
      if (desc.shape == 0 && turns)
        refuse(
            PLUMB_E_INVALID_ARGUMENT,
            where.member("") +
                " can turn but has neither shape nor inertia; set PLUMB_BODY_NO_ROTATION or use PLUMB_MASS_EXPLICIT");
      return;
    case PLUMB_MASS_EXPLICIT: {
      require_positive(where, "mass", desc.mass);
      require_finite(where, "centre_of_mass", desc.centre_of_mass);
      require_unit(where, "inertia_orientation", desc.inertia_orientation);
      const auto moment = [&](const char* member, double value) {
        if (turns)
          require_positive(where, member, value);
        else
          require_not_negative(where, member, value);
      };
      moment("inertia.x", desc.inertia.x);
      moment("inertia.y", desc.inertia.y);
      return moment("inertia.z", desc.inertia.z);
    }
    default: refuse_value(where, "mass_mode", desc.mass_mode, "a PlumbMassMode");
  }
}

inline void check_body(const Where& where, const PlumbBodyDesc& desc) {
  if (desc.motion >= PLUMB_MOTION_COUNT) refuse_value(where, "motion", desc.motion, "a PlumbMotion");
  require_known_bits(where, "flags", desc.flags, (PLUMB_BODY_NEVER_SLEEPS << 1) - 1);
  require_known_bits(where, "locks", desc.locks, (PLUMB_LOCK_ANGULAR_Z << 1) - 1);
  require_pose(where, "pose", desc.pose);
  require_finite(where, "linear_velocity", desc.linear_velocity);
  require_finite(where, "angular_velocity", desc.angular_velocity);
  check_material(where, "material", desc.material);
  require_finite(where, "gravity_scale", desc.gravity_scale);
  require_not_negative(where, "linear_damping", desc.linear_damping);
  require_not_negative(where, "angular_damping", desc.angular_damping);
  if (desc.motion == PLUMB_DYNAMIC) check_mass(where, desc);
}

inline void check_joint(const Where& where, const PlumbJointDesc& desc) {
  if (desc.type >= PLUMB_JOINT_TYPE_COUNT) refuse_value(where, "type", desc.type, "a PlumbJointType");
  require_pose(where, "frame_a", desc.frame_a);
  require_pose(where, "frame_b", desc.frame_b);
  require_not_negative(where, "rest_length", desc.rest_length);
  require_not_negative(where, "break_force", desc.break_force);
  require_not_negative(where, "break_torque", desc.break_torque);
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const std::string suffix = "[" + std::to_string(axis) + "]";
    if (desc.type == PLUMB_JOINT_GENERIC && desc.axis_modes[axis] > PLUMB_AXIS_LIMITED)
      refuse_value(where, ("axis_modes" + suffix).c_str(), desc.axis_modes[axis], "a PlumbAxisMode");
    const PlumbLimit& limit = desc.limits[axis];
    if (limit.enabled != 0) {
      require_finite(where, ("limits" + suffix + ".lower").c_str(), limit.lower);
      require_finite(where, ("limits" + suffix + ".upper").c_str(), limit.upper);
      if (limit.lower > limit.upper)
        refuse_value(where, ("limits" + suffix + ".lower").c_str(), limit.lower, "not above the upper limit");
    }
    if (desc.motors[axis].enabled != 0) {
      require_finite(where, ("motors" + suffix + ".target_velocity").c_str(), desc.motors[axis].target_velocity);
      require_not_negative(where, ("motors" + suffix + ".max_force").c_str(), desc.motors[axis].max_force);
    }
    if (desc.springs[axis].enabled != 0) {
      require_finite(where, ("springs" + suffix + ".rest").c_str(), desc.springs[axis].rest);
      require_positive(where, ("springs" + suffix + ".frequency").c_str(), desc.springs[axis].frequency);
      require_not_negative(where, ("springs" + suffix + ".damping_ratio").c_str(), desc.springs[axis].damping_ratio);
    }
  }
}

}  // namespace plumb::backend
