// Lies about the world, its bodies, and what comes out of a step.
#include <cmath>
#include <limits>

#include "changes.hpp"

namespace plumb::lying {

void dynamic_planes() { change_capability<PLUMB_CAP_SHAPE, PLUMB_PLANE, PLUMB_DYNAMIC, PLUMB_NATIVE>(); }
void notes_are_null() {
  liar.core.capability = [](PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char** note) -> PlumbDegree {
    const PlumbDegree truth = honest.core.capability(kind, a, b, nullptr);
    if (note != nullptr) *note = nullptr;
    return truth;
  };
}
void boxes_declared_apart() { change_capability<PLUMB_CAP_PAIR, PLUMB_BOX, PLUMB_BOX, PLUMB_NONE>(); }
void inertia_doubled_in_words() {
  change_reads<PLUMB_FIELD_MASS, [](double* row) {
    for (int i = 4; i < 7; ++i) row[i] *= 2;
  }>();
}
void mass_halved_in_words() {
  change_reads<PLUMB_FIELD_MASS, [](double* row) { row[0] /= 2; }>();
}
void lost_bodies_not_told() {
  change_reads<PLUMB_FIELD_POSE, [](double* row) {
    if (1000 < std::hypot(row[0], row[1], row[2])) row[1] = std::numeric_limits<double>::quiet_NaN();
  }>();
}
void spheres_too_large() {
  change_shapes<[](PlumbShapeDesc& desc) {
    if (desc.type == PLUMB_SPHERE) desc.radius *= 1.3;
  }>();
}
void children_without_material() {
  change_shapes<[](PlumbShapeDesc& desc) {
    static std::vector<PlumbCompoundChild> children;  // the honest one copies them before the call returns
    if (desc.type != PLUMB_COMPOUND) return;
    children.assign(desc.children, desc.children + desc.child_count);
    for (PlumbCompoundChild& child : children) child.has_material = 0;
    desc.children = children.data();
  }>();
}

void triangles_without_material() {
  change_shapes<[](PlumbShapeDesc& desc) {
    if (desc.type == PLUMB_TRIANGLE_MESH) desc.material_count = 0;
  }>();
}
void cells_without_material() {
  change_shapes<[](PlumbShapeDesc& desc) {
    if (desc.type == PLUMB_HEIGHT_FIELD) desc.material_count = 0;
  }>();
}
void triangles_that_run_are_taken() {
  change_shapes<[](PlumbShapeDesc& desc) {
    static PlumbMaterial standing;
    if (desc.material_count != 1 || desc.materials == nullptr) return;
    standing = desc.materials[0];
    standing.surface_velocity = {};
    desc.materials = &standing;
  }>();
}

void gravity_too_weak() {
  change_worlds<[](PlumbWorldDesc& desc) { desc.gravity.y *= 0.99; }>();
}
void gravity_scale_ignored() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.gravity_scale = 1; }>();
}
void damping_ignored() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.linear_damping = 0; }>();
}
void centre_of_mass_ignored() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.centre_of_mass = {0, 0, 0}; }>();
}
void principal_axes_ignored() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.inertia_orientation = identity_pose().orientation; }>();
}
void particles_float() {
  change_bodies<[](PlumbBodyDesc& desc) {
    if (desc.shape == 0) desc.gravity_scale = 0;
  }>();
}
void locks_ignored() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.locks = 0; }>();
}
void sensors_are_solid() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.flags &= ~std::uint32_t{PLUMB_BODY_SENSOR}; }>();
}
void filters_ignored() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.filter = body_desc().filter; }>();
}
void ccd_ignored() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.flags &= ~std::uint32_t{PLUMB_BODY_CCD}; }>();
}
void half_friction() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.material.friction /= 2; }>();
}
void no_restitution() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.material.restitution = 0; }>();
}
void belts_stand_still() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.material.surface_velocity = {0, 0, 0}; }>();
}
void balls_roll_for_ever() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.rolling_friction = 0; }>();
}
void balls_spin_for_ever() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.spinning_friction = 0; }>();
}
void rolling_friction_not_written() { lose_writes<PLUMB_FIELD_ROLLING_FRICTION>(); }

void torques_lost() { lose_writes<PLUMB_FIELD_TORQUE>(); }
void velocities_not_written() { lose_writes<PLUMB_FIELD_VELOCITY>(); }
void poses_not_written() { lose_writes<PLUMB_FIELD_POSE>(); }
void targets_ignored() { lose_writes<PLUMB_FIELD_KINEMATIC_TARGET>(); }
void materials_not_written() { lose_writes<PLUMB_FIELD_MATERIAL>(); }

void stale_handles_are_read() {
  liar.core.read = [](PlumbWorld* world, PlumbField field, PlumbDataType type, const PlumbBody* ids,
                      std::uint32_t count, void* rows, std::size_t stride) -> PlumbResult {
    const PlumbResult result = honest.core.read(world, field, type, ids, count, rows, stride);
    if (result != PLUMB_E_STALE_HANDLE) return result;
    std::memset(rows, 0, count * stride);
    return PLUMB_OK;
  };
}
void bodies_listed_backwards() {
  liar.core.list_bodies = [](PlumbWorld* world, PlumbBody* ids, std::uint32_t capacity, std::uint32_t* count) {
    const PlumbResult result = honest.core.list_bodies(world, ids, capacity, count);
    if (result >= 0) std::reverse(ids, ids + std::min(capacity, *count));
    return result;
  };
}
void bad_gravity_is_done() {
  liar.core.set_gravity = [](PlumbWorld* world, const PlumbVec3* gravity) -> PlumbResult {
    return std::max<PlumbResult>(PLUMB_OK, honest.core.set_gravity(world, gravity));
  };
}

void steps_are_not_counted() {
  change_reports<[](PlumbStepReport& report) { report.step = 1; }>();
}
void all_asleep_in_words() {
  change_reports<[](PlumbStepReport& report) { report.awake = 0; }>();
}
void contacts_never_end() { hide_events<PLUMB_EVENT_CONTACT_END>(); }
void sleep_is_not_told() { hide_events<PLUMB_EVENT_SLEEP>(); }
void normals_turned_round() {
  change_contacts<[](PlumbContact& contact) {
    contact.normal = {-contact.normal.x, -contact.normal.y, -contact.normal.z};
  }>();
}
void no_tangent_impulses() {
  change_contacts<[](PlumbContact& contact) { contact.tangent_impulse = {0, 0, 0}; }>();
}

}  // namespace plumb::lying
