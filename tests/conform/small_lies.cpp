// Small lies: engines that are nearly right. An eye on a picture would not notice any of them.
#include <cmath>

#include "changes.hpp"

namespace plumb::lying {
namespace {

PlumbVec3 scaled(const PlumbVec3& v, double by) { return {v.x * by, v.y * by, v.z * by}; }
PlumbVec3 sum(const PlumbVec3& a, const PlumbVec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

PlumbVec3 cross(const PlumbVec3& a, const PlumbVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// v turned by q, or by its inverse.
PlumbVec3 turned(const PlumbQuat& q, const PlumbVec3& v, bool back) {
  const PlumbVec3 u = scaled({q.x, q.y, q.z}, back ? -1 : 1), t = scaled(cross(u, v), 2);
  return sum(sum(v, scaled(t, q.w)), cross(u, t));
}

/// Leans by about that angle, whichever way it points.
void lean(PlumbVec3& normal, double angle) {
  const PlumbVec3 away = std::abs(normal.x) < 0.5 ? PlumbVec3{1, 0, 0} : PlumbVec3{0, 1, 0};
  normal = sum(normal, scaled(cross(normal, away), angle));
}

/// After every step each body's velocity is changed.
template <auto change>
void change_velocities_for_good() {
  liar.core.wait = [](PlumbWorld* world, PlumbStepReport* report) {
    const PlumbResult result = honest.core.wait(world, report);
    std::vector<PlumbBody> ids(1000);
    std::uint32_t count = 0;
    if (honest.core.list_bodies(world, ids.data(), 1000, &count) != PLUMB_OK) return result;
    for (std::uint32_t i = 0; i < count; ++i) {
      double row[6];
      honest.core.read(world, PLUMB_FIELD_VELOCITY, PLUMB_F64, &ids[i], 1, row, sizeof row);
      change(row);
      if (row[0] != 0 || row[1] != 0 || row[2] != 0 || row[3] != 0 || row[4] != 0 || row[5] != 0)
        honest.core.write(world, PLUMB_FIELD_VELOCITY, PLUMB_F64, &ids[i], 1, row, sizeof row);
    }
    return result;
  };
}

}  // namespace

void gravity_one_per_mille_too_strong() {
  change_worlds<[](PlumbWorldDesc& desc) { desc.gravity = scaled(desc.gravity, 1.001); }>();
}
void gravity_pulls_along_y_alone() {
  change_worlds<[](PlumbWorldDesc& desc) { desc.gravity.x = desc.gravity.z = 0; }>();
}
void steps_one_per_mille_too_long() {
  liar.core.step = [](PlumbWorld* world, const PlumbStepDesc* desc) {
    PlumbStepDesc changed = *desc;
    changed.dt *= 1.001;
    return honest.core.step(world, &changed);
  };
}
void no_gyroscopic_term() {
  change_worlds<[](PlumbWorldDesc& desc) { desc.needs &= ~PLUMB_NEED_GYROSCOPIC; }>();
}

void friction_five_percent_low() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.material.friction *= 0.95; }>();
}
void friction_three_percent_high() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.material.friction *= 1.03; }>();
}
void friction_is_the_product() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.material.friction *= desc.material.friction; }>();
}
void restitution_three_percent_low() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.material.restitution *= 0.97; }>();
}
void restitution_three_percent_high() {
  change_bodies<[](PlumbBodyDesc& desc) {
    desc.material.restitution = std::min(1.0, desc.material.restitution * 1.03);
  }>();
}
void belts_two_percent_slow() {
  change_bodies<[](PlumbBodyDesc& desc) {
    desc.material.surface_velocity = scaled(desc.material.surface_velocity, 0.98);
  }>();
}
void belts_in_world_axes() {
  change_bodies<[](PlumbBodyDesc& desc) {
    desc.material.surface_velocity = turned(desc.pose.orientation, desc.material.surface_velocity, true);
  }>();
}
void linear_damping_two_percent_weak() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.linear_damping *= 0.98; }>();
}
void angular_damping_two_percent_strong() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.angular_damping *= 1.02; }>();
}
void gravity_scale_one_percent_off() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.gravity_scale *= 1.01; }>();
}
void mass_one_per_mille_high() {
  change_bodies<[](PlumbBodyDesc& desc) {
    desc.mass *= 1.001;
    desc.density *= 1.001;
  }>();
}
void inertia_one_percent_high() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.inertia = scaled(desc.inertia, 1.01); }>();
}
void centre_of_mass_five_millimetres_off() {
  change_bodies<[](PlumbBodyDesc& desc) {
    desc.centre_of_mass.x += desc.mass_mode == PLUMB_MASS_EXPLICIT ? 0.005 : 0;
  }>();
}
void spin_at_creation_lost() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.angular_velocity = {0, 0, 0}; }>();
}
void velocity_at_creation_three_per_mille_low() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.linear_velocity = scaled(desc.linear_velocity, 0.997); }>();
}
void groups_of_filters_ignored() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.filter.group = 0; }>();
}
void highest_category_lost() {
  change_bodies<[](PlumbBodyDesc& desc) { desc.filter.category &= 0x7fffffffU; }>();
}

void spheres_two_millimetres_large() {
  change_shapes<[](PlumbShapeDesc& desc) { desc.radius += desc.type == PLUMB_SPHERE ? 0.002 : 0; }>();
}
void boxes_two_millimetres_small() {
  change_shapes<[](PlumbShapeDesc& desc) {
    if (desc.type == PLUMB_BOX) desc.half_extents = sum(desc.half_extents, {-0.002, -0.002, -0.002});
  }>();
}

void forces_one_percent_weak() {
  change_writes<PLUMB_FIELD_FORCE, [](double* row) { row[0] *= 0.99; }>();
}
void torques_one_percent_strong() {
  change_writes<PLUMB_FIELD_TORQUE, [](double* row) { row[2] *= 1.01; }>();
}
void impulses_one_percent_weak() {
  change_writes<PLUMB_FIELD_IMPULSE, [](double* row) { row[1] *= 0.99; }>();
}
void impulse_points_a_centimetre_off() {
  change_writes<PLUMB_FIELD_IMPULSE_AT_POINT, [](double* row) { row[3] += 0.01; }>();
}
void force_points_taken_from_the_body() {
  change_writes<PLUMB_FIELD_FORCE_AT_POINT, [](double* row) { row[3] += 5; }>();
}
void targets_one_percent_short() {
  change_writes<PLUMB_FIELD_KINEMATIC_TARGET, [](double* row) { row[0] *= 0.99; }>();
}
void targets_do_not_turn() {
  change_writes<PLUMB_FIELD_KINEMATIC_TARGET, [](double* row) {
    row[3] = row[4] = row[5] = 0;
    row[6] = 1;
  }>();
}

void velocities_fade() {
  change_velocities_for_good<[](double* row) {
    for (int i = 0; i < 3; ++i) row[i] *= 0.9998;
  }>();
}
void spins_fade() {
  change_velocities_for_good<[](double* row) {
    for (int i = 3; i < 6; ++i) row[i] *= 0.9998;
  }>();
}
void spins_grow() {
  change_velocities_for_good<[](double* row) {
    for (int i = 3; i < 6; ++i) row[i] *= 1.0001;
  }>();
}
void orientations_turned_round() {
  change_reads<PLUMB_FIELD_POSE, [](double* row) {
    for (int i = 3; i < 6; ++i) row[i] = -row[i];
  }>();
}
void positions_a_tenth_of_a_millimetre_off() {
  change_reads<PLUMB_FIELD_POSE, [](double* row) { row[0] += 1e-4; }>();
}
void spin_in_body_axes() {
  liar.core.read = [](PlumbWorld* world, PlumbField field, PlumbDataType type, const PlumbBody* ids,
                      std::uint32_t count, void* rows, std::size_t stride) {
    const PlumbResult result = honest.core.read(world, field, type, ids, count, rows, stride);
    if (result < 0 || field != PLUMB_FIELD_VELOCITY || ids == nullptr || count != 1) return result;
    PlumbPose pose;
    honest.core.read(world, PLUMB_FIELD_POSE, PLUMB_F64, ids, 1, &pose, sizeof pose);
    change_rows(type, rows, stride, count, [&](double* row) {
      const PlumbVec3 spin = turned(pose.orientation, {row[3], row[4], row[5]}, true);
      row[3] = spin.x, row[4] = spin.y, row[5] = spin.z;
    });
    return result;
  };
}

void normals_lean_by_half_a_degree() {
  change_contacts<[](PlumbContact& contact) { lean(contact.normal, 0.009); }>();
}
void contacts_a_centimetre_aside() {
  change_contacts<[](PlumbContact& contact) { contact.position.x += 0.01; }>();
}
void depths_have_the_other_sign() {
  change_contacts<[](PlumbContact& contact) { contact.depth = -contact.depth; }>();
}
void normal_impulses_two_percent_low() {
  change_contacts<[](PlumbContact& contact) { contact.normal_impulse *= 0.98; }>();
}
void tangent_impulses_three_percent_high() {
  change_contacts<[](PlumbContact& contact) { contact.tangent_impulse = scaled(contact.tangent_impulse, 1.03); }>();
}
void tangent_impulses_on_the_other() {
  change_contacts<[](PlumbContact& contact) { contact.tangent_impulse = scaled(contact.tangent_impulse, -1); }>();
}

void ray_fractions_one_per_mille_long() {
  change_ray_hits<[](PlumbHit& hit) { hit.fraction = std::min(1.0, hit.fraction * 1.001); }>();
}
void ray_normals_lean_by_a_degree() {
  change_ray_hits<[](PlumbHit& hit) { lean(hit.normal, 0.017); }>();
}
void ray_points_three_millimetres_off() {
  change_ray_hits<[](PlumbHit& hit) { hit.position = sum(hit.position, scaled(hit.normal, 0.003)); }>();
}
void casts_do_not_turn() {
  change_casts<[](PlumbCast& cast) { cast.pose.orientation = {0, 0, 0, 1}; }>();
}
void casts_one_percent_long() {
  change_casts<[](PlumbCast& cast) { cast.translation = scaled(cast.translation, 0.99); }>();
}
void overlaps_by_a_centimetre_more() {
  change_shapes<[](PlumbShapeDesc& desc) {
    if (desc.type == PLUMB_SPHERE && desc.radius == 0.25) desc.radius += 0.01;
  }>();
}
void pair_depths_two_millimetres_low() {
  change_pairs<[](PlumbPairResult& result, PlumbPairPoint* points) {
    for (std::uint32_t i = 0; i < result.point_count; ++i) points[i].depth -= 0.002;
  }>();
}
void pair_distances_without_sign() {
  change_pairs<[](PlumbPairResult& result, PlumbPairPoint*) { result.distance = std::abs(result.distance); }>();
}
void pair_normals_turned_round() {
  change_pairs<[](PlumbPairResult& result, PlumbPairPoint* points) {
    for (std::uint32_t i = 0; i < result.point_count; ++i) points[i].normal = scaled(points[i].normal, -1);
  }>();
}

void motors_two_percent_fast() {
  change_joints<[](PlumbJointDesc& desc) {
    for (PlumbMotor& motor : desc.motors) motor.target_velocity *= 1.02;
  }>();
}
void motors_five_percent_strong() {
  change_joints<[](PlumbJointDesc& desc) {
    for (PlumbMotor& motor : desc.motors) motor.max_force *= 1.05;
  }>();
}
void stops_a_centimetre_late() {
  change_joints<[](PlumbJointDesc& desc) {
    for (PlumbLimit& limit : desc.limits) {
      limit.lower -= 0.01;
      limit.upper += 0.01;
    }
  }>();
}
void springs_two_percent_stiff() {
  change_joints<[](PlumbJointDesc& desc) {
    for (PlumbSpring& spring : desc.springs) spring.frequency *= 1.02;
  }>();
}
void springs_damped_by_a_quarter_more() {
  change_joints<[](PlumbJointDesc& desc) {
    for (PlumbSpring& spring : desc.springs) spring.damping_ratio *= 1.25;
  }>();
}
void dampers_a_twentieth_strong() {
  change_joints<[](PlumbJointDesc& desc) {
    for (PlumbSpring& spring : desc.springs)
      if (spring.mode == PLUMB_SPRING_STIFFNESS) spring.damping_ratio *= 1.05;
  }>();
}
void springs_by_stiffness_a_twentieth_stiff() {
  change_joints<[](PlumbJointDesc& desc) {
    for (PlumbSpring& spring : desc.springs)
      if (spring.mode == PLUMB_SPRING_STIFFNESS) spring.frequency *= 1.05;
  }>();
}
void rods_two_millimetres_long() {
  change_joints<[](PlumbJointDesc& desc) { desc.rest_length += 0.002; }>();
}
void joints_gape_by_three_millimetres() {
  change_joints<[](PlumbJointDesc& desc) { desc.frame_b.position.y += 0.003; }>();
}
void joints_break_at_two_thirds() {
  change_joints<[](PlumbJointDesc& desc) { desc.break_force *= 2.0 / 3; }>();
}
void joints_break_a_third_late() {
  change_joints<[](PlumbJointDesc& desc) { desc.break_force *= 4.0 / 3; }>();
}
void reactions_one_percent_low() {
  change_joint_reads<[](double* row) {
    for (int i = 0; i < 6; ++i) row[i] *= 0.99;
  }>();
}
void reactions_on_the_other_body() {
  change_joint_reads<[](double* row) {
    for (int i = 0; i < 6; ++i) row[i] = -row[i];
  }>();
}

void groups_lose_their_gravity() {
  liar.worlds.group = [](PlumbWorld* world, PlumbWorld* const* others, std::uint32_t count) {
    const PlumbVec3 none = {0, 0, 0};
    if (count != 0) (void)honest.core.set_gravity(others[0], &none);
    return honest.worlds.group(world, others, count);
  };
}

}  // namespace plumb::lying
