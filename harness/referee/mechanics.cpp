#include "referee/mechanics.hpp"

#include <algorithm>

#include "plumb/assert.hpp"

namespace plumb::referee {

Energy energy(std::span<const BodyState> bodies, const Vec3& gravity, const Vec3& datum, double spring) {
  Energy sum;
  for (const BodyState& body : bodies) {
    if (body.mass.mass == 0) continue;
    sum.linear += body.mass.mass * body.linear.squaredNorm() / 2;
    sum.rotational += body.angular.dot(body.spin()) / 2;
    sum.potential -= body.mass.mass * gravity.dot(body.centre() - datum);
  }
  sum.spring = spring;
  return sum;
}

double total_mass(std::span<const BodyState> bodies) {
  double sum = 0;
  for (const BodyState& body : bodies) sum += body.mass.mass;
  return sum;
}

Vec3 linear_momentum(std::span<const BodyState> bodies) {
  Vec3 sum = Vec3::Zero();
  for (const BodyState& body : bodies)
    if (body.mass.mass != 0) sum += body.momentum();
  return sum;
}

Vec3 angular_momentum(std::span<const BodyState> bodies, const Vec3& about) {
  Vec3 sum = Vec3::Zero();
  for (const BodyState& body : bodies)
    if (body.mass.mass != 0) sum += body.spin() + (body.centre() - about).cross(body.momentum());
  return sum;
}

double sum_of_momenta(std::span<const BodyState> bodies) {
  double sum = 0;
  for (const BodyState& body : bodies) sum += body.momentum().norm();
  return sum;
}

void EnergyAccount::add(double total, double work) {
  if (!start_) {
    start_ = first_ = last_ = highest_ = total;
    return;
  }
  const double gain = total - last_ - work;
  injected_ += std::max(0.0, gain);
  lost_ += std::max(0.0, -gain);
  work_ += work;
  last_ = total;
  highest_ = std::max(highest_, total - work_);
}

MomentumBalance momentum_balance(std::span<const BodyState> before, std::span<const BodyState> after,
                                 const Vec3& gravity, double dt, std::span<const ExternalImpulse> impulses,
                                 const Vec3& about) {
  PLUMB_ASSERT(before.size() == after.size());
  MomentumBalance balance{linear_momentum(after) - linear_momentum(before),
                          angular_momentum(after, about) - angular_momentum(before, about)};
  for (const BodyState& body : before) {
    const Vec3 weight = dt * body.mass.mass * gravity;
    balance.linear -= weight;
    if (body.mass.mass != 0) balance.angular -= (body.centre() - about).cross(weight);
  }
  for (const ExternalImpulse& external : impulses) {
    balance.linear -= external.impulse;
    balance.angular -= (external.point - about).cross(external.impulse);
  }
  return balance;
}

}  // namespace plumb::referee
