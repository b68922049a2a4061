#include <cmath>
#include <sdf/Element.hh>

#include "hosts/gazebo/sdf/read.hpp"

namespace plumb::gazebo {

Placement pose_of(const sdf::SemanticPose& said) {
  Placement pose;
  return said.Resolve(pose).empty() ? pose : said.RawPose();
}

std::string fault_of(const ignition::math::Inertiald& inertial) {
  const auto& mass = inertial.MassMatrix();
  if (!inertial.Pose().IsFinite()) return "its centre of mass is not finite";
  if (!std::isfinite(mass.Mass()) || mass.Mass() <= 0)
    return "its mass is " + std::to_string(mass.Mass()) + " kg; what moves must have some, or its model be static";
  const Vector moments = mass.PrincipalMoments();
  for (const double moment : {moments.X(), moments.Y(), moments.Z()})
    if (!std::isfinite(moment) || moment <= 0)
      return "its inertia has a principal moment of " + std::to_string(moment) + " kg m2; all must be above 0";
  return "";
}

bool gravity_of(const sdf::Link& link) {
  const sdf::ElementPtr element = link.Element();
  return !element || !element->HasElement("gravity") || element->Get<bool>("gravity");
}

}  // namespace plumb::gazebo
