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

/// DART reads friction from the shapes while the constraint is made, and keeps it: both get that of the pair.
Contact& with_friction(Contact& contact, double friction) {
  for (const auto* object : {contact.collisionObject1, contact.collisionObject2})
    node_of(object).getDynamicsAspect()->setFrictionCoeff(friction);
  return contact;
}

/// m/s, world axes, of the point of contact as it moves with the body.
Eigen::Vector3d speed_at(const ::dart::collision::CollisionObject* object, const Eigen::Vector3d& point) {
  const auto body = node_of(object).getBodyNodePtr();
  const Eigen::Vector3d local = body->getWorldTransform().inverse() * point;
  return body->getLinearVelocity(local);
}

}  // namespace

PairContact::PairContact(Contact& contact, const PairMaterial& material, const Settings& settings, double h)
    : ContactConstraint(with_friction(contact, material.friction), h),
      contact_(contact),
      material_(material),
      settings_(settings) {}

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
  const Eigen::Vector3d between =
      speed_at(contact_.collisionObject2, contact_.point) - speed_at(contact_.collisionObject1, contact_.point);
  const double closing = contact_.normal.dot(between);
  info->b[0] = closing + wanted_speed(closing, info->invTimeStep);
  if (getDimension() == 1) return;
  const Eigen::Vector3d first = contact_.normal.cross(getFrictionDirection1());
  const Eigen::Vector3d tangent =
      (first.squaredNorm() < 1e-12 ? contact_.normal.cross(Eigen::Vector3d::UnitX()).eval() : first).normalized();
  info->b[1] -= material_.slide.dot(contact_.normal.cross(tangent));
  info->b[2] -= material_.slide.dot(tangent);
}

}  // namespace plumb::dart6
