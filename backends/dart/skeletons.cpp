#include "skeletons.hpp"

#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/TranslationalJoint.hpp>
#include <dart/dynamics/WeldJoint.hpp>

#include "plumb/backend/mass_properties.hpp"

namespace plumb::dart6 {
namespace {

using namespace ::dart::dynamics;

/// DART wants moments above 0 also of what it never turns.
Inertia inertia_of(const Body& body) {
  if (!body.is(PLUMB_DYNAMIC)) return Inertia(1);
  const PlumbBodyDesc& desc = body.desc;
  if (!body.turns()) return Inertia(desc.mass, eigen(desc.centre_of_mass));
  const Eigen::Matrix3d axes = eigen(normalized(desc.inertia_orientation));
  return Inertia(desc.mass, eigen(desc.centre_of_mass), axes * eigen(desc.inertia).asDiagonal() * axes.transpose());
}

/// Between two of a link's joints there is a node that weighs next to nothing.
Inertia almost_nothing(const Body& body) {
  constexpr double share = 1e-12;
  return Inertia(share * body.desc.mass, Eigen::Vector3d::Zero(),
                 share * eigen(body.desc.inertia).minCoeff() * Eigen::Matrix3d::Identity());
}

/// Nodes of one body, each by a joint below the one before.
class Chain {
 public:
  Chain(const SkeletonPtr& skeleton, Body& body, const Eigen::Isometry3d& from)
      : skeleton_(skeleton), body_(body), from_(from), node_(body.parent == nullptr ? nullptr : body.parent->node) {
    body.joints.clear();
  }

  /// The last joint's frame is at `to` in the body; those before it carry nothing.
  template <class DartJoint>
  DartJoint* add(typename DartJoint::Properties properties, bool last, const Eigen::Isometry3d& to) {
    const std::string name = "b" + std::to_string(slot_of(body_.handle)) + "." + std::to_string(body_.joints.size());
    properties.mName = name + "j";
    properties.mT_ParentBodyToJoint = from_;
    properties.mT_ChildBodyToJoint = last ? to : Eigen::Isometry3d::Identity();
    const BodyNode::Properties node(BodyNode::AspectProperties(name, last ? inertia_of(body_) : almost_nothing(body_)));
    const auto made = skeleton_->createJointAndBodyNodePair<DartJoint>(node_, properties, node);
    from_ = Eigen::Isometry3d::Identity();
    node_ = body_.node = made.second;
    body_.joints.push_back(made.first);
    return made.first;
  }

 private:
  SkeletonPtr skeleton_;
  Body& body_;
  Eigen::Isometry3d from_;
  BodyNode* node_;
};

// --- what hangs on nothing -------------------------------------------------------------------------------------------

void add_free(const SkeletonPtr& skeleton, Body& body) {
  Chain chain(skeleton, body, Eigen::Isometry3d::Identity());
  if (body.is(PLUMB_STATIC)) {
    chain.add<WeldJoint>({}, true, Eigen::Isometry3d::Identity());
  } else if (!body.turns()) {
    chain.add<TranslationalJoint>({}, true, Eigen::Isometry3d::Identity());
  } else {
    FreeJoint* joint = chain.add<FreeJoint>({}, true, eigen(PlumbPose{body.centre_of_mass(), {0, 0, 0, 1}}));
    if (body.is(PLUMB_KINEMATIC)) joint->setActuatorType(::dart::dynamics::Joint::VELOCITY);
  }
}

// --- links -----------------------------------------------------------------------------------------------------------

void set_spring(const Joint& link, std::size_t axis, ::dart::dynamics::Joint& joint) {
  const PlumbSpring& spring = link.desc.springs[axis];
  if (spring.enabled == 0) return;
  const auto [stiffness, damping] = stiffness_of(link, axis);
  joint.setSpringStiffness(0, stiffness);
  joint.setDampingCoefficient(0, damping);
}

void set_limits(const Joint& link, std::size_t axis, ::dart::dynamics::Joint& joint) {
  if (!is_limited(link.desc, axis)) return;
  joint.setPositionLowerLimit(0, link.desc.limits[axis].lower);
  joint.setPositionUpperLimit(0, link.desc.limits[axis].upper);
  joint.setLimitEnforcement(true);
}

template <class DartJoint>
::dart::dynamics::Joint* add_axis(Chain& chain, std::size_t axis, bool reversed, bool last,
                                  const Eigen::Isometry3d& to) {
  typename DartJoint::Properties properties;
  properties.mAxis = eigen(scale(reversed ? -1 : 1, unit(axis % 3)));
  return chain.add<DartJoint>(properties, last, to);
}

/// Translations first, seen from the joint's frame a; from b to a everything goes the other way round.
void add_axes(Chain& chain, Body& body, const Eigen::Isometry3d& to) {
  Joint& link = *body.link;
  const bool ball = is_plain_ball(link.desc);
  std::vector<std::size_t> axes;
  for (std::size_t axis = 0; axis < 6; ++axis)
    if ((open_axes(link.desc) >> axis & 1) != 0 && !(ball && axis > 3)) axes.push_back(axis);
  if (body.reversed) std::reverse(axes.begin(), axes.end());
  for (const std::size_t axis : axes) {
    const bool last = axis == axes.back();
    if (ball && axis == 3) {
      chain.add<BallJoint>({}, last, to);
      continue;
    }
    ::dart::dynamics::Joint* joint = axis < 3 ? add_axis<PrismaticJoint>(chain, axis, body.reversed, last, to)
                                              : add_axis<RevoluteJoint>(chain, axis, body.reversed, last, to);
    link.axis_joint[axis] = joint;
    set_limits(link, axis, *joint);
    set_spring(link, axis, *joint);
  }
  if (axes.empty()) chain.add<WeldJoint>({}, true, to);
}

void add_link(const SkeletonPtr& skeleton, Body& body) {
  Joint& link = *body.link;
  link.axis_joint.fill(nullptr);
  PlumbPose from = body.reversed ? link.desc.frame_b : link.desc.frame_a;
  const PlumbPose& to = body.reversed ? link.desc.frame_a : link.desc.frame_b;
  const Body* ground = body.reversed ? link.b : link.a;
  if (body.parent == nullptr && ground != nullptr) from = compose(ground->pose, from);
  Chain chain(skeleton, body, eigen(from));
  add_axes(chain, body, eigen(to));
  apply_motors(link);
  apply_targets(link);
}

// --- shapes ----------------------------------------------------------------------------------------------------------

void add_geom(Skeletons& made, const Geom& geom) {
  ShapeNode* node = geom.body->node->createShapeNodeWith<CollisionAspect, DynamicsAspect>(geom.shape->geometry);
  node->setRelativeTransform(eigen(compose(geom.at, geom.shape->frame)));
  made.geom_of[node] = made.geoms.size();
  made.geoms.push_back(geom);
}

void add_geoms(Skeletons& made, Body& body) {
  if (body.shape == nullptr) return;
  if (body.shape->type != PLUMB_COMPOUND)
    return add_geom(made, {&body, body.shape, 0, identity_pose(), &body.desc.material});
  std::uint32_t index = 0;
  for (const Shape::Child& child : body.shape->children)
    add_geom(made,
             {&body, child.shape, index++, child.pose, child.has_material ? &child.material : &body.desc.material});
}

}  // namespace

Skeletons make_skeletons(std::vector<Body*> order, const PlumbVec3& gravity) {
  Skeletons made;
  for (Body* body : order) {
    if (body->parent == nullptr) {
      made.all.push_back(Skeleton::create("s" + std::to_string(slot_of(body->handle))));
      made.all.back()->setGravity(eigen(gravity));
      made.all.back()->setMobile(!body->is(PLUMB_STATIC));
    }
    if (body->link != nullptr) {
      add_link(made.all.back(), *body);
    } else {
      add_free(made.all.back(), *body);
    }
    add_geoms(made, *body);
    body->written = true;
  }
  made.bodies = std::move(order);
  return made;
}

void apply_motors(const Joint& link) {
  for (std::size_t axis = 0; axis < 6; ++axis) {
    ::dart::dynamics::Joint* joint = link.axis_joint[axis];
    if (joint == nullptr) continue;
    const PlumbMotor& motor = link.desc.motors[axis];
    const double most = motor.enabled != 0 ? motor.max_force : 0;
    joint->setActuatorType(most > 0 ? ::dart::dynamics::Joint::SERVO : ::dart::dynamics::Joint::FORCE);
    joint->setForceUpperLimit(0, most > 0 ? most : std::numeric_limits<double>::infinity());
    joint->setForceLowerLimit(0, most > 0 ? -most : -std::numeric_limits<double>::infinity());
    joint->setCommand(0, most > 0 ? motor.target_velocity : 0);
  }
}

void apply_targets(const Joint& link) {
  for (std::size_t axis = 0; axis < 6; ++axis)
    if (link.axis_joint[axis] != nullptr && link.desc.springs[axis].enabled != 0)
      link.axis_joint[axis]->setRestPosition(0, link.desc.springs[axis].rest);
}

}  // namespace plumb::dart6
