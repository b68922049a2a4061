#include "plumb/helpers/character_controller.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "rigid_motion.hpp"

namespace plumb::helpers {
namespace {

constexpr int most_slides = 8;
constexpr double nothing = 1e-9;  // m

void check_settings(const CharacterSettings& s) {
  require(s.radius > 0 && s.half_height >= 0, "character: its radius must be above 0 and its half height 0 or more");
  require(s.skin > 0 && s.skin < s.radius, "character: the skin must be above 0 and below the radius");
  require(s.max_slope >= 0 && s.max_slope < 1.58, "character: max_slope is an angle from 0 to pi/2, rad");
  require(s.step_up >= 0 && s.stick_down >= 0 && s.max_push >= 0 && s.mass >= 0 && s.air_acceleration >= 0,
          "character: steps, push, mass and air_acceleration must be 0 or more");
  require(length(s.gravity) > 0, "character: gravity says where up is and cannot be 0");
}

/// What is left of v where it may go into none of the planes: along one, along the crease of two, nowhere in a corner.
PlumbVec3 clip(const PlumbVec3& v, std::span<const PlumbVec3> planes) {
  const auto allowed = [&](const PlumbVec3& way) {
    return std::all_of(planes.begin(), planes.end(), [&](const PlumbVec3& n) { return dot(way, n) >= -nothing; });
  };
  if (allowed(v)) return v;
  for (const PlumbVec3& n : planes)
    if (const PlumbVec3 along = without(v, n); dot(v, n) < 0 && allowed(along)) return along;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      const PlumbVec3 crease = cross(planes[i], planes[j]);
      if (length(crease) < 1e-6) continue;
      const PlumbVec3 axis = normalized(crease);
      if (const PlumbVec3 along = scale(dot(v, axis), axis); allowed(along)) return along;
    }
  return {};
}

}  // namespace

CharacterController::CharacterController(IPhysicsWorld& world, const PlumbVec3& position,
                                         const CharacterSettings& settings)
    : world_(world),
      queries_(require_extension(world.queries(), "character", PLUMB_EXT_QUERIES, "PLUMB_NEED_QUERIES")),
      settings_(settings),
      up_(direction(scale(-1, settings.gravity), {0, 1, 0})),
      position_(position) {
  check_settings(settings);
  PlumbShapeDesc desc = shape_desc(PLUMB_CAPSULE);
  desc.radius = settings.radius;
  desc.half_height = settings.half_height;
  check(world, world.create_shapes({&desc, 1}, {&capsule_, 1}));
  const PlumbCast trial{capsule_, {position, {0, 0, 0, 1}}, scale(-1, up_), settings.filter};
  if (const PlumbResult result = queries_.cast_shapes(PLUMB_HIT_CLOSEST, {&trial, 1}).result; result < 0) {
    const std::string text = world.error_text();
    world.destroy_shapes({&capsule_, 1});
    throw Error(result, "character: this world does not cast capsules: " + text);
  }
  find_ground(settings.skin * 2);
}

CharacterController::~CharacterController() { world_.destroy_shapes({&capsule_, 1}); }

void CharacterController::teleport(const PlumbVec3& position) {
  position_ = position;
  velocity_ = carried_ = {};
  find_ground(2 * settings_.skin);
}

bool CharacterController::walkable(const PlumbVec3& normal) const {
  return dot(normal, up_) >= std::cos(settings_.max_slope) - 1e-6;
}

/// How far the capsule may go until only the skin is left between it and what it meets.
CharacterController::Sweep CharacterController::sweep(const PlumbVec3& from, const PlumbVec3& by) {
  const double size = length(by);
  if (size < nothing) return {0, {}};
  const PlumbVec3 way = scale(1 / size, by);
  // Beyond the end, as far as something may be and still be nearer than the skin.
  const double reach = size + 4 * settings_.skin;
  const PlumbCast cast{capsule_, {from, {0, 0, 0, 1}}, scale(reach, way), settings_.filter};
  const Hits hits = queries_.cast_shapes(PLUMB_HIT_CLOSEST, {&cast, 1});
  check(world_, hits.result);
  PlumbHit hit = hits.hits[0];
  if (hit.body == 0) return {size, {}};
  hit.normal = direction(hit.normal, up_);  // engines that reckon in floats tell it to seven digits
  const double against = -dot(way, hit.normal);
  if (!(against > 1e-6)) return {size, {}};  // it leaves, or the engine does not tell
  const double room = hit.fraction * reach - settings_.skin / std::max(against, 0.25);
  if (room >= size) return {size, {}};
  return {std::max(0.0, room), hit};
}

void CharacterController::move(const PlumbVec3& walk, double dt, double jump) {
  require(std::isfinite(dt) && dt > 0, "character: dt is " + std::to_string(dt) + " s: give a time above 0");
  ride(dt);
  part();
  find_ground(2 * settings_.skin);
  weigh(dt);
  const PlumbVec3 level = without(walk, up_);
  const bool stood = ground_ == CharacterGround::on_ground && dot(velocity_, up_) <= 1e-6;
  if (stood && jump <= 0) {
    // As fast along a slope as it is on the level, seen from above.
    const PlumbVec3 along =
        sub(level, scale(dot(level, ground_normal_) / std::max(dot(ground_normal_, up_), 1e-3), up_));
    velocity_ = level;
    slide(scale(dt, along), dt, true);
    if (dot(velocity_, up_) <= 1e-6) find_ground(settings_.stick_down + 2 * settings_.skin);
    if (ground_ != CharacterGround::on_ground) velocity_ = add(velocity_, carried_);
    return;
  }
  if (stood) velocity_ = add(add(level, carried_), scale(jump, up_));
  if (ground_ == CharacterGround::in_air) {
    const PlumbVec3 missing = sub(level, without(sub(velocity_, carried_), up_));
    const double most = settings_.air_acceleration * dt;
    velocity_ = add(velocity_, scale(std::min(1.0, most / std::max(length(missing), nothing)), missing));
  }
  // The mean of both ends' speeds is exact under gravity.
  const PlumbVec3 fall = scale(dt, settings_.gravity);
  const PlumbVec3 by = scale(dt, add(velocity_, scale(0.5, fall)));
  velocity_ = add(velocity_, fall);
  slide(by, dt, false);
  if (dot(velocity_, up_) <= 1e-6 || ground_ == CharacterGround::steep) find_ground(2 * settings_.skin);
  if (dot(velocity_, up_) > 1e-6) {
    ground_ = CharacterGround::in_air;
    ground_body_ = 0;
  }
  if (ground_ == CharacterGround::on_ground) velocity_ = without(velocity_, up_);
}

/// Goes where the ground under its feet went since the last time, turning ground included.
void CharacterController::ride(double dt) {
  if (ground_ != CharacterGround::on_ground || ground_body_ == 0) return;
  carried_ = {};
  PlumbPose now{};
  if (world_.read(PLUMB_FIELD_POSE, {&ground_body_, 1}, rows_over(std::span(&now, 1))) < 0) return;  // it is gone
  const PlumbVec3 there = compose(now, compose(inverse(ground_pose_), {position_, {0, 0, 0, 1}})).position;
  const PlumbVec3 by = sub(there, position_);
  ground_pose_ = now;
  if (length(by) < nothing) return;
  carried_ = without(scale(1 / dt, by), up_);
  const Sweep free = sweep(position_, by);
  const bool by_its_own_ground = free.hit.body == ground_body_;
  position_ = add(position_, by_its_own_ground ? by : scale(free.distance, direction(by, up_)));
}

/// Out of what has moved into it, the deepest first.
void CharacterController::part() {
  for (int i = 0; i < 32; ++i) {
    const PlumbOverlap here{capsule_, {position_, {0, 0, 0, 1}}, settings_.filter};
    const Penetrations inside = queries_.penetrations({&here, 1});
    if (inside.result == PLUMB_E_UNSUPPORTED) return part_by_casts();
    if (inside.result < 0 || inside.rows.empty()) return;
    const PlumbPenetration& deepest = inside.rows[0];
    position_ = add(position_, scale(deepest.depth + settings_.skin / 2, deepest.normal));
  }
}

/// Where the engine does not tell depths: along the normals that casts of nearly nothing tell.
void CharacterController::part_by_casts() {
  for (int i = 0; i < 32; ++i) {
    const PlumbOverlap here{capsule_, {position_, {0, 0, 0, 1}}, settings_.filter};
    const Hits inside = queries_.overlap_shapes({&here, 1});
    if (inside.result < 0 || inside.hits.empty()) return;
    const PlumbCast cast{capsule_, {position_, {0, 0, 0, 1}}, scale(-1e-3, up_), settings_.filter};
    const Hits hits = queries_.cast_shapes(PLUMB_HIT_ALL, {&cast, 1});
    PlumbVec3 out{};
    if (hits.result >= 0)
      for (const PlumbHit& hit : hits.hits)
        if (hit.fraction == 0 && std::isfinite(dot(hit.normal, hit.normal))) out = add(out, hit.normal);
    position_ = add(position_, scale(settings_.skin / 2, direction(out, up_)));
  }
}

void CharacterController::slide(PlumbVec3 by, double dt, bool walking) {
  std::array<PlumbVec3, most_slides> planes;
  std::size_t count = 0;
  for (int i = 0; i < most_slides && length(by) > nothing; ++i) {
    const Sweep free = sweep(position_, by);
    const PlumbVec3 way = normalized(by);
    position_ = add(position_, scale(free.distance, way));
    if (free.hit.body == 0) return;
    by = scale(length(by) - free.distance, way);
    PlumbVec3 normal = free.hit.normal;
    push(free.hit, -dot(velocity_, normal), dt);
    if (walking && !walkable(normal)) {
      if (climb(by)) return;
      // A slope that is too steep is a wall to who walks into it.
      normal = direction(without(normal, up_), normal);
    }
    // The same plane again, met with the engine's noise in its normal, makes no crease.
    const auto known = std::find_if(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(count),
                                    [&](const PlumbVec3& plane) { return dot(plane, normal) > 0.99; });
    *known = normal;
    if (known == planes.begin() + static_cast<std::ptrdiff_t>(count)) ++count;
    by = clip(by, std::span(planes.data(), count));
    if (!walking || !walkable(normal)) velocity_ = clip(velocity_, std::span(planes.data(), count));
  }
}

/// Up, over and down again; undone where no ground is found there. What a rounded foot meets of a step is its edge, so
/// that the ground's own normal is asked of a ray.
bool CharacterController::climb(const PlumbVec3& by) {
  const PlumbVec3 over = without(by, up_);
  if (settings_.step_up == 0 || length(over) < nothing) return false;
  const PlumbVec3 heading = normalized(over);
  const Sweep rise = sweep(position_, scale(settings_.step_up + settings_.skin, up_));
  const PlumbVec3 above = add(position_, scale(rise.distance, up_));
  // Far enough that the foot's middle may come over the edge even when the step in time is short.
  const Sweep ahead = sweep(above, scale(std::max(length(over), settings_.skin), heading));
  if (ahead.distance < std::min(length(over), settings_.skin) / 2) return false;
  const PlumbVec3 beyond = add(above, scale(ahead.distance, heading));
  const Sweep fall = sweep(beyond, scale(-rise.distance - settings_.skin, up_));
  if (fall.hit.body == 0) return false;
  if (!walkable(fall.hit.normal) && !stands_on_edge(fall.hit, heading)) return false;
  position_ = sub(beyond, scale(fall.distance, up_));
  return true;
}

bool CharacterController::stands_on_edge(const PlumbHit& hit, const PlumbVec3& heading) {
  const PlumbRay ray{add(add(hit.position, scale(0.05, up_)), scale(0.02, heading)), scale(-0.1, up_),
                     settings_.filter};
  const Hits below = queries_.cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1});
  check(world_, below.result);
  return below.hits[0].body != 0 && walkable(below.hits[0].normal);
}

void CharacterController::find_ground(double reach) {
  const bool stood = ground_ == CharacterGround::on_ground;
  ground_ = CharacterGround::in_air;
  ground_body_ = 0;
  ground_normal_ = {};
  const Sweep below = sweep(position_, scale(-reach, up_));
  if (below.hit.body == 0) return;
  const PlumbVec3 inward = direction(without(sub(below.hit.position, position_), up_), {});
  const bool stands =
      walkable(below.hit.normal) || stands_on_edge(below.hit, inward) || stands_on_edge(below.hit, scale(-1, inward));
  if (!stands && below.distance > 2 * settings_.skin) return;
  ground_ = stands ? CharacterGround::on_ground : CharacterGround::steep;
  ground_body_ = below.hit.body;
  ground_normal_ = stands && !walkable(below.hit.normal) ? up_ : below.hit.normal;
  ground_pose_ = read_one<PlumbPose>(world_, PLUMB_FIELD_POSE, ground_body_);
  if (stands && (stood || below.distance < 2 * settings_.skin)) position_ = sub(position_, scale(below.distance, up_));
}

/// Its weight on ground that can give way.
void CharacterController::weigh(double dt) {
  if (ground_ != CharacterGround::on_ground) return;
  if (read_one<MassRow>(world_, PLUMB_FIELD_MASS, ground_body_).mass <= 0) return;
  const PlumbVec3 foot = sub(position_, scale(settings_.half_height + settings_.radius, up_));
  const PlumbVec3 impulse = scale(settings_.mass * dt, settings_.gravity);
  write_one(world_, PLUMB_FIELD_IMPULSE_AT_POINT, ground_body_, AtPoint{impulse, foot});
}

/// With no more than max_push, and no more than takes the body along.
void CharacterController::push(const PlumbHit& hit, double speed, double dt) {
  const MassRow mass = read_one<MassRow>(world_, PLUMB_FIELD_MASS, hit.body);
  if (mass.mass <= 0 || speed <= 0) return;
  const RigidMotion body = RigidMotion::read(world_, hit.body);
  const PlumbVec3 into = scale(-1, hit.normal);
  const double missing = speed - dot(body.velocity_at(hit.position), into);
  const double impulse = std::min(missing / body.ease(hit.position, into), settings_.max_push * dt);
  if (impulse > 0)
    write_one(world_, PLUMB_FIELD_IMPULSE_AT_POINT, hit.body, AtPoint{scale(impulse, into), hit.position});
}

}  // namespace plumb::helpers
