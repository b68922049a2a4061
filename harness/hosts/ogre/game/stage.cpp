#include "hosts/ogre/game/stage.hpp"

#include <algorithm>

#include "hosts/ogre/game/vectors.hpp"

namespace plumb::ogre {
namespace {

constexpr double kReach = 40;  // m, of a ray

std::unique_ptr<IPhysicsWorld> create(const Backend& backend) {
  PlumbWorldDesc desc = world_desc(Stage::needs);
  desc.gravity = kGravity;
  return backend.create_world(desc);
}

}  // namespace

Moment beginning(const Scene& scene) {
  Moment moment;
  for (const Thing& thing : scene.things) {
    moment.poses.push_back(thing.body.pose);
    moment.velocities.push_back({thing.body.linear_velocity, thing.body.angular_velocity});
  }
  moment.character = scene.character;
  return moment;
}

Stage::Stage(const std::string& engine, const Scene& scene, const Moment& moment)
    : scene_(scene), backend_(open_backend(engine)), world_(create(backend_)), time_(moment.time) {
  create_bodies(moment);
  walker_.emplace(*world_, moment.character, kCharacter);
  walker_->set_velocity(moment.character_velocity);
  walker_before_ = walker_->position();
  if (moment.hold) {
    hand_.emplace(*world_, bodies_[moment.hold->thing], moment.hold->at);
    hold_ = moment.hold;
  }
  steps_.emplace(*world_, bodies_, helpers::FixedStepSettings{dt, 4});
  alpha_ = steps_->advance(moment.pending).alpha;
}

void Stage::create_bodies(const Moment& moment) {
  std::vector<PlumbShapeDesc> shape_descs;
  for (const Thing& thing : scene_.things) shape_descs.push_back(thing.shape);
  std::vector<PlumbShape> shapes(shape_descs.size());
  check(*world_, world_->create_shapes(shape_descs, shapes));
  std::vector<PlumbBodyDesc> descs;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    PlumbBodyDesc& desc = descs.emplace_back(scene_.things[i].body);
    desc.shape = shapes[i];
    desc.pose = moment.poses[i];
    if (desc.motion != PLUMB_DYNAMIC) continue;  // others move by their next target
    desc.linear_velocity = moment.velocities[i].linear;
    desc.angular_velocity = moment.velocities[i].angular;
  }
  bodies_.resize(descs.size());
  check(*world_, world_->create_bodies(descs, bodies_));
}

Moment Stage::moment() {
  Moment moment;
  moment.time = time_;
  moment.pending = alpha_ * dt;
  moment.poses.resize(bodies_.size());
  moment.velocities.resize(bodies_.size());
  check(*world_, world_->read(PLUMB_FIELD_POSE, bodies_, rows_over(std::span(moment.poses))));
  check(*world_, world_->read(PLUMB_FIELD_VELOCITY, bodies_, rows_over(std::span(moment.velocities))));
  moment.character = walker_->position();
  moment.character_velocity = walker_->velocity();
  moment.hold = hold_;
  return moment;
}

void Stage::advance(double frame_time, Steering& steering) {
  const auto before_step = [&](double step) { drive(step, steering); };
  alpha_ = steps_->advance(frame_time, before_step).alpha;
}

void Stage::drive(double step, Steering& steering) {
  time_ += step;
  const PlumbPose target{platform_at(time_), {0, 0, 0, 1}};
  check(*world_, world_->write(PLUMB_FIELD_KINEMATIC_TARGET, {&bodies_[scene_.platform], 1},
                               const_rows_over(std::span(&target, 1))));
  walker_before_ = walker_->position();
  walker_->move(steering.walk, step, steering.jump);
  steering.jump = 0;
  if (hand_) hand_->reach(hold_->target, step);
}

std::optional<double> Stage::grab(const Ray& ray) {
  release();
  const PlumbRay cast{ray.origin, scale(kReach, ray.direction), {1, 0xffffffffU, 0, 0}};
  const Hits hits = world_->queries()->cast_rays(PLUMB_HIT_CLOSEST, {&cast, 1});
  check(*world_, hits.result);
  const PlumbHit hit = hits.hits[0];
  const auto thing = thing_of(hit.body);
  if (!thing || scene_.things[*thing].body.motion != PLUMB_DYNAMIC) return std::nullopt;
  PlumbPose pose{};
  check(*world_, world_->read(PLUMB_FIELD_POSE, {&hit.body, 1}, rows_over(std::span(&pose, 1))));
  hold_ = Hold{*thing, to_local(pose, hit.position), hit.position};
  hand_.emplace(*world_, hit.body, hold_->at);
  return hit.fraction * kReach;
}

void Stage::drag(const PlumbVec3& target) {
  if (hold_) hold_->target = target;
}

void Stage::release() {
  hand_.reset();
  hold_.reset();
}

PlumbVec3 Stage::character() const {
  return add(walker_before_, scale(alpha_, sub(walker_->position(), walker_before_)));
}

std::size_t Stage::things_alive() const {
  const std::span<const PlumbBody> alive = world_->bodies();
  return static_cast<std::size_t>(std::count_if(bodies_.begin(), bodies_.end(), [&](PlumbBody body) {
    return std::find(alive.begin(), alive.end(), body) != alive.end();
  }));
}

std::optional<std::size_t> Stage::ground() const { return thing_of(walker_->ground_body()); }

std::optional<std::size_t> Stage::thing_of(PlumbBody body) const {
  const auto found = std::find(bodies_.begin(), bodies_.end(), body);
  if (body == 0 || found == bodies_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - bodies_.begin());
}

}  // namespace plumb::ogre
