#include "measure/instruments/contact_laws.hpp"

#include <algorithm>
#include <cmath>

#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"

namespace plumb::harness {
namespace {

using referee::BodyState;
using referee::ContactSample;
using referee::Mat3;
using referee::vec;
using referee::Vec3;

constexpr double length = 1;  // m, that gaps and speeds are relative to

/// Velocity at the point by the impulse there, as the trace of the matrix between them; 0 for what cannot move.
double mobility(const BodyState& body, const Vec3& point) {
  if (body.mass.mass <= 0) return 0;
  const Vec3 arm = point - body.centre();
  Mat3 cross;
  cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
  const Mat3 inertia = body.inertia();
  double trace = 3 / body.mass.mass;
  if (inertia.determinant() > 0) trace -= (cross * inertia.inverse() * cross).trace();
  return trace;
}

}  // namespace

double natural_map(const ContactSample& sample, const referee::Scale& scale) {
  const Vec3 point = vec(sample.contact->position), normal = vec(sample.contact->normal);
  const referee::Slip slip = referee::slip_of(sample);
  const double bounce = sample.restitution * std::max(0.0, sample.approach_speed);
  const Vec3 lifted = (slip.normal - bounce + sample.friction * slip.tangent.norm()) * normal + slip.tangent;
  const double trace = mobility(*sample.a, point) + mobility(*sample.b, point);
  const double rho = trace > 0 ? 3 / trace : 0;
  const Vec3 impulse = sample.contact->normal_impulse * normal + vec(sample.contact->tangent_impulse);
  return (impulse - referee::project_on_cone(impulse - rho * lifted, normal, sample.friction)).norm() / scale.impulse;
}

LawResiduals law_residuals(std::span<const BodyState> before, std::span<const BodyState> after,
                           std::span<const ContactSample> samples, const Vec3& gravity, double dt, bool balance) {
  const double mass = referee::total_mass(after), strength = gravity.norm();
  const referee::Scale scale = referee::scale_of(mass, strength, dt, length);
  LawResiduals residuals;
  residuals.quality = referee::contact_quality(samples, scale);
  residuals.body_balance = residuals.world_balance = residuals.ground_balance = not_measured;
  if (residuals.quality.without_impulse > 0) return residuals;
  for (const ContactSample& sample : samples)
    residuals.natural_map = largest(residuals.natural_map, natural_map(sample, scale));
  residuals.ground_balance = referee::ground_balance(samples, mass, gravity, dt);
  if (!balance) return residuals;
  std::vector<std::vector<ContactSample>> own(after.size());  // a body needs only its own
  for (const ContactSample& sample : samples) {
    own[static_cast<std::size_t>(sample.a - after.data())].push_back(sample);
    own[static_cast<std::size_t>(sample.b - after.data())].push_back(sample);
  }
  residuals.body_balance = 0;
  for (std::size_t i = 0; i < after.size(); ++i)
    if (after[i].mass.mass > 0)
      residuals.body_balance =
          largest(residuals.body_balance, referee::body_balance(before[i], after[i], own[i], gravity, dt, scale));
  const std::vector<referee::ExternalImpulse> external = referee::ground_impulses(samples);
  residuals.world_balance =
      referee::momentum_balance(before, after, gravity, dt, external).linear.norm() / scale.impulse;
  return residuals;
}

ContactLaws::ContactLaws(Simulation& simulation) {
  const Scene& scene = simulation.scene();
  judges_ =
      (scene.needs & PLUMB_NEED_CONTACT_IMPULSES) != 0 && vec(scene.gravity).norm() > 0 && !scene.has_part_materials();
  if (!judges_) return;
  balance_ = scene.joints.empty() && (scene.needs & (PLUMB_NEED_FORCES | PLUMB_NEED_DAMPING)) == 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const PlumbBodyDesc& desc = scene.bodies[i].desc;
    if (desc.gravity_scale != 1 || desc.locks != 0) balance_ = false;
    masses_.push_back(mass_of_body(scene, i));
    index_[simulation.handle(i)] = i;
  }
}

void ContactLaws::before_step(Simulation& simulation) {
  if (judges_)
    before_ = referee::body_states<PoseRow, VelocityRow>(masses_, simulation.poses(), simulation.velocities());
}

void ContactLaws::after_step(Simulation& simulation) {
  if (!judges_ || before_.empty()) return;
  const Scene& scene = simulation.scene();
  const auto after = referee::body_states<PoseRow, VelocityRow>(masses_, simulation.poses(), simulation.velocities());
  std::vector<ContactSample> samples;
  for (const PlumbContact& contact : simulation.contacts()) {
    const auto a = index_.find(contact.body_a), b = index_.find(contact.body_b);
    if (a == index_.end() || b == index_.end()) continue;
    const PlumbMaterial &one = scene.bodies[a->second].desc.material, &other = scene.bodies[b->second].desc.material;
    ContactSample sample{&contact, &before_[a->second], &before_[b->second], std::sqrt(one.friction * other.friction)};
    sample.restitution = std::max(one.restitution, other.restitution);
    sample.approach_speed = std::max(0.0, -referee::slip_of(sample).normal);
    sample.a = &after[a->second];
    sample.b = &after[b->second];
    samples.push_back(sample);
  }
  const LawResiduals now = law_residuals(before_, after, samples, vec(scene.gravity), scene.dt, balance_);
  before_.clear();
  if (now.quality.contacts <= now.quality.without_impulse) return;
  known_ = true;
  referee::ContactQuality& q = worst_.quality;
  q.cone_max = largest(q.cone_max, now.quality.cone_max);
  q.cone_distance_max = largest(q.cone_distance_max, now.quality.cone_distance_max);
  q.signorini_speed_max = largest(q.signorini_speed_max, now.quality.signorini_speed_max);
  q.signorini_gap_max = largest(q.signorini_gap_max, now.quality.signorini_gap_max);
  q.pull_max = largest(q.pull_max, now.quality.pull_max);
  q.creep_max = largest(q.creep_max, now.quality.creep_max);
  q.complementarity_max = largest(q.complementarity_max, now.quality.complementarity_max);
  if (std::isfinite(now.quality.dissipation_mean)) {
    defect_sum_ += now.quality.dissipation_mean;
    ++defect_steps_;
  }
  worst_.natural_map = largest(worst_.natural_map, now.natural_map);
  worst_.body_balance = largest(worst_.body_balance, now.body_balance);
  worst_.world_balance = largest(worst_.world_balance, now.world_balance);
  worst_.ground_balance = now.ground_balance;
}

void ContactLaws::add_to(std::vector<Metric>& metrics) const {
  if (!known_) return;
  const auto add = [&](const char* name, double value, const char* note) {
    if (!std::isnan(value)) metrics.push_back({name, value, 0.0, std::abs(value), std::nullopt, note});
  };
  const referee::ContactQuality& q = worst_.quality;
  add("cone_violation_max", q.cone_max, "of the friction cone, at sampled times");
  add("cone_distance_max", q.cone_distance_max, "of an impulse from its cone, relative to the weight in a step");
  add("signorini_speed_max", q.signorini_speed_max, "impulse times parting speed");
  add("signorini_gap_max", q.signorini_gap_max, "impulse times gap");
  add("pull_max", q.pull_max, "impulse that pulls");
  add("creep_max", q.creep_max, "slip speed of contacts inside their cone");
  add("complementarity_max", q.complementarity_max, "De Saxce's");
  add("natural_map_max", worst_.natural_map, "of the frictional contact problem");
  add("body_balance_max", worst_.body_balance, "momentum that a body's contacts do not account for");
  add("world_balance_max", worst_.world_balance, "momentum that the ground does not account for");
  add("ground_balance_end", worst_.ground_balance, "ground's impulses against the weight, last sample; of use at rest");
  if (defect_steps_ > 0)
    add("dissipation_defect", defect_sum_ / static_cast<double>(defect_steps_), "0: friction does all the work it may");
}

std::vector<MetricSpec> ContactLaws::specs() {
  std::vector<MetricSpec> specs;
  for (const char* name : {"cone_violation_max", "cone_distance_max", "signorini_speed_max", "signorini_gap_max",
                           "pull_max", "creep_max", "complementarity_max", "natural_map_max", "body_balance_max",
                           "world_balance_max", "ground_balance_end", "dissipation_defect"})
    specs.push_back({name, "1", "", std::nullopt, std::nullopt});
  return specs;
}

}  // namespace plumb::harness
