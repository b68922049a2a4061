#include "measure/instruments/referee_view.hpp"

#include <algorithm>
#include <cmath>

#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "plumb/assert.hpp"
#include "referee/joints.hpp"

namespace plumb::harness {
namespace {

std::pair<std::uint32_t, std::uint32_t> ordered(std::size_t a, std::size_t b) {
  return {static_cast<std::uint32_t>(std::min(a, b)), static_cast<std::uint32_t>(std::max(a, b))};
}

bool same(const PlumbFilter& a, const PlumbFilter& b) {
  return a.category == b.category && a.mask == b.mask && a.group == b.group;
}

bool is_finite(const PoseRow& row) {
  const auto& [p, q] = row;
  return std::isfinite(p.x + p.y + p.z + q.x + q.y + q.z + q.w);
}

referee::Pose pose_of(const PoseRow& row) { return referee::pose(row.position, row.orientation); }

}  // namespace

RefereeView::RefereeView(const Scene& scene) : scene_(&scene) {
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) shapes_.push_back(shape_of(scene, i));
  masses_.reserve(scene.bodies.size());
  for (const SceneBody& body : scene.bodies) {
    masses_.push_back(referee::mass_of(body.desc, body.shape ? shapes_[*body.shape].get() : nullptr));
    total_mass_ += masses_.back().mass;
    const SceneBody& first = scene.bodies.front();
    if (!same(body.desc.filter, first.desc.filter) || body.desc.filter.group < 0 ||
        (body.desc.flags & PLUMB_BODY_SENSOR) != 0)
      all_may_touch_ = false;
  }
  for (const SceneJoint& joint : scene.joints)
    if (joint.body_a && joint.desc.collide_connected == 0) jointed_.insert(ordered(*joint.body_a, joint.body_b));
  if (!jointed_.empty()) all_may_touch_ = false;
}

referee::WorldPenetration RefereeView::penetration(std::span<const PoseRow> poses) const {
  std::vector<referee::PosedShape> shapes(scene_->bodies.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const SceneBody& body = scene_->bodies[i];
    if (!body.shape) continue;
    shapes[i] = {shapes_[*body.shape].get(), pose_of(poses[i]), body.desc.motion != PLUMB_STATIC};
  }
  const auto may_meet = [&](std::uint32_t a, std::uint32_t b) {
    const PlumbBodyDesc &first = scene_->bodies[a].desc, &second = scene_->bodies[b].desc;
    return may_touch(first.filter, second.filter) && ((first.flags | second.flags) & PLUMB_BODY_SENSOR) == 0 &&
           !jointed_.contains({a, b});
  };
  auto result = all_may_touch_ ? referee::world_penetration(shapes) : referee::world_penetration(shapes, may_meet);
  if (!std::all_of(poses.begin(), poses.end(), is_finite))
    result.p50 = result.p95 = result.p99 = result.max = result.sum_of_squares = not_measured;
  return result;
}

std::vector<referee::BodyState> RefereeView::states(Simulation& simulation) const {
  const std::span<const VelocityRow> velocities = simulation.velocities();
  return referee::body_states(std::span(masses_), simulation.poses(), velocities);
}

referee::Energy RefereeView::energy(Simulation& simulation) const {
  return referee::energy(states(simulation), referee::vec(scene_->gravity));
}

referee::JointError RefereeView::joint_error(std::span<const PoseRow> poses, double time) const {
  referee::JointError most;
  for (const SceneJoint& joint : scene_->joints) {
    if (time > joint.cut) continue;
    const referee::Pose a = joint.body_a ? pose_of(poses[*joint.body_a]) : referee::Pose{};
    const referee::JointError error = referee::joint_error(joint.desc, a, pose_of(poses[joint.body_b]));
    most.position = largest(most.position, error.position);
    most.angle = largest(most.angle, error.angle);
    most.limit_position = largest(most.limit_position, error.limit_position);
    most.limit_angle = largest(most.limit_angle, error.limit_angle);
  }
  return most;
}

DepthSummary depth_summary(const referee::WorldPenetration& penetration) {
  double sum = 0;
  for (const referee::Overlap& overlap : penetration.overlaps) sum += overlap.penetration.depth;
  const auto count = static_cast<double>(penetration.overlaps.size());
  if (std::isnan(penetration.max)) return {not_measured, not_measured, not_measured};
  return {count > 0 ? sum / count : 0, penetration.p99, penetration.max};
}

ImpulseAccount::ImpulseAccount(Simulation& simulation) {
  const Scene& scene = simulation.scene();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    index_[simulation.handle(i)] = i;
    moves_.push_back(scene.bodies[i].desc.motion == PLUMB_DYNAMIC);
  }
}

void ImpulseAccount::add(Simulation& simulation) {
  seconds_ += simulation.scene().dt;
  for (const PlumbContact& contact : simulation.contacts()) {
    const std::size_t a = index_.at(contact.body_a), b = index_.at(contact.body_b);
    const double sign = a < b ? 1 : -1;
    const referee::Vec3 normal = contact.normal_impulse * referee::vec(contact.normal);
    const referee::Vec3 tangent = referee::vec(contact.tangent_impulse);
    const auto [low, high] = ordered(a, b);
    Sum& sum = pairs_[std::uint64_t{low} << 32 | high];
    sum.normal += sign * normal;
    sum.tangent += sign * tangent;
    if (moves_[b] && !moves_[a]) ground_ += normal + tangent;
    if (moves_[a] && !moves_[b]) ground_ -= normal + tangent;
  }
}

ImpulseAccount::PairForce ImpulseAccount::between(std::size_t body_a, std::size_t body_b) const {
  const auto [low, high] = ordered(body_a, body_b);
  const auto found = pairs_.find(std::uint64_t{low} << 32 | high);
  if (found == pairs_.end()) return {0, 0};
  PLUMB_ASSERT(seconds_ > 0);
  return {found->second.normal.norm() / seconds_, found->second.tangent.norm() / seconds_};
}

referee::Vec3 ImpulseAccount::from_ground() const { return ground_ / seconds_; }

WantedScene with_wanted(MeasureContext& context, PlumbNeeds needs) {
  WantedScene wanted{context.scene(), true};
  for (std::uint32_t bit = 0; bit < PLUMB_NEED_COUNT; ++bit)
    if ((needs >> bit & 1) != 0 && context.backend().capability(PLUMB_CAP_NEED, bit) == PLUMB_NONE)
      wanted.granted = false;
  if (wanted.granted) wanted.scene.needs |= needs;
  return wanted;
}

}  // namespace plumb::harness
