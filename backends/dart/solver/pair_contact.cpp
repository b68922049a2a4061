#include "solver/pair_contact.hpp"

#include <dart/collision/CollisionObject.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/ShapeNode.hpp>

namespace plumb::dart6 {
namespace {

using ::dart::collision::Contact;

::dart::dynamics::ShapeNode& node_of(const ::dart::collision::CollisionObject* object) {
  return *const_cast<::dart::dynamics::ShapeFrame*>(object->getShapeFrame())->asShapeNode();
}

/// m/s, world axes, of the point of contact as it moves with the body.
Eigen::Vector3d speed_at(const ::dart::collision::CollisionObject* object, const Eigen::Vector3d& point) {
  const auto body = node_of(object).getBodyNodePtr();
  const Eigen::Vector3d local = body->getWorldTransform().inverse() * point;
  return body->getLinearVelocity(local);
}

/// Of the second body's surface, seen from the first's.
Eigen::Vector3d speed_between(const Contact& contact, const PairMaterial& material) {
  return speed_at(contact.collisionObject2, contact.point) - speed_at(contact.collisionObject1, contact.point) -
         material.slide;
}

/// Unit; 0, which leaves it to DART, where that is wanted or nothing slides.
Eigen::Vector3d friction_direction(const Contact& contact, const PairMaterial& material, const Settings& settings) {
  constexpr double slowest = 1e-6;  // m/s
  if (settings.friction_directions == kOfNormal) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d between = speed_between(contact, material);
  const Eigen::Vector3d along = between - contact.normal.dot(between) * contact.normal;
  return along.norm() < slowest ? Eigen::Vector3d::Zero() : along.normalized();
}

/// DART reads friction from the shapes while the constraint is made, and keeps it: both get that of the pair.
Contact& with_friction(Contact& contact, const PairMaterial& material, const Settings& settings) {
  const Eigen::Vector3d direction = friction_direction(contact, material, settings);
  for (const auto* object : {contact.collisionObject1, contact.collisionObject2}) {
    ::dart::dynamics::DynamicsAspect& surface = *node_of(object).getDynamicsAspect();
    surface.setFrictionCoeff(material.friction);
    if (surface.getFirstFrictionDirection() == direction) continue;
    surface.setFirstFrictionDirectionFrame(::dart::dynamics::Frame::World());
    surface.setFirstFrictionDirection(direction);
  }
  return contact;
}

double inverse_mass(const ::dart::collision::CollisionObject* object) {
  const auto body = node_of(object).getBodyNodePtr();
  return body->isReactive() ? 1 / body->getMass() : 0;
}

}  // namespace

PairContact::PairContact(Contact& contact, const PairMaterial& material, const Settings& settings, double h)
    : ContactConstraint(with_friction(contact, material, settings), h),
      contact_(contact),
      material_(material),
      settings_(settings),
      inverse_mass_(inverse_mass(contact.collisionObject1) + inverse_mass(contact.collisionObject2)) {}

/// As DART does it: of taking back overlap and rebounding the faster.
double PairContact::wanted_speed(double closing, double rate) const {
  const double overlap = std::max(contact_.penetrationDepth - settings_.contact_allowance, 0.0);
  const double back = std::min(overlap * settings_.contact_reduction * rate, settings_.contact_reduction_speed);
  const double rebound = material_.restitution * closing;
  return rebound > settings_.bounce_speed ? std::max(back, rebound) : back;
}

/// DART's normal goes from the second body to the first, and b is the change of velocity that is asked for.
void PairContact::getInformation(::dart::constraint::ConstraintInfo* info) {
  ContactConstraint::getInformation(info);
  const double closing = contact_.normal.dot(speed_between(contact_, {0, 0, Eigen::Vector3d::Zero()}));
  info->b[0] = closing + wanted_speed(closing, info->invTimeStep);
  if (getDimension() == 1) return;
  const Eigen::Vector3d first = contact_.normal.cross(getFrictionDirection1());
  const Eigen::Vector3d tangent =
      (first.squaredNorm() < 1e-12 ? contact_.normal.cross(Eigen::Vector3d::UnitX()).eval() : first).normalized();
  info->b[1] -= material_.slide.dot(contact_.normal.cross(tangent));
  info->b[2] -= material_.slide.dot(tangent);
}

void PairContact::applyUnitImpulse(std::size_t index) {
  ContactConstraint::applyUnitImpulse(index);
  applied_ = index;
}

/// A door that is pressed along its axis moves for no impulse, and one of any size would be the answer: it gets none.
void PairContact::getVelocityChange(double* change, bool with_softness) {
  constexpr double nothing = 1e-12;  // of what a free body would yield
  ContactConstraint::getVelocityChange(change, with_softness);
  if (with_softness && change[applied_] < nothing * inverse_mass_) change[applied_] = inverse_mass_ / nothing;
}

}  // namespace plumb::dart6
