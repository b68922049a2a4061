// What moves, between bodies and DART's coordinates: of free bodies as they are, of those in trees along the free axes
// of their joints.
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/FreeJoint.hpp>

#include "making.hpp"
#include "plumb/backend/joint_coordinates.hpp"
#include "world.hpp"

namespace plumb::dart6 {
namespace {

using ::dart::dynamics::BallJoint;
using ::dart::dynamics::FreeJoint;

}  // namespace

void place(const Body& body) {
  ::dart::dynamics::Joint& joint = *body.joints.front();
  const Eigen::Isometry3d pose = eigen(body.pose);
  if (body.is(PLUMB_STATIC)) return joint.setTransformFromParentBodyNode(pose);
  if (!body.turns()) {
    Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
    turned.linear() = pose.linear().transpose();
    joint.setTransformFromChildBodyNode(turned);
    joint.setPositions(pose.translation());
    joint.setVelocities(eigen(body.velocity));
    return;
  }
  Eigen::Vector6d rates;
  rates.head<3>() = pose.linear().transpose() * eigen(body.spin);
  rates.tail<3>() = pose.linear().transpose() * eigen(body.velocity);
  joint.setPositions(FreeJoint::convertToPositions(pose * joint.getTransformFromChildBodyNode()));
  joint.setVelocities(rates);
  if (!body.is(PLUMB_KINEMATIC)) return;
  // DART adds this much to the speed of what turns and moves, which a kinematic body is to keep.
  rates.tail<3>() -= joint.getSkeleton()->getTimeStep() * rates.head<3>().cross(rates.tail<3>()).eval();
  joint.setCommands(rates);
}

namespace {

void write_coordinates(const Body& body) {
  const Joint& link = *body.link;
  const PlumbPose a = link.frame_a(), b = link.frame_b();
  double row[6] = {};
  backend::joint_coordinates(link.desc.type, a, b, row);
  for (std::size_t axis = 0; axis < 6; ++axis)
    if (link.axis_joint[axis] != nullptr) link.axis_joint[axis]->setPosition(0, row[axis]);
  if (!is_plain_ball(link.desc)) return;
  const PlumbQuat turn = multiply(backend::conjugate(a.orientation), b.orientation);
  ::dart::dynamics::Joint* ball = body.reversed ? body.joints.front() : body.joints.back();
  ball->setPositions(BallJoint::convertToPositions(eigen(body.reversed ? backend::conjugate(turn) : turn)));
}

/// Parents come first: what of the body's velocity is not theirs is that of its own joints.
void write_rates(const Body& body) {
  std::size_t count = 0;
  for (::dart::dynamics::Joint* joint : body.joints) {
    joint->setVelocities(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(joint->getNumDofs())));
    count += joint->getNumDofs();
  }
  if (count == 0) return;
  const Eigen::Matrix3d to_body = body.node->getWorldTransform().linear().transpose();
  const PlumbVec3 arm = sub(body.centre(), body.pose.position);
  Eigen::Vector6d wanted;
  wanted.head<3>() = to_body * eigen(body.spin);
  wanted.tail<3>() = to_body * eigen(sub(body.velocity, cross(body.spin, arm)));
  const Eigen::MatrixXd columns = body.node->getJacobian().rightCols(static_cast<Eigen::Index>(count));
  const Eigen::VectorXd rates =
      columns.completeOrthogonalDecomposition().solve(wanted - body.node->getSpatialVelocity());
  Eigen::Index next = 0;
  for (::dart::dynamics::Joint* joint : body.joints) {
    const auto dofs = static_cast<Eigen::Index>(joint->getNumDofs());
    joint->setVelocities(rates.segment(next, dofs));
    next += dofs;
  }
}

void read_body(Body& body) {
  if (!body.is(PLUMB_DYNAMIC)) return;
  const PlumbPose now = pose_of(body.node->getWorldTransform());
  body.velocity = vec(body.node->getCOMLinearVelocity());
  body.pose.position = now.position;
  if (!body.turns()) return;
  body.pose.orientation = now.orientation;
  body.spin = vec(body.node->getAngularVelocity());
}

}  // namespace

World::~World() { make_stale(); }

void World::make_stale() {
  const std::lock_guard lock(making());
  collisions_.forget();
  meeting_.touching.clear();
  holds_.clear();
  solver_.set_skeletons({});
  skeletons_ = {};
  stale_ = true;
}

void World::prepare() {
  if (stale_) {
    const std::lock_guard lock(making());
    skeletons_ = make_skeletons(grow_trees(bodies_, joints_), gravity_);
    solver_.set_skeletons(skeletons_.all);
    apart_.clear();
    for (const auto& joint : joints_)
      if (joint && joint->a != nullptr && joint->desc.collide_connected == 0)
        apart_.insert(in_order(*joint->a, *joint->b));
    if (needs(PLUMB_NEED_COLLISION | PLUMB_NEED_SENSORS | PLUMB_NEED_QUERIES))
      collisions_.take(skeletons_, [this](const Geom& a, const Geom& b) { return may_meet(a, b); });
    stale_ = false;
  }
  write_state();
}

/// All of a tree is written where something of it was: coordinates are of bodies seen from their parents.
void World::write_state() {
  std::set<const ::dart::dynamics::Skeleton*> touched;
  for (const Body* body : skeletons_.bodies)
    if (body->written) touched.insert(body->node->getSkeleton().get());
  if (touched.empty()) return;
  const auto each = [&](auto&& act) {
    for (Body* body : skeletons_.bodies)
      if (touched.contains(body->node->getSkeleton().get())) act(*body);
  };
  each([](const Body& body) { body.link == nullptr ? place(body) : write_coordinates(body); });
  each([](Body& body) {
    if (body.link != nullptr) write_rates(body);
    body.written = false;
  });
}

void World::read_state() {
  for (Body* body : skeletons_.bodies) read_body(*body);
}

/// Changes the velocity at once: of a body in a tree with all of the tree.
void World::push(Body& at, const PlumbVec3& impulse, const PlumbVec3& twist) {
  if (!at.is(PLUMB_DYNAMIC)) return;
  prepare();
  const ::dart::dynamics::SkeletonPtr skeleton = at.node->getSkeleton();
  const Eigen::Isometry3d& pose = at.node->getWorldTransform();
  const Eigen::Vector3d force = pose.linear().transpose() * eigen(impulse);
  Eigen::Vector6d wrench;
  wrench.head<3>() = pose.linear().transpose() * eigen(twist) + at.node->getLocalCOM().cross(force);
  wrench.tail<3>() = force;
  skeleton->clearConstraintImpulses();
  at.node->addConstraintImpulse(wrench);
  skeleton->computeImpulseForwardDynamics();
  skeleton->clearConstraintImpulses();
  for (Body* body : skeletons_.bodies)
    if (body->node->getSkeleton() == skeleton) read_body(*body);
}

}  // namespace plumb::dart6
