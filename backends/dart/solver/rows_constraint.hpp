// Rows between two bodies, or a body and the world: joints that close a loop, rods, and locked axes. DART's own
// constraints of the kind are balls and welds.
#pragma once

#include <dart/constraint/ConstraintBase.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <limits>
#include <vector>

#include "dart_math.hpp"

namespace plumb::dart6 {

/// One scalar constraint: what a unit impulse along it is to either body, and which speed it is to bring about.
struct Row {
  Eigen::Vector3d force_b = Eigen::Vector3d::Zero(), at = Eigen::Vector3d::Zero();  ///< on b at a point; a the opposite
  Eigen::Vector3d torque_b = Eigen::Vector3d::Zero();                               ///< world axes
  double speed = 0;                                                                 ///< m/s or rad/s, of b seen from a
  double softness = 0;  ///< 1/kg or 1/(kg m2): by how much more than a hard one it yields to an impulse
  double least = -std::numeric_limits<double>::infinity(),
         most = std::numeric_limits<double>::infinity();  ///< N s, N m s
};

class RowsConstraint final : public ::dart::constraint::ConstraintBase {
 public:
  /// Null: the world.
  RowsConstraint(::dart::dynamics::BodyNode* a, ::dart::dynamics::BodyNode* b, std::vector<Row> rows);

  /// N s or N m s of each row, after the solution.
  [[nodiscard]] const std::vector<double>& impulses() const { return impulses_; }
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

  void update() override {}
  void getInformation(::dart::constraint::ConstraintInfo* info) override;
  void applyUnitImpulse(std::size_t index) override;
  void getVelocityChange(double* change, bool with_softness) override;
  void excite() override { set_excited(true); }
  void unexcite() override { set_excited(false); }
  void applyImpulse(double* impulses) override;
  [[nodiscard]] bool isActive() const override;
  [[nodiscard]] ::dart::dynamics::SkeletonPtr getRootSkeleton() const override;
  void uniteSkeletons() override;

 private:
  /// How much more than a hard row each yields: its own softness, and a little of what free bodies would yield, without
  /// which rows that hold what is held already could not be solved for.
  [[nodiscard]] double softness(std::size_t row) const;

  /// A body that impulses move, and what a unit of each row is to it, in its frame: moment, then force.
  struct End {
    ::dart::dynamics::BodyNode* node;
    std::vector<Eigen::Vector6d> wrenches;
    bool reactive;
  };
  [[nodiscard]] static End end_of(::dart::dynamics::BodyNode* node, const std::vector<Row>& rows, double sign);
  void set_excited(bool excited);

  std::vector<Row> rows_;
  std::vector<double> impulses_;
  std::vector<End> ends_;  ///< those that are not the world
  std::size_t applied_ = 0;
};

}  // namespace plumb::dart6
