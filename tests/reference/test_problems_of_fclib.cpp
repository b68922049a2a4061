// What FCLIB's own library writes, solved by `plumb solve` and by Siconos.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "agreement.hpp"
#include "fclib_library.hpp"
#include "problems.hpp"
#include "program.hpp"
#include "siconos_solver.hpp"

namespace plumb::reference::testing {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using harness::testing::Finished;
using harness::testing::fresh_folder;

/// Rows "impulse" of what `plumb solve` prints, one after the other.
VectorXd solved_by_plumb(const std::filesystem::path& file, Index contacts, int spacedim) {
  const Finished run = harness::testing::plumb({"solve", file.string(), "--json"});
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  const auto rows = run.rows().at(0).at("impulse");
  EXPECT_EQ(rows.size(), static_cast<std::size_t>(contacts));
  VectorXd impulse(spacedim * contacts);
  for (Index c = 0; c < contacts; ++c)
    for (int i = 0; i < spacedim; ++i)
      impulse[spacedim * c + i] = rows.at(static_cast<std::size_t>(c)).at(static_cast<std::size_t>(i)).get<double>();
  return impulse;
}

void expect_agreement(const ContactProblem& problem, const VectorXd& impulse) {
  EXPECT_LT(residual(problem, impulse).natural_map, 1e-10);
  const SecondOpinion theirs = solve_by_siconos(problem, Method::proximal_newton);
  ASSERT_TRUE(theirs.converged);
  EXPECT_LT(difference_of_velocities(problem, impulse, theirs.impulse), 1e-6);
}

TEST(ProblemsOfFclib, AreSolvedInEveryLayout) {
  const std::filesystem::path file = fresh_folder("layouts") / "problem.hdf5";
  std::mt19937 random(3);
  const ContactProblem problem = random_problem(random, 5, 12, 0.4).problem();
  for (const Layout layout : {Layout::triplets, Layout::columns, Layout::rows}) {
    write_by_fclib({3, problem.w, {}, {}, problem.q, problem.mu, {}, "twelve", "of five bodies", ""}, layout, file);
    expect_agreement(problem, solved_by_plumb(file, problem.contacts(), 3));
  }
}

/// A plane problem is one in space whose second tangents nothing pushes.
TEST(ProblemsOfFclib, MayBePlane) {
  const std::filesystem::path file = fresh_folder("plane") / "problem.hdf5";
  const MatrixXd plane =
      (MatrixXd(4, 4) << 2, 0.5, 0.8, 0, 0.5, 3, 0, -0.2, 0.8, 0, 2, 0.1, 0, -0.2, 0.1, 1).finished();
  const VectorXd q = Eigen::Vector4d(-1, 0.3, -0.5, 2), mu = Eigen::Vector2d(0.5, 0.2);
  write_by_fclib({2, plane, {}, {}, q, mu, {}, "plane", "", ""}, Layout::columns, file);
  const VectorXd impulse = solved_by_plumb(file, 2, 2);
  ContactProblem space{MatrixXd::Identity(6, 6), VectorXd::Zero(6), mu};
  VectorXd in_space = VectorXd::Zero(6);
  for (Index a = 0; a < 2; ++a) {
    for (Index b = 0; b < 2; ++b) space.w.block<2, 2>(3 * a, 3 * b) = plane.block<2, 2>(2 * a, 2 * b);
    space.q.segment<2>(3 * a) = q.segment<2>(2 * a);
    in_space.segment<2>(3 * a) = impulse.segment<2>(2 * a);
  }
  expect_agreement(space, in_space);
}

/// The velocity of b relative to a at a point, by the velocities of all bodies.
MatrixXd relative_velocity(const std::vector<referee::BodyState>& bodies, std::size_t a, std::size_t b,
                           const referee::Vec3& point) {
  MatrixXd rows = MatrixXd::Zero(3, 6 * static_cast<Index>(bodies.size()));
  for (const auto& [body, sign] : {std::pair{a, -1.0}, {b, 1.0}}) {
    const referee::Vec3 arm = point - bodies[body].centre();
    const auto column = 6 * static_cast<Index>(body);
    rows.block<3, 3>(0, column).diagonal().setConstant(sign);
    for (int axis = 0; axis < 3; ++axis)
      rows.block<3, 1>(0, column + 3 + axis) = sign * referee::Vec3::Unit(axis).cross(arm);
  }
  return rows;
}

/// Three cubes, on ball joints between their corners, swing from a nail; the last one's lower corner scrapes along the
/// ground. FCLIB takes the joints as equations V' r + R l + s = 0; for Siconos the velocities that the joints allow are
/// the unknowns, so that no step of the two ways is the same.
TEST(ProblemsOfFclib, MayHaveJointsAsAChainThatTouchesTheGround) {
  std::vector<referee::BodyState> bodies;
  const referee::Vec3 corner(0.5, -0.5, 0.5);
  for (int i = 0; i < 3; ++i) bodies.push_back(cube(i == 2 ? 20 : 2, (2.0 * i + 1) * corner));
  bodies.push_back({});  // the ground, and the nail in it
  const std::size_t ground = 3;

  const Index size = 6 * static_cast<Index>(bodies.size()), moving = size - 6;
  MatrixXd mass = MatrixXd::Identity(moving, moving);
  VectorXd free = VectorXd::Zero(moving);
  for (std::size_t i = 0; i < ground; ++i) {
    const auto at = 6 * static_cast<Index>(i);
    mass.block<3, 3>(at, at) *= bodies[i].mass.mass;
    mass.block<3, 3>(at + 3, at + 3) = bodies[i].inertia();
    free.segment<6>(at) << -1.5, -0.4, -0.5, 0.3, -0.2, 0.1;
    free[at + 1] -= gravity * step_seconds;
  }
  MatrixXd joints(9, moving);
  for (std::size_t i = 0; i < 3; ++i)
    joints.middleRows<3>(3 * static_cast<Index>(i)) =
        relative_velocity(bodies, i == 0 ? ground : i - 1, i, 2.0 * static_cast<double>(i) * corner).leftCols(moving);
  Eigen::Matrix3d frame;  // normal first
  frame << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  const MatrixXd contact = frame * relative_velocity(bodies, ground, 2, 6 * corner).leftCols(moving);
  const VectorXd mu = VectorXd::Constant(1, 0.3);

  const MatrixXd mobility = mass.inverse();
  const std::filesystem::path file = fresh_folder("chain") / "problem.hdf5";
  const LocalProblem mixed{3,
                           contact * mobility * contact.transpose(),
                           contact * mobility * joints.transpose(),
                           joints * mobility * joints.transpose(),
                           contact * free,
                           mu,
                           joints * free,
                           "chain",
                           "",
                           ""};
  write_by_fclib(mixed, Layout::columns, file);
  const VectorXd impulse = solved_by_plumb(file, 1, 3);
  EXPECT_GT(impulse[0], 0.1);

  const MatrixXd allowed = joints.fullPivLu().kernel();
  ASSERT_EQ(allowed.cols(), 9);
  const MatrixXd inner = (allowed.transpose() * mass * allowed).inverse(), at_contact = contact * allowed;
  const MatrixXd w = at_contact * inner * at_contact.transpose();
  const VectorXd q = at_contact * (inner * (allowed.transpose() * (mass * free)));
  expect_agreement({(w + w.transpose()) / 2, q, mu}, impulse);
}

}  // namespace
}  // namespace plumb::reference::testing
