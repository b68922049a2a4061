#include "measure/instruments/drift.hpp"

#include <algorithm>

namespace plumb::harness {

void JointDrift::add(const Scene& scene, std::span<const PoseRow> poses, double time) {
  const auto pose_of = [&](std::size_t body) { return referee::pose(poses[body].position, poses[body].orientation); };
  std::vector<referee::JointError> errors;
  for (const SceneJoint& joint : scene.joints) {
    if (time > joint.cut) continue;
    errors.push_back(referee::joint_error(joint.desc, joint.body_a ? pose_of(*joint.body_a) : referee::Pose{},
                                          pose_of(joint.body_b)));
  }
  add(errors, time);
}

void JointDrift::add(std::span<const referee::JointError> errors, double time) {
  double worst = 0;
  for (const referee::JointError& error : errors) {
    worst = largest(worst, error.position);
    angle_ = largest(angle_, error.angle);
    limit_ = largest(limit_, largest(error.limit_position, error.limit_angle));
    squares_ += error.position * error.position;
    ++count_;
  }
  gap_ = largest(gap_, worst);
  if (!errors.empty()) worst_.push_back({time, worst});
}

double JointDrift::gap_slope() const { return slope_of(worst_); }

double slope_of(std::span<const SeriesPoint> points) {
  if (points.size() < 2) return 0;
  double time = 0, value = 0;
  for (const SeriesPoint& point : points) {
    time += point.time / static_cast<double>(points.size());
    value += point.value / static_cast<double>(points.size());
  }
  double across = 0, along = 0;
  for (const SeriesPoint& point : points) {
    across += (point.time - time) * (point.value - value);
    along += (point.time - time) * (point.time - time);
  }
  return along > 0 ? across / along : 0;
}

void RestWatch::add(double time, std::span<const double> speeds) {
  last_ = 0;
  for (const double speed : speeds) {
    last_ = largest(last_, speed);
    if (time <= begin_) continue;
    squares_ += speed * speed;
    ++count_;
  }
}

void RestWatch::add(Simulation& simulation) {
  std::vector<double> speeds;
  for (std::size_t i = 0; i < simulation.scene().bodies.size(); ++i)
    if (simulation.scene().bodies[i].desc.motion == PLUMB_DYNAMIC)
      speeds.push_back(referee::vec(simulation.velocities()[i].linear).norm());
  add(simulation.time(), speeds);
}

double RestWatch::jitter() const { return count_ == 0 ? 0 : std::sqrt(squares_ / static_cast<double>(count_)); }

void RestWatch::add_to(MeasureContext& context) const {
  const Scene& scene = context.scene();
  const double unsupported = referee::vec(scene.gravity).norm() * scene.dt;
  context.deviation("rest_speed", last_ / unsupported, "of g dt");
  context.deviation("jitter", jitter() / unsupported, "of g dt");
}

}  // namespace plumb::harness
