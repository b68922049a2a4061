#include "referee/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plumb/assert.hpp"

namespace plumb::referee {

namespace {

// The engine's impulse on b, split: l_n along the normal, the rest square to it.
struct Load {
  double normal;
  Vec3 tangent;
  [[nodiscard]] bool known() const { return std::isfinite(normal) && tangent.allFinite(); }
};

Load load_of(const ContactSample& sample) {
  return {sample.contact->normal_impulse, vec(sample.contact->tangent_impulse)};
}

Vec3 impulse_on_b(const ContactSample& sample) {
  const Load load = load_of(sample);
  return load.normal * vec(sample.contact->normal) + load.tangent;
}

double bounce(const ContactSample& sample) { return sample.restitution * std::max(0.0, sample.approach_speed); }

}  // namespace

Scale scale_of(double total_mass, double gravity, double dt, double length) {
  return {total_mass * gravity * dt, std::sqrt(gravity * length), length};
}

Slip slip_of(const ContactSample& sample) {
  const Vec3 point = vec(sample.contact->position), normal = vec(sample.contact->normal);
  const Vec3 u = sample.b->velocity_at(point) - sample.a->velocity_at(point);
  return {u.dot(normal), u - u.dot(normal) * normal};
}

double cone_violation(const ContactSample& sample, const Scale& scale) {
  const Load load = load_of(sample);
  const double most = sample.friction * std::max(0.0, load.normal);
  return std::max(0.0, load.tangent.norm() - most) / (most + 1e-9 * scale.impulse);
}

Vec3 project_on_cone(const Vec3& impulse, const Vec3& normal, double friction) {
  PLUMB_ASSERT(friction >= 0);
  const double along = impulse.dot(normal);
  const Vec3 tangent = impulse - along * normal;
  const double across = tangent.norm();
  if (across <= friction * along) return impulse;
  if (friction * across <= -along) return Vec3::Zero();  // in the polar cone
  const double projected = std::max(0.0, (friction * across + along) / (friction * friction + 1));
  if (across == 0) return projected * normal;
  return projected * normal + friction * projected / across * tangent;
}

double dissipation_defect(const ContactSample& sample, double least_slip) {
  const Load load = load_of(sample);
  const Slip slip = slip_of(sample);
  const double most = sample.friction * load.normal * slip.tangent.norm();
  if (!(slip.tangent.norm() > least_slip) || !(most > 0)) return std::numeric_limits<double>::quiet_NaN();
  return (most + load.tangent.dot(slip.tangent)) / most;
}

double complementarity(const ContactSample& sample, const Scale& scale) {
  const Load load = load_of(sample);
  const Slip slip = slip_of(sample);
  const double lifted = slip.normal - bounce(sample) + sample.friction * slip.tangent.norm();
  return std::abs(load.normal * lifted + load.tangent.dot(slip.tangent)) / (scale.impulse * scale.speed);
}

ContactQuality contact_quality(std::span<const ContactSample> contacts, const Scale& scale,
                               double least_slip_of_speed) {
  PLUMB_ASSERT(scale.impulse >= 0 && scale.speed >= 0 && scale.length >= 0);
  ContactQuality quality;
  double defect_sum = 0, weight_sum = 0;
  for (const ContactSample& sample : contacts) {
    ++quality.contacts;
    const Load load = load_of(sample);
    if (!load.known()) {
      ++quality.without_impulse;
      continue;
    }
    const Slip slip = slip_of(sample);
    const double speed = slip.tangent.norm();
    const auto worst = [](double& kept, double value) { kept = std::max(kept, value); };
    const Vec3 impulse = impulse_on_b(sample);
    worst(quality.cone_max, cone_violation(sample, scale));
    worst(quality.cone_distance_max,
          (impulse - project_on_cone(impulse, vec(sample.contact->normal), sample.friction)).norm() / scale.impulse);
    worst(quality.signorini_speed_max,
          load.normal * std::max(0.0, slip.normal - bounce(sample)) / (scale.impulse * scale.speed));
    worst(quality.signorini_gap_max,
          load.normal * std::max(0.0, -sample.contact->depth) / (scale.impulse * scale.length));
    worst(quality.pull_max, std::max(0.0, -load.normal) / scale.impulse);
    worst(quality.complementarity_max, complementarity(sample, scale));
    const double most = sample.friction * load.normal;
    if (const double defect = dissipation_defect(sample, least_slip_of_speed * scale.speed); std::isfinite(defect)) {
      defect_sum += defect * most * speed;
      weight_sum += most * speed;
    }
    if (most > 0 && load.tangent.norm() < 0.99 * most) worst(quality.creep_max, speed / scale.speed);
  }
  quality.dissipation_mean = defect_sum / weight_sum;  // 0 / 0 is NaN: nothing slips
  return quality;
}

std::vector<ExternalImpulse> ground_impulses(std::span<const ContactSample> contacts) {
  std::vector<ExternalImpulse> impulses;
  for (const ContactSample& sample : contacts) {
    const bool a_moves = sample.a->mass.mass > 0, b_moves = sample.b->mass.mass > 0;
    if (a_moves == b_moves || !load_of(sample).known()) continue;
    impulses.push_back({(b_moves ? 1 : -1) * impulse_on_b(sample), vec(sample.contact->position)});
  }
  return impulses;
}

double ground_balance(std::span<const ContactSample> contacts, double total_mass, const Vec3& gravity, double dt) {
  const Vec3 weight = dt * total_mass * gravity;
  Vec3 sum = weight;
  for (const ExternalImpulse& external : ground_impulses(contacts)) sum += external.impulse;
  return sum.norm() / weight.norm();
}

double body_balance(const BodyState& before, const BodyState& body, std::span<const ContactSample> contacts,
                    const Vec3& gravity, double dt, const Scale& scale) {
  Vec3 linear = body.momentum() - before.momentum() - dt * body.mass.mass * gravity;
  Vec3 angular = body.spin() - before.spin();
  for (const ContactSample& sample : contacts) {
    if (sample.a != &body && sample.b != &body) continue;
    const Vec3 impulse = (sample.b == &body ? 1 : -1) * impulse_on_b(sample);
    linear -= impulse;
    angular -= (vec(sample.contact->position) - before.centre()).cross(impulse);
  }
  return std::max(linear.lpNorm<Eigen::Infinity>(), angular.lpNorm<Eigen::Infinity>() / scale.length) / scale.impulse;
}

}  // namespace plumb::referee
