#include "plumb/helpers/fixed_step.hpp"

#include <algorithm>
#include <cmath>

#include "common.hpp"

namespace plumb::helpers {

FixedStep::FixedStep(IPhysicsWorld& world, std::span<const PlumbBody> bodies, const FixedStepSettings& settings)
    : world_(world), bodies_(bodies.begin(), bodies.end()), settings_(settings) {
  require(std::isfinite(settings.dt) && settings.dt > 0,
          "fixed step: dt is " + std::to_string(settings.dt) + " s: give a time above 0");
  require(settings.most_steps >= 1,
          "fixed step: most_steps is " + std::to_string(settings.most_steps) + ": a frame needs at least 1");
  report_.struct_size = sizeof(report_);
  for (State* state : {&before_, &after_}) {
    state->poses.resize(bodies_.size());
    state->velocities.resize(6 * bodies_.size());
  }
  blended_.resize(bodies_.size());
  blended_velocities_.resize(6 * bodies_.size());
  reset();
}

void FixedStep::reset() {
  read(after_);
  before_ = after_;
  blend(0);
}

FixedFrame FixedStep::begin(double frame_time) {
  require(std::isfinite(frame_time) && frame_time >= 0,
          "fixed step: a frame of " + std::to_string(frame_time) + " s: give a time of 0 or more");
  time_ += frame_time;
  // Frames of exactly a step, summed up in floating point, shall not lose or double one.
  const double due = std::floor(time_ / settings_.dt + 1e-9);
  FixedFrame frame;
  frame.steps = static_cast<int>(std::min(due, static_cast<double>(settings_.most_steps)));
  frame.dropped = (due - frame.steps) * settings_.dt;
  time_ = std::max(0.0, time_ - due * settings_.dt);
  frame.alpha = std::min(time_ / settings_.dt, 1.0);
  return frame;
}

void FixedStep::step() {
  if (modify_) {
    report_ = step_with(world_, settings_.dt, modify_);
  } else {
    check(world_, world_.step(settings_.dt));
    check(world_, world_.wait(report_));
  }
  std::swap(before_, after_);
  read(after_);
}

void FixedStep::read(State& state) {
  struct Row {
    double values[6];
  };
  read_rows(world_, PLUMB_FIELD_POSE, bodies_, std::span(state.poses));
  const Rows rows(reinterpret_cast<std::byte*>(state.velocities.data()), bodies_.size(), sizeof(Row), PLUMB_F64);
  if (!bodies_.empty()) check(world_, world_.read(PLUMB_FIELD_VELOCITY, bodies_, rows));
}

void FixedStep::blend(double alpha) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) blended_[i] = interpolate(before_.poses[i], after_.poses[i], alpha);
  for (std::size_t i = 0; i < blended_velocities_.size(); ++i)
    blended_velocities_[i] = std::lerp(before_.velocities[i], after_.velocities[i], alpha);
}

PlumbPose interpolate(const PlumbPose& a, const PlumbPose& b, double alpha) {
  PlumbQuat to = b.orientation;
  const PlumbQuat& from = a.orientation;
  double cosine = from.x * to.x + from.y * to.y + from.z * to.z + from.w * to.w;
  if (cosine < 0) {
    to = {-to.x, -to.y, -to.z, -to.w};
    cosine = -cosine;
  }
  double p = 1 - alpha, q = alpha;
  if (cosine < 0.9999) {  // nearer, the chord and the arc are the same
    const double angle = std::acos(cosine);
    p = std::sin(p * angle) / std::sin(angle);
    q = std::sin(q * angle) / std::sin(angle);
  }
  return {add(scale(1 - alpha, a.position), scale(alpha, b.position)),
          normalized(
              PlumbQuat{p * from.x + q * to.x, p * from.y + q * to.y, p * from.z + q * to.z, p * from.w + q * to.w})};
}

}  // namespace plumb::helpers
