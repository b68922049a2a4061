#include "solver/rows_constraint.hpp"

#include <algorithm>
#include <dart/dynamics/BodyNode.hpp>

namespace plumb::dart6 {

using ::dart::dynamics::BodyNode;
using ::dart::dynamics::SkeletonPtr;

RowsConstraint::RowsConstraint(BodyNode* a, BodyNode* b, std::vector<Row> rows)
    : rows_(std::move(rows)), impulses_(rows_.size(), 0.0) {
  mDim = rows_.size();
  if (a != nullptr) ends_.push_back(end_of(a, rows_, -1));
  if (b != nullptr) ends_.push_back(end_of(b, rows_, 1));
}

RowsConstraint::End RowsConstraint::end_of(BodyNode* node, const std::vector<Row>& rows, double sign) {
  End end{node, {}, node->isReactive()};
  const Eigen::Isometry3d& pose = node->getWorldTransform();
  const Eigen::Matrix3d to_body = pose.linear().transpose();
  for (const Row& row : rows) {
    Eigen::Vector6d wrench;
    const Eigen::Vector3d force = sign * row.force_b, arm = row.at - pose.translation();
    wrench.head<3>() = to_body * (sign * row.torque_b + arm.cross(force));
    wrench.tail<3>() = to_body * force;
    end.wrenches.push_back(wrench);
  }
  return end;
}

void RowsConstraint::getInformation(::dart::constraint::ConstraintInfo* info) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    info->lo[i] = rows_[i].least;
    info->hi[i] = rows_[i].most;
    info->x[i] = 0;
    info->b[i] = rows_[i].speed;
    for (const End& end : ends_) info->b[i] -= end.wrenches[i].dot(end.node->getSpatialVelocity());
  }
}

/// Two bodies of one skeleton are pushed at once, as DART's contacts within one do it.
void RowsConstraint::applyUnitImpulse(std::size_t index) {
  std::vector<const End*> pushed;
  for (const End& end : ends_)
    if (end.reactive) pushed.push_back(&end);
  if (pushed.size() == 2 && pushed[0]->node->getSkeleton() == pushed[1]->node->getSkeleton()) {
    const SkeletonPtr skeleton = pushed[0]->node->getSkeleton();
    skeleton->clearConstraintImpulses();
    skeleton->updateBiasImpulse(pushed[0]->node, pushed[0]->wrenches[index], pushed[1]->node,
                                pushed[1]->wrenches[index]);
    skeleton->updateVelocityChange();
  } else {
    for (const End* end : pushed) {
      const SkeletonPtr skeleton = end->node->getSkeleton();
      skeleton->clearConstraintImpulses();
      skeleton->updateBiasImpulse(end->node, end->wrenches[index]);
      skeleton->updateVelocityChange();
    }
  }
  applied_ = index;
}

void RowsConstraint::getVelocityChange(double* change, bool with_softness) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    change[i] = 0;
    for (const End& end : ends_)
      if (end.reactive && end.node->getSkeleton()->isImpulseApplied())
        change[i] += end.wrenches[i].dot(end.node->getBodyVelocityChange());
  }
  if (with_softness) change[applied_] += softness(applied_);
}

double RowsConstraint::softness(std::size_t row) const {
  constexpr double share = 1e-8;
  double sum = rows_[row].softness;
  for (const End& end : ends_) {
    const Eigen::Vector6d& wrench = end.wrenches[row];
    if (end.reactive) sum += share * wrench.dot(end.node->getSpatialInertia().ldlt().solve(wrench));
  }
  return sum;
}

void RowsConstraint::set_excited(bool excited) {
  for (const End& end : ends_)
    if (end.reactive) end.node->getSkeleton()->setImpulseApplied(excited);
}

void RowsConstraint::applyImpulse(double* impulses) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    impulses_[i] = impulses[i];
    for (const End& end : ends_)
      if (end.reactive) end.node->addConstraintImpulse(Eigen::Vector6d(end.wrenches[i] * impulses[i]));
  }
}

bool RowsConstraint::isActive() const {
  return mDim > 0 && std::any_of(ends_.begin(), ends_.end(), [](const End& end) { return end.reactive; });
}

SkeletonPtr RowsConstraint::getRootSkeleton() const {
  for (const End& end : ends_)
    if (end.reactive) return ConstraintBase::getRootSkeleton(end.node->getSkeleton());
  return nullptr;
}

/// The smaller of two sets joins the larger, as for DART's own constraints.
void RowsConstraint::uniteSkeletons() {
  if (ends_.size() < 2 || !ends_[0].reactive || !ends_[1].reactive) return;
  SkeletonPtr small = compressPath(ends_[0].node->getSkeleton());
  SkeletonPtr large = compressPath(ends_[1].node->getSkeleton());
  if (small == large) return;
  if (small->mUnionSize > large->mUnionSize) std::swap(small, large);
  small->mUnionRootSkeleton = large;
  large->mUnionSize += small->mUnionSize;
}

}  // namespace plumb::dart6
