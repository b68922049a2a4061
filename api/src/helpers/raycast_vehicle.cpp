#include "plumb/helpers/raycast_vehicle.hpp"

#include <algorithm>
#include <cmath>

#include "rigid_motion.hpp"

namespace plumb::helpers {
namespace {

constexpr int sweeps = 16;  // of Gauss-Seidel over at most a dozen wheels: the rest is below a thousandth

PlumbQuat turn_about(const PlumbVec3& axis, double angle) {
  const PlumbVec3 v = scale(std::sin(angle / 2), axis);
  return {v.x, v.y, v.z, std::cos(angle / 2)};
}

/// Ackermann's steering: every wheel square to the line to one centre, which lies beside the middle of those that do
/// not steer; wheels that all took the same angle would drag each other sideways.
double steering_angle(const RayVehicleSettings& settings, const RayWheel& wheel, double steering) {
  const auto ahead = [&](const RayWheel& of) { return dot(of.mount, settings.forward); };
  double fixed = 0, front = 0, fixed_count = 0, front_count = 0;
  for (const RayWheel& each : settings.wheels) {
    (each.steered ? front : fixed) += ahead(each);
    (each.steered ? front_count : fixed_count) += 1;
  }
  if (fixed_count == 0) return steering;
  fixed /= fixed_count;
  const double left = dot(wheel.mount, cross(settings.up, settings.forward));
  const double slope = std::tan(steering), base = front / front_count - fixed;
  return std::atan((ahead(wheel) - fixed) * slope / (base - left * slope));
}

/// A wheel's contact: two directions, what it may give along them (N s), and what it gives.
struct Tyre {
  std::size_t wheel;
  PlumbVec3 along, across, ground;
  double ease_along, ease_across;
  double most_along, most_across;  // N s
  double rolling;                  // N s: the engine's, which no slip bounds
  double brake;                    // N s, at most
  double j_along = 0, j_across = 0;
};

}  // namespace

RaycastVehicle::RaycastVehicle(IPhysicsWorld& world, PlumbBody chassis, const RayVehicleSettings& settings)
    : world_(world),
      chassis_(chassis),
      settings_(settings),
      states_(settings.wheels.size()),
      impulses_(settings.wheels.size()) {
  require(!settings.wheels.empty(), "ray-cast vehicle: no wheels: give one or more");
  for (const RayWheel& wheel : settings.wheels)
    require(wheel.radius > 0 && wheel.rest_length >= 0 && wheel.stiffness > 0 && wheel.damping >= 0 &&
                wheel.grip_along >= 0 && wheel.grip_across >= 0,
            "ray-cast vehicle: radius and stiffness of a wheel must be above 0, the rest 0 or more");
  for (const RayAxle& axle : settings.axles)
    require(axle.left < states_.size() && axle.right < states_.size(),
            "ray-cast vehicle: an axle names a wheel beyond the last");
  require_extension(world.queries(), "ray-cast vehicle", PLUMB_EXT_QUERIES, "PLUMB_NEED_QUERIES");
  write_one(world, PLUMB_FIELD_FORCE, chassis, PlumbVec3{});  // says at once where forces were not declared
}

void RaycastVehicle::drive(const DriverInput& input, double dt) {
  require(std::isfinite(dt) && dt > 0,
          "ray-cast vehicle: dt is " + std::to_string(dt) + " s: give the step's, above 0");
  RigidMotion chassis = RigidMotion::read(world_, chassis_);
  speed_ = dot(chassis.velocity.linear, rotate(chassis.pose.orientation, settings_.forward));
  chassis.velocity.linear = add(chassis.velocity.linear, scale(dt, settings_.gravity));
  cast(chassis);
  suspend(chassis, dt);
  roll(chassis, input, dt);
  push(dt);
}

void RaycastVehicle::cast(const RigidMotion& chassis) {
  const PlumbVec3 down = scale(-1, rotate(chassis.pose.orientation, settings_.up));
  rays_.clear();
  for (const RayWheel& wheel : settings_.wheels)
    rays_.push_back({add(chassis.pose.position, rotate(chassis.pose.orientation, wheel.mount)),
                     scale(wheel.rest_length + wheel.radius, down), settings_.filter});
  const Hits hits = world_.queries()->cast_rays(PLUMB_HIT_CLOSEST, rays_);
  check(world_, hits.result);
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const RayWheel& wheel = settings_.wheels[i];
    const PlumbHit& hit = hits.hits[i];
    RayWheelState& state = states_[i];
    const double reach = wheel.rest_length + wheel.radius;
    state.on_ground = hit.body != 0;
    state.ground = hit.body;
    state.compression = state.on_ground ? std::min((1 - hit.fraction) * reach, wheel.rest_length) : 0;
    state.contact = hit.position;
    state.normal = hit.normal;
    state.axle = add(rays_[i].origin, scale(wheel.rest_length - state.compression, down));
    impulses_[i] = {};
  }
}

/// Backward Euler of each spring with its share of the chassis: with x compressed, v closing and m the share, the force
/// at the end of the step is (k (x + v dt) + c v) / (1 + dt (c + k dt) / m).
void RaycastVehicle::suspend(RigidMotion& chassis, double dt) {
  const PlumbVec3 up = rotate(chassis.pose.orientation, settings_.up);
  std::vector<double> bars(states_.size(), 0.0);
  for (const RayAxle& axle : settings_.axles) {
    const double force = axle.anti_roll * (states_[axle.left].compression - states_[axle.right].compression);
    bars[axle.left] += force;
    bars[axle.right] -= force;
  }
  const RigidMotion start = chassis;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    RayWheelState& state = states_[i];
    state.load = 0;
    if (!state.on_ground) continue;
    const RayWheel& wheel = settings_.wheels[i];
    const PlumbVec3 ground = RigidMotion::read(world_, state.ground).velocity_at(state.contact);
    const double closing = -dot(sub(start.velocity_at(state.contact), ground), up);
    // Wheels share the chassis: of the mass that one alone would feel each gets its part.
    const double share = start.mass.mass / static_cast<double>(states_.size());
    const double force = (wheel.stiffness * (state.compression + dt * closing) + wheel.damping * closing + bars[i]) /
                         (1 + dt * (wheel.damping + dt * wheel.stiffness) / share);
    // The ground pushes along its normal; what that is along the spring is the spring's force (virtual work).
    state.load = std::max(0.0, force) / std::max(dot(state.normal, up), 0.5);
    impulses_[i] = scale(dt * state.load, state.normal);
    chassis.push(impulses_[i], state.contact);
  }
}

void RaycastVehicle::roll(RigidMotion& chassis, const DriverInput& input, double dt) {
  const PlumbVec3 up = rotate(chassis.pose.orientation, settings_.up);
  const double driven = static_cast<double>(std::count_if(settings_.wheels.begin(), settings_.wheels.end(),
                                                          [](const RayWheel& wheel) { return wheel.driven; }));
  std::vector<Tyre> tyres;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    RayWheelState& state = states_[i];
    state.slides = false;
    if (!state.on_ground || state.load <= 0) continue;
    const RayWheel& wheel = settings_.wheels[i];
    PlumbVec3 heading = rotate(chassis.pose.orientation, settings_.forward);
    if (wheel.steered) heading = rotate(turn_about(up, steering_angle(settings_, wheel, input.steering)), heading);
    Tyre tyre{};
    tyre.wheel = i;
    tyre.along = direction(without(heading, state.normal), heading);
    tyre.across = cross(state.normal, tyre.along);
    tyre.ground = RigidMotion::read(world_, state.ground).velocity_at(state.contact);
    tyre.ease_along = chassis.ease(state.contact, tyre.along);
    tyre.ease_across = chassis.ease(state.contact, tyre.across);
    tyre.most_along = wheel.grip_along * state.load * dt;
    tyre.most_across = wheel.grip_across * state.load * dt;
    tyre.rolling = wheel.driven ? input.drive / driven / wheel.radius * dt : 0;
    tyre.brake = input.brake / wheel.radius * dt;
    tyres.push_back(tyre);
  }
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (Tyre& tyre : tyres) {
      RayWheelState& state = states_[tyre.wheel];
      const PlumbVec3 slip = sub(chassis.velocity_at(state.contact), tyre.ground);
      const double held = tyre.j_along - tyre.rolling - dot(slip, tyre.along) / tyre.ease_along;
      double along = tyre.rolling + std::clamp(held, -tyre.brake, tyre.brake);
      double across = tyre.j_across - dot(slip, tyre.across) / tyre.ease_across;
      const double beyond = std::hypot(tyre.most_along > 0 ? along / tyre.most_along : 0,
                                       tyre.most_across > 0 ? across / tyre.most_across : 0);
      state.slides = beyond > 1;
      if (state.slides) {
        along /= beyond;
        across /= beyond;
      }
      if (tyre.most_along == 0) along = 0;
      if (tyre.most_across == 0) across = 0;
      chassis.push(add(scale(along - tyre.j_along, tyre.along), scale(across - tyre.j_across, tyre.across)),
                   state.contact);
      tyre.j_along = along;
      tyre.j_across = across;
    }
  }
  for (const Tyre& tyre : tyres) {
    const RayWheelState& state = states_[tyre.wheel];
    impulses_[tyre.wheel] =
        add(impulses_[tyre.wheel], add(scale(tyre.j_along, tyre.along), scale(tyre.j_across, tyre.across)));
    const double speed = dot(sub(chassis.velocity_at(state.contact), tyre.ground), tyre.along);
    states_[tyre.wheel].rotation += speed / settings_.wheels[tyre.wheel].radius * dt;
  }
}

void RaycastVehicle::push(double dt) {
  std::vector<AtPoint> forces;
  pushed_.clear();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (!states_[i].on_ground) continue;
    const PlumbVec3 force = scale(1 / dt, impulses_[i]);
    pushed_.push_back(chassis_);
    forces.push_back({force, states_[i].contact});
    if (read_one<MassRow>(world_, PLUMB_FIELD_MASS, states_[i].ground).mass <= 0) continue;
    pushed_.push_back(states_[i].ground);
    forces.push_back({scale(-1, force), states_[i].contact});
  }
  write_rows(world_, PLUMB_FIELD_FORCE_AT_POINT, std::span<const PlumbBody>(pushed_), std::span<const AtPoint>(forces));
}

}  // namespace plumb::helpers
