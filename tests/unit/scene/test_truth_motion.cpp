// Truths of free motion against digits that were worked out by other means (30-digit quadrature and integration).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../truth_units.hpp"
#include "truth/elliptic.hpp"
#include "truth/ode.hpp"
#include "truth/pendulums.hpp"
#include "truth/rotation.hpp"

namespace plumb::truth {
namespace {

TEST(Elliptic, JacobiFunctionsKeepTheirIdentitiesAndQuarterPeriod) {
  for (const double m : {0.0, 0.1, 0.5, 0.9, 0.98741319, 0.999999}) {
    const double quarter = complete_elliptic(m);
    EXPECT_NEAR(jacobi(quarter, m).sn, 1, 1e-12) << m;
    EXPECT_NEAR(jacobi(quarter, m).cn, 0, 1e-7) << m;
    EXPECT_NEAR(jacobi(quarter, m).dn, std::sqrt(1 - m), 1e-7) << m;
    for (double u = -3; u < 12; u += 0.37) {
      const auto [sn, cn, dn] = jacobi(u, m);
      EXPECT_NEAR(sn * sn + cn * cn, 1, 1e-12);
      EXPECT_NEAR(dn * dn + m * sn * sn, 1, 1e-11) << m << " " << u;
      EXPECT_GT(dn, 0);
      EXPECT_NEAR(jacobi(u + 2 * quarter, m).sn, -sn, 1e-8) << m << " " << u;
    }
  }
}

TEST(Ode, SolvesAnOscillatorToTwelveDigits) {
  const Derivative f = [](double, const Eigen::VectorXd& y) -> Eigen::VectorXd { return Eigen::Vector2d(y[1], -y[0]); };
  const Eigen::VectorXd y = integrate(f, Eigen::Vector2d(1, 0), 0, 20);
  EXPECT_NEAR(y[0], std::cos(20.0), 1e-12);
  EXPECT_NEAR(y[1], -std::sin(20.0), 1e-12);
}

TEST(Ode, KeepsTimeOfEquationsThatDependOnIt) {
  const Derivative f = [](double t, const Eigen::VectorXd& y) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, 2 * t * y[0]);
  };
  EXPECT_NEAR(integrate(f, Eigen::VectorXd::Constant(1, 1), 0.5, 1.25)[0], std::exp(1.25 * 1.25 - 0.25), 1e-11);
}

TEST(FreeRotation, BoxOnItsMiddleAxis) {
  const Eigen::Vector3d inertia = box_inertia(100, {0.5, 0.25, 0.1});
  EXPECT_NEAR(inertia.x(), 2.41666667, digits);
  EXPECT_NEAR(inertia.y(), 8.66666667, digits);
  EXPECT_NEAR(inertia.z(), 10.41666667, digits);
  const FreeRotation motion(inertia, {0.5, 5, 0});
  EXPECT_NEAR(motion.energy(), 108.63541667, digits);
  EXPECT_NEAR(motion.momentum(), 43.35017701, digits);
  EXPECT_NEAR(motion.modulus(), 0.98741319, digits);
  EXPECT_NEAR(motion.first_flip(), 1.07998780, digits);
  EXPECT_NEAR(motion.flip_interval(), 2.15997560, digits);
  EXPECT_EQ(motion.flips(60), 28);
  EXPECT_NEAR((motion.angular_velocity(0) - Eigen::Vector3d(0.5, 5, 0)).norm(), 0, 1e-7);
  EXPECT_NEAR((motion.angular_velocity(1) - Eigen::Vector3d(4.30623183, 1.29639662, -3.89327385)).norm(), 0, 2e-8);
  EXPECT_NEAR((motion.angular_velocity(10) - Eigen::Vector3d(3.06265904, -3.65539474, -2.75041052)).norm(), 0, 2e-8);
  const Eigen::Quaterniond expected(-0.64396075, -0.37688240, 0.47780877, -0.46365179);
  EXPECT_NEAR(std::abs(motion.orientation(1).dot(expected)), 1, 1e-8);
}

TEST(FreeRotation, BoxNearlyOnItsMiddleAxis) {
  const FreeRotation motion(box_inertia(100, {0.5, 0.25, 0.1}), {0.01, 5, 0.01});
  EXPECT_NEAR(motion.energy(), 108.33397500, digits);
  EXPECT_NEAR(motion.momentum(), 43.33346527, digits);
  EXPECT_NEAR(motion.flip_interval(), 5.01691357, digits);
  EXPECT_NEAR(motion.first_flip(), 2.97239462, digits);
  EXPECT_EQ(motion.flips(60), 12);
  EXPECT_NEAR((motion.angular_velocity(1) - Eigen::Vector3d(-.01291991, 4.99999147, .01246801)).norm(), 0, 2e-8);
}

TEST(FreeRotation, FromAnywhereSolvesEulersEquations) {
  const Eigen::Vector3d inertia(1, 2, 3.5);
  const Derivative euler = [&](double, const Eigen::VectorXd& y) -> Eigen::VectorXd {
    const Eigen::Vector3d w = y;
    return (inertia.cwiseProduct(w)).cross(w).cwiseQuotient(inertia);
  };
  for (const Eigen::Vector3d& start : {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(-3, 1, 0.5),
                                       Eigen::Vector3d(0.2, -2, -1), Eigen::Vector3d(2, 3, -0.1)}) {
    const FreeRotation motion(inertia, start);
    EXPECT_NEAR((motion.angular_velocity(0) - start).norm(), 0, 1e-9);
    const Eigen::Vector3d later = integrate(euler, start, 0, 5);
    EXPECT_NEAR((motion.angular_velocity(5) - later).norm(), 0, 1e-8);
    EXPECT_NEAR(motion.angular_velocity(motion.first_flip()).y(), 0, 1e-8);
    EXPECT_NE(motion.angular_velocity(motion.first_flip() - 1e-3).y() > 0,
              motion.angular_velocity(motion.first_flip() + 1e-3).y() > 0);
  }
}

TEST(HeavyTop, SteadyPrecessionAndNutation) {
  const HeavyTop top{1.0 + 1.0 / 4 * 0.25 + 0.01 / 12, 0.125, 9.81, 50};
  EXPECT_NEAR(top.across, 1.06333333, digits);
  EXPECT_NEAR(top.slow_precession(60 * degree), 1.86570463, digits);
  const auto [lowest, period, azimuth] = top.nutation(60 * degree);
  EXPECT_NEAR(lowest / degree, 91.91883718, 1e-8);
  EXPECT_NEAR(period, 1.13648818, digits);
  EXPECT_NEAR(azimuth / degree, 101.27208780, 1e-8);
  EXPECT_NEAR(azimuth / period, 1.55525715, digits);
}

TEST(Pendulum, PeriodsAndAngles) {
  EXPECT_NEAR(pendulum_period(9.81, 1, 10 * degree), 2.00989263, digits);
  EXPECT_NEAR(pendulum_period(9.81, 1, 90 * degree), 2.36784195, digits);
  EXPECT_NEAR(pendulum_period(9.81, 1, 170 * degree), 4.89352427, digits);
  EXPECT_NEAR(pendulum_period(9.81, 1 + 0.4 * 0.05 * 0.05, 90 * degree), 2.36902557, digits);
  EXPECT_NEAR(pendulum_period(9.81, 2.0 / 3, 90 * degree), 1.93333485, digits);
  EXPECT_NEAR(pendulum_angle(9.81, 1, 90 * degree, 1), -1.40502731, digits);
  EXPECT_NEAR(pendulum_angle(9.81, 1, 90 * degree, 10), 0.27868067, digits);
}

TEST(Pendulum, SemiImplicitEulerConvergesToTheMotionAndIsOffByItsOrder) {
  const auto error = [](std::uint64_t steps) {
    const PendulumState end = semi_implicit_pendulum(9.81, 1, {std::numbers::pi / 2, 0}, 1.0 / double(steps), steps);
    return end.angle - pendulum_angle(9.81, 1, std::numbers::pi / 2, 1);
  };
  EXPECT_LT(std::abs(error(1000000)), 1e-5);
  EXPECT_NEAR(error(1000) / error(2000), 2, 0.01);
}

TEST(SphericalPendulum, RangeAzimuthAndPosition) {
  const SphericalPendulum pendulum{9.81, 1, 60 * degree, 2};
  const auto [other, period, azimuth] = pendulum.cycle();
  EXPECT_NEAR(other / degree, 27.42712724, 1e-8);
  EXPECT_NEAR(period, 1.07966916, digits);
  EXPECT_NEAR(azimuth / degree, 219.50943555, 1e-8);
  const Eigen::Vector3d x = pendulum.position(10);
  EXPECT_NEAR(x.x(), -0.60550320, digits);
  EXPECT_NEAR(x.y(), -0.69768019, digits);
  EXPECT_NEAR(std::abs(x.z()), 0.38289454, digits);
}

TEST(DoublePendulum, AnglesAndRates) {
  const Eigen::Vector4d wide = double_pendulum(9.81, 1, 90 * degree, 90 * degree, 1);
  EXPECT_NEAR(wide[0], -0.62508770, digits);
  EXPECT_NEAR(wide[1], -1.03458509, digits);
  EXPECT_NEAR(wide[2], -3.92227957, digits);
  EXPECT_NEAR(wide[3], -1.30309925, digits);
  EXPECT_NEAR(double_pendulum(9.81, 1, 90 * degree, 90 * degree, 2)[1], -1.32404871, digits);
  const Eigen::Vector4d narrow = double_pendulum(9.81, 1, 30 * degree, 30 * degree, 5);
  EXPECT_NEAR(narrow[0], 0.26939296, digits);
  EXPECT_NEAR(narrow[1], 0.52499884, digits);
}

}  // namespace
}  // namespace plumb::truth
