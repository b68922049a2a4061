// A matrix of inertia as principal moments and axes.
#pragma once

#include <Eigen/Eigenvalues>

#include "referee/pose.hpp"

namespace plumb::harness {

struct PrincipalInertia {
  referee::Vec3 moments;
  referee::Mat3 axes;  ///< from the principal ones
};

/// A matrix that is diagonal keeps its axes.
[[nodiscard]] inline PrincipalInertia principal_of(const referee::Mat3& inertia) {
  const referee::Vec3 moments = inertia.diagonal();
  const referee::Mat3 aside = inertia - referee::Mat3(moments.asDiagonal());
  if (aside.cwiseAbs().maxCoeff() <= 1e-9 * moments.cwiseAbs().maxCoeff()) return {moments, referee::Mat3::Identity()};
  const Eigen::SelfAdjointEigenSolver<referee::Mat3> solver(inertia);
  referee::Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
  return {solver.eigenvalues(), axes};
}

}  // namespace plumb::harness
