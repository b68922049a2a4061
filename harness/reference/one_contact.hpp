// The frictional contact problem of one contact, solved exactly. Inner part of the solver.
#pragma once

#include <Eigen/Core>

namespace plumb::reference {

/// The impulse r with which u = W r + q obeys Signorini and Coulomb: it parts, sticks, or slides; sliding is a root of
/// a trigonometric polynomial of degree 2 in the direction (Bonnefon & Daviet 2011, "Quartic formulation of Coulomb 3D
/// frictional contact"). w must be positive definite. Where friction is so high that several answers exist, the one
/// nearest to `before`; where none is found, the nearest impulse in the cone to before - u^.
[[nodiscard]] Eigen::Vector3d solve_one_contact(const Eigen::Matrix3d& w, const Eigen::Vector3d& q, double mu,
                                                const Eigen::Vector3d& before);

}  // namespace plumb::reference
