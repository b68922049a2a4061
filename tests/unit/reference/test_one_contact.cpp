// One contact: closed forms, and the proof of random answers.
#include <gtest/gtest.h>

#include <random>

#include "reference/contact_problem.hpp"
#include "reference/one_contact.hpp"

namespace plumb::reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d answer(const Matrix3d& w, const Vector3d& q, double mu) {
  return solve_one_contact(w, q, mu, Vector3d::Zero());
}

TEST(OneContact, AParticlePartsSticksAndSlides) {
  const Matrix3d w = Matrix3d::Identity() / 2;  // 2 kg
  EXPECT_EQ(answer(w, {1, 3, 0}, 0.5), Vector3d::Zero());
  EXPECT_LT((answer(w, {-2, 0.6, 0.8}, 0.5) - Vector3d(4, -1.2, -1.6)).norm(), 1e-14);
  EXPECT_LT((answer(w, {-2, 6, 8}, 0.5) - Vector3d(4, -1.2, -1.6)).norm(), 1e-14);
  EXPECT_LT((answer(w, {-2, 6, 8}, 0) - Vector3d(4, 0, 0)).norm(), 1e-14);
}

/// A slender rod in a plane touches ground with its leading tip at the angle 60 degrees: where it slides away from its
/// centre, W_nt adds to the normal mobility, and the answer is q_n / (W_nn - mu W_nt).
TEST(OneContact, ASlidingRod) {
  const double angle = std::acos(0.5), c = 0.5, s = std::sin(angle), mu = 0.3;
  Matrix3d w = Matrix3d::Zero();
  w.topLeftCorner<2, 2>() << 1 + 3 * c * c, -3 * s * c, -3 * s * c, 1 + 3 * s * s;
  w(2, 2) = 1;
  const double normal = 2 / (w(0, 0) - mu * w(0, 1));
  EXPECT_LT((answer(w, {-2, 10, 0}, mu) - Vector3d(normal, -mu * normal, 0)).norm(), 1e-13);
  const double other = 2 / (w(0, 0) + mu * w(0, 1));
  EXPECT_LT((answer(w, {-2, -10, 0}, mu) - Vector3d(other, mu * other, 0)).norm(), 1e-13);
}

TEST(OneContact, RandomAnswersProveThemselves) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto number = [&] { return unit(random); };
  int slid = 0;
  for (int i = 0; i < 20000; ++i) {
    const Matrix3d root = Matrix3d::NullaryExpr(number);
    ContactProblem problem;
    problem.w = root * root.transpose() + 0.05 * Matrix3d::Identity();
    problem.q = Vector3d::NullaryExpr(number);
    problem.mu = Eigen::VectorXd::Constant(1, std::abs(number()));
    const Vector3d impulse = answer(problem.w, problem.q, problem.mu[0]);
    const Residual proof = residual(problem, impulse);
    ASSERT_LT(proof.natural_map, 1e-11) << i << " w " << problem.w << " q " << problem.q << " mu " << problem.mu;
    if (problem.velocity(impulse).tail<2>().norm() > 1e-6 && impulse[0] > 0) ++slid;
  }
  EXPECT_GT(slid, 5000);
}

}  // namespace
}  // namespace plumb::reference
