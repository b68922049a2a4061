#include "reference/step_problem.hpp"

#include <Eigen/LU>
#include <utility>

namespace plumb::reference {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::VectorXd;
using referee::BodyState;
using referee::Vec3;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

Matrix3d cross_matrix(const Vec3& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Matrix6 mobility_of(const BodyState& body) {
  Matrix6 mobility = Matrix6::Zero();
  if (body.mass.mass <= 0) return mobility;
  mobility.topLeftCorner<3, 3>() = Matrix3d::Identity() / body.mass.mass;
  const Matrix3d inertia = body.inertia();
  if (inertia.determinant() > 0) mobility.bottomRightCorner<3, 3>() = inertia.inverse();
  return mobility;
}

Index column(std::size_t body) { return 6 * static_cast<Index>(body); }

}  // namespace

StepProblem::StepProblem(std::span<const BodyState> before, std::vector<StepContact> contacts, const StepForces& forces)
    : contacts_(std::move(contacts)) {
  const auto rows = 3 * static_cast<Index>(contacts_.size());
  free_.resize(column(before.size()));
  for (std::size_t i = 0; i < before.size(); ++i) {
    const BodyState& body = before[i];
    mobility_.push_back(mobility_of(body));
    const bool moves = body.mass.mass > 0;
    free_.segment<3>(column(i)) = body.linear + (moves ? forces.dt : 0) * forces.gravity;
    free_.segment<3>(column(i) + 3) = body.angular;
    if (moves && forces.gyroscopic)
      free_.segment<3>(column(i) + 3) -=
          forces.dt * mobility_[i].bottomRightCorner<3, 3>() * body.angular.cross(body.spin());
  }
  h_.setZero(rows, free_.size());
  problem_.mu.resize(rows / 3);
  VectorXd bias = VectorXd::Zero(rows);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const StepContact& contact = contacts_[c];
    const auto row = 3 * static_cast<Index>(c);
    const Vec3 tangent = contact.normal.unitOrthogonal();
    Matrix3d frame;
    frame << contact.normal.transpose(), tangent.transpose(), contact.normal.cross(tangent).transpose();
    frames_.push_back(frame);
    for (const auto& [body, sign] : {std::pair{contact.body_a, -1.0}, {contact.body_b, 1.0}}) {
      h_.block<3, 3>(row, column(body)) += sign * frame;
      h_.block<3, 3>(row, column(body) + 3) -= sign * frame * cross_matrix(contact.point - before[body].centre());
    }
    problem_.mu[row / 3] = contact.friction;
    bias[row] = contact.bias;
  }
  Eigen::MatrixXd h_mobility(rows, free_.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    h_mobility.middleCols<6>(column(i)) = h_.middleCols<6>(column(i)) * mobility_[i];
  problem_.w = h_mobility * h_.transpose();
  problem_.w = (problem_.w + problem_.w.transpose()).eval() / 2;
  problem_.q = h_ * free_ + bias;
}

VectorXd StepProblem::impulse_on_bodies(const VectorXd& impulse) const { return h_.transpose() * impulse; }

VectorXd StepProblem::velocity_of(const VectorXd& on_bodies) const {
  VectorXd velocity(on_bodies.size());
  for (std::size_t i = 0; i < mobility_.size(); ++i)
    velocity.segment<6>(column(i)) = mobility_[i] * on_bodies.segment<6>(column(i));
  return velocity;
}

VectorXd StepProblem::velocity_after(const VectorXd& impulse) const {
  return free_ + velocity_of(impulse_on_bodies(impulse));
}

}  // namespace plumb::reference
