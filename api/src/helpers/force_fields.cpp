#include "plumb/helpers/force_fields.hpp"

#include <algorithm>
#include <cmath>

#include "common.hpp"

namespace plumb::helpers {
namespace {

/// World axes of I^w for principal moments.
PlumbVec3 apply_inertia(const MassRow& mass, const PlumbQuat& orientation, const PlumbVec3& w) {
  const PlumbQuat axes = multiply(orientation, mass.orientation);
  const PlumbVec3 local = unrotate(axes, w);
  return rotate(axes, {mass.inertia.x * local.x, mass.inertia.y * local.y, mass.inertia.z * local.z});
}

MassRow mass_row(const double* row) {
  return {row[0], {row[1], row[2], row[3]}, {row[4], row[5], row[6]}, {row[7], row[8], row[9], row[10]}};
}
Velocity velocity_row(const double* row) { return {{row[0], row[1], row[2]}, {row[3], row[4], row[5]}}; }

Rows rows_of(std::vector<double>& numbers, std::size_t columns) {
  return {reinterpret_cast<std::byte*>(numbers.data()), numbers.size() / columns, columns * sizeof(double), PLUMB_F64};
}

}  // namespace

ForceFields::ForceFields(IPhysicsWorld& world, std::span<const PlumbBody> bodies)
    : world_(world),
      bodies_(bodies.begin(), bodies.end()),
      masses_(11 * bodies.size()),
      poses_(bodies.size()),
      velocities_(6 * bodies.size()),
      centres_(bodies.size()),
      forces_(bodies.size()),
      torques_(bodies.size()) {
  gather();
  apply();  // zeros: says at once where forces were not declared
}

void ForceFields::gather() {
  read_rows(world_, PLUMB_FIELD_POSE, bodies_, std::span(poses_));
  if (!bodies_.empty()) {
    check(world_, world_.read(PLUMB_FIELD_MASS, bodies_, rows_of(masses_, 11)));
    check(world_, world_.read(PLUMB_FIELD_VELOCITY, bodies_, rows_of(velocities_, 6)));
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) centres_[i] = centre_of_mass(poses_[i], mass_row(&masses_[11 * i]));
  std::fill(forces_.begin(), forces_.end(), PlumbVec3{});
  std::fill(torques_.begin(), torques_.end(), PlumbVec3{});
}

void ForceFields::apply() {
  write_rows(world_, PLUMB_FIELD_FORCE, bodies_, std::span<const PlumbVec3>(forces_));
  write_rows(world_, PLUMB_FIELD_TORQUE, bodies_, std::span<const PlumbVec3>(torques_));
}

bool ForceFields::within(const Zone& zone, std::size_t index) const {
  return zone.radius == 0 || length(sub(centres_[index], zone.centre)) <= zone.radius;
}

void ForceFields::add(const DirectionalGravity& field) {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (within(field.zone, i)) forces_[i] = helpers::add(forces_[i], scale(masses_[11 * i], field.acceleration));
}

void ForceFields::add(const PointGravity& field) {
  require(field.reference_distance > 0, "point gravity: reference_distance must be above 0");
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!within(field.zone, i)) continue;
    const PlumbVec3 inward = sub(field.zone.centre, centres_[i]);
    const double distance = length(inward);
    if (distance == 0) continue;
    const double ratio =
        field.reference_distance / (field.exponent > 0 ? std::max(distance, field.reference_distance) : distance);
    const double force = masses_[11 * i] * field.strength * std::pow(ratio, field.exponent);
    forces_[i] = helpers::add(forces_[i], scale(force / distance, inward));
  }
}

void ForceFields::add(const Wind& field) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!within(field.zone, i)) continue;
    const PlumbVec3 against = sub(field.velocity, velocity_row(&velocities_[6 * i]).linear);
    const double drag = 0.5 * field.density * field.drag_area * length(against);
    forces_[i] = helpers::add(forces_[i], scale(drag, against));
  }
}

void ForceFields::float_sphere(std::size_t index, double radius, const Water& water) {
  const double volume = 4.0 / 3 * std::acos(-1.0) * radius * radius * radius;
  add_water(index, submerged_sphere(poses_[index].position, radius, water.point, water.up), volume, water);
}

void ForceFields::float_hull(std::size_t index, const Hull& hull, const Water& water) {
  // A plane above all of it has all of it below.
  double reach = 0;
  for (const PlumbVec3& vertex : hull.vertices) reach = std::max(reach, length(vertex));
  const PlumbVec3 above = helpers::add(poses_[index].position, scale(reach, water.up));
  const double volume = submerged_hull(hull, poses_[index], above, water.up).volume;
  add_water(index, submerged_hull(hull, poses_[index], water.point, water.up), volume, water);
}

void ForceFields::add_water(std::size_t index, const Submerged& below, double volume, const Water& water) {
  if (below.volume <= 0) return;
  const double displaced = water.density * below.volume;
  const Velocity velocity = velocity_row(&velocities_[6 * index]);
  const PlumbVec3 arm = sub(below.centroid, centres_[index]);
  const PlumbVec3 slip = sub(helpers::add(velocity.linear, cross(velocity.angular, arm)), water.flow);
  const PlumbVec3 force = sub(scale(displaced * water.gravity, water.up), scale(displaced * water.linear_drag, slip));
  const PlumbVec3 momentum = apply_inertia(mass_row(&masses_[11 * index]), poses_[index].orientation, velocity.angular);
  forces_[index] = helpers::add(forces_[index], force);
  torques_[index] = helpers::add(torques_[index],
                                 sub(cross(arm, force), scale(water.angular_drag * below.volume / volume, momentum)));
}

std::size_t explode(IPhysicsWorld& world, std::span<const PlumbBody> bodies, const Explosion& explosion) {
  require(std::isfinite(explosion.radius) && explosion.radius > 0,
          "explosion: a radius of " + std::to_string(explosion.radius) + " m: give one above 0");
  std::vector<PlumbPose> poses(bodies.size());
  std::vector<MassRow> masses(bodies.size());
  read_rows(world, PLUMB_FIELD_POSE, bodies, std::span(poses));
  read_rows(world, PLUMB_FIELD_MASS, bodies, std::span(masses));
  std::vector<PlumbBody> hit;
  std::vector<PlumbVec3> impulses;
  std::vector<PlumbRay> rays;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const PlumbVec3 outward = sub(centre_of_mass(poses[i], masses[i]), explosion.centre);
    const double distance = length(outward);
    if (distance >= explosion.radius) continue;
    hit.push_back(bodies[i]);
    impulses.push_back(scale(explosion.impulse * (1 - distance / explosion.radius), direction(outward, {0, 1, 0})));
    rays.push_back({explosion.centre, distance > 0 ? outward : PlumbVec3{0, 1e-6, 0}, {1, 0xffffffffu, 0, 0}});
  }
  if (explosion.line_of_sight && !rays.empty()) {
    IQueries& queries =
        require_extension(world.queries(), "explosion with line of sight", PLUMB_EXT_QUERIES, "PLUMB_NEED_QUERIES");
    const Hits seen = queries.cast_rays(PLUMB_HIT_CLOSEST, rays);
    check(world, seen.result);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < hit.size(); ++i) {
      if (seen.hits[i].body != 0 && seen.hits[i].body != hit[i]) continue;
      hit[kept] = hit[i];
      impulses[kept++] = impulses[i];
    }
    hit.resize(kept);
    impulses.resize(kept);
  }
  write_rows(world, PLUMB_FIELD_IMPULSE, std::span<const PlumbBody>(hit), std::span<const PlumbVec3>(impulses));
  return hit.size();
}

}  // namespace plumb::helpers
