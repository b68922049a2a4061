// Descriptors as the rows that WIRE.md lists.
#include "append.hpp"
#include "plumb/physics_world.hpp"
#include "world.hpp"

namespace plumb::wire {
namespace {

void append_material(std::vector<double>& row, const PlumbMaterial& material) {
  row.insert(row.end(), {material.friction, material.restitution});
  append(row, material.surface_velocity);
}

void append_children(std::vector<double>& row, const PlumbShapeDesc& desc) {
  row.push_back(desc.child_count);
  for (const PlumbCompoundChild& child : std::span(desc.children, desc.child_count)) {
    row.push_back(slot_of(child.shape));
    append(row, child.pose);
    row.push_back(child.has_material);
    append_material(row, child.material);
  }
}

}  // namespace

void append_shape(std::vector<double>& row, std::uint32_t slot, const PlumbShapeDesc& desc) {
  row.insert(row.end(), {double(slot), double(desc.type)});
  const std::size_t coordinates = std::size_t{3} * desc.vertex_count;
  switch (desc.type) {
    case PLUMB_SPHERE: row.push_back(desc.radius); break;
    case PLUMB_BOX: append(row, desc.half_extents); break;
    case PLUMB_CAPSULE:
    case PLUMB_CYLINDER: row.insert(row.end(), {desc.radius, desc.half_height}); break;
    case PLUMB_CONVEX_HULL:
      row.push_back(desc.vertex_count);
      row.insert(row.end(), desc.vertices, desc.vertices + coordinates);
      break;
    case PLUMB_TRIANGLE_MESH:
      row.insert(row.end(), {double(desc.vertex_count), double(desc.triangle_count)});
      row.insert(row.end(), desc.vertices, desc.vertices + coordinates);
      row.insert(row.end(), desc.indices, desc.indices + std::size_t{3} * desc.triangle_count);
      break;
    case PLUMB_HEIGHT_FIELD:
      row.insert(row.end(), {double(desc.rows), double(desc.columns), desc.spacing.x, desc.spacing.z});
      row.insert(row.end(), desc.heights, desc.heights + std::size_t{desc.rows} * desc.columns);
      break;
    case PLUMB_COMPOUND: append_children(row, desc); break;
    default: break;
  }
}

void append_body(std::vector<double>& row, std::uint32_t slot, const PlumbBodyDesc& desc) {
  row.insert(row.end(), {double(slot), double(desc.motion), double(desc.flags), double(desc.locks),
                         desc.shape == 0 ? -1.0 : double(slot_of(desc.shape))});
  append(row, desc.pose);
  append(row, without_locked(desc.linear_velocity, desc.locks));
  append(row, without_locked(desc.angular_velocity, desc.locks >> 3));
  row.push_back(desc.motion == PLUMB_DYNAMIC ? desc.mass : 0);
  append(row, desc.motion == PLUMB_DYNAMIC ? desc.centre_of_mass : PlumbVec3{});
  append(row, desc.motion == PLUMB_DYNAMIC ? desc.inertia : PlumbVec3{});
  append(row, desc.motion == PLUMB_DYNAMIC ? desc.inertia_orientation : PlumbQuat{0, 0, 0, 1});
  append_material(row, desc.material);
  row.insert(row.end(), {desc.gravity_scale, desc.linear_damping, desc.angular_damping});
  append(row, desc.filter);
}

void append_joint(std::vector<double>& row, std::uint32_t slot, const PlumbJointDesc& desc) {
  row.insert(row.end(), {double(slot), double(desc.type), desc.body_a == 0 ? -1.0 : double(slot_of(desc.body_a)),
                         double(slot_of(desc.body_b))});
  append(row, desc.frame_a);
  append(row, desc.frame_b);
  row.insert(row.end(), {double(desc.collide_connected), desc.rest_length});
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const PlumbLimit& limit = desc.limits[axis];
    const PlumbMotor& motor = desc.motors[axis];
    const PlumbSpring& spring = desc.springs[axis];
    row.insert(row.end(),
               {double(desc.axis_modes[axis]), double(limit.enabled), limit.lower, limit.upper, double(motor.enabled),
                motor.target_velocity, motor.max_force, double(spring.enabled != 0 ? 1 + spring.mode : 0), spring.rest,
                spring.frequency, spring.damping_ratio});
  }
}

}  // namespace plumb::wire
