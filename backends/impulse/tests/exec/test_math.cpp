// The engine's own mathematics against the double one of the C library and of Eigen.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>

#include "contacts/prepare_contacts.hpp"
#include "math/angle.hpp"
#include "math/wide.hpp"

namespace plumb::impulse {
namespace {

constexpr double kUnit = kEpsilon;

// Components by index are the members that they name: what steps from one to another by pointer is no constant.
static_assert(Vec{1, 2, 3}[0] == 1 && Vec{1, 2, 3}[1] == 2 && Vec{1, 2, 3}[2] == 3);
static_assert(Mat{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}}[2][2] == 3);
constexpr Vec written(int i) {
  Vec v = {};
  v[i] = 7;
  return v;
}
static_assert(written(1) == Vec{0, 7, 0} && written(2) == Vec{0, 0, 7});

double real(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
Vec vec(std::mt19937_64& random, double size) {
  return {static_cast<Real>(real(random, -size, size)), static_cast<Real>(real(random, -size, size)),
          static_cast<Real>(real(random, -size, size))};
}
Eigen::Vector3d wide(const Vec& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
Eigen::Quaterniond wide(const Quat& q) {
  return {static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z)};
}
Eigen::Matrix3d wide(const Sym& s) {
  Eigen::Matrix3d m;
  m << static_cast<double>(s.xx), static_cast<double>(s.xy), static_cast<double>(s.xz), static_cast<double>(s.xy),
      static_cast<double>(s.yy), static_cast<double>(s.yz), static_cast<double>(s.xz), static_cast<double>(s.yz),
      static_cast<double>(s.zz);
  return m;
}
Quat unit(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return normalized(Quat{static_cast<Real>(normal(random)), static_cast<Real>(normal(random)),
                         static_cast<Real>(normal(random)), static_cast<Real>(normal(random))});
}

TEST(Math, SineAndCosineOfSmallAnglesAreTrueToRounding) {
  for (int i = -10000; i <= 10000; ++i) {
    const Real x = static_cast<Real>(i * 0.78539816 / 10000);
    const SinCos found = small_sin_cos(x);
    const double angle = static_cast<double>(x);
    EXPECT_NEAR(static_cast<double>(found.sine), std::sin(angle), 2 * kUnit * std::abs(std::sin(angle)));
    EXPECT_NEAR(static_cast<double>(found.cosine), std::cos(angle), 2 * kUnit);
  }
}

TEST(Math, SineAndCosineOfAnyAngle) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const Real x = static_cast<Real>(real(random, -30, 30));
    const SinCos found = sin_cos(x);
    const double angle = static_cast<double>(x);
    // Each doubling doubles the error of the sine.
    const double allowed = 8 * kUnit * std::max(1.0, std::abs(angle)) * std::max(1.0, std::abs(angle));
    EXPECT_NEAR(static_cast<double>(found.sine), std::sin(angle), allowed) << angle;
    EXPECT_NEAR(static_cast<double>(found.cosine), std::cos(angle), allowed) << angle;
  }
}

TEST(Math, TurnsByAVectorAreUnitAndTrue) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20000; ++i) {
    const Vec by = vec(random, i % 2 == 0 ? 3 : 1e-3);
    const Eigen::Vector3d axis = wide(by);
    const Eigen::Quaterniond expected(Eigen::AngleAxisd(axis.norm(), axis.normalized()));
    const Eigen::Quaterniond found = wide(turn_by(by));
    EXPECT_NEAR((found.coeffs() - expected.coeffs()).norm(), 0, 20 * kUnit);
  }
  const Quat none = turn_by({0, 0, 0});
  EXPECT_EQ(none.w, Real(1));
  EXPECT_EQ(none.x, Real(0));
}

TEST(Math, RotationsAgreeWithTheirMatrix) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 10000; ++i) {
    const Quat q = unit(random), p = unit(random);
    const Vec v = vec(random, 10);
    const double allowed = 20 * kUnit * wide(v).norm();
    EXPECT_NEAR((wide(rotate(q, v)) - wide(q) * wide(v)).norm(), 0, allowed);
    EXPECT_NEAR((wide(rotate_back(q, rotate(q, v))) - wide(v)).norm(), 0, allowed);
    EXPECT_NEAR((wide(to_matrix(q) * v) - wide(q) * wide(v)).norm(), 0, allowed);
    EXPECT_NEAR(((wide(q * p)).coeffs() - (wide(q) * wide(p)).coeffs()).norm(), 0, 10 * kUnit);
  }
}

/// A symmetric top in closed form: omega's part across the axis turns in the body at (I - I3) / I * omega3.
TEST(Math, AFreeRotorKeepsItsMomentumAndTheWayOfASymmetricTop) {
  const Vec inertia = {2, 2, 1};
  const double omega3 = 3, across = 1, h = 1.0 / 480;
  RotorState state = {{0, 0, 0, 1}, {static_cast<Real>(across), 0, static_cast<Real>(omega3)}};
  const Eigen::Vector3d momentum(2 * across, 0, omega3);
  constexpr int kSteps = 480;
  for (int i = 0; i < kSteps; ++i) state = step_free_rotor(state, inertia, static_cast<Real>(h));
  const Eigen::Vector3d in_body = wide(rotate_back(state.orientation, state.angular_velocity));
  const double rate = (1.0 - 2.0) / 2.0 * omega3, time = kSteps * h;
  const double rounding = 40 * kSteps * kUnit;
  EXPECT_NEAR(in_body.x(), across * std::cos(rate * time), 2e-5 + rounding);
  EXPECT_NEAR(in_body.y(), across * std::sin(rate * time), 2e-5 + rounding);
  EXPECT_NEAR(in_body.z(), omega3, 2e-5 + rounding);
  const Eigen::Vector3d after = wide(state.orientation) * in_body.cwiseProduct(wide(inertia));
  EXPECT_NEAR((after - momentum).norm(), 0, rounding * momentum.norm());
}

/// Euler's equations in principal axes, by Runge and Kutta's method in double.
Eigen::Vector3d tumbled(const Eigen::Vector3d& inertia, Eigen::Vector3d omega, double time) {
  const auto rate = [&](const Eigen::Vector3d& w) -> Eigen::Vector3d {
    return inertia.cwiseProduct(w).cross(w).cwiseQuotient(inertia);
  };
  constexpr int kSteps = 2000;
  const double h = time / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::Vector3d k1 = rate(omega), k2 = rate(omega + h / 2 * k1), k3 = rate(omega + h / 2 * k2),
                          k4 = rate(omega + h * k3);
    omega += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return omega;
}

TEST(Math, AFreeRotorsStepIsOfSecondOrder) {
  const Vec inertia = {1, 2, 3}, start = {1, 2, Real(0.5)};
  const Eigen::Vector3d exact = tumbled(wide(inertia), wide(start), 1);
  const auto error = [&](int steps) {
    RotorState state = {{0, 0, 0, 1}, start};
    for (int i = 0; i < steps; ++i) state = step_free_rotor(state, inertia, Real(1) / static_cast<Real>(steps));
    return (wide(rotate_back(state.orientation, state.angular_velocity)) - exact).norm();
  };
  EXPECT_NEAR(error(16) / error(32), 4, 0.2);
  EXPECT_LT(error(32), 2e-3);
}

/// However far it turns in a step and however thin it is; the closed form is the precession of the test above.
TEST(Math, ASymmetricTopsStepIsExact) {
  for (const Real thin : {Real(0.001), Real(0.5), Real(1.9)}) {
    for (int odd = 0; odd < 3; ++odd) {
      Vec inertia = {1, 1, 1};
      inertia[odd] = thin;
      RotorState state = {{0, 0, 0, 1}, {30, 20, 40}};
      const auto energy = [&] {
        const Vec w = rotate_back(state.orientation, state.angular_velocity);
        return dot(w, scale(inertia, w));
      };
      const Real before = energy(), spin = state.angular_velocity[odd];
      const Vec momentum = scale(inertia, state.angular_velocity);
      for (int i = 0; i < 60; ++i) state = step_free_rotor(state, inertia, Real(1) / 60);
      const Vec in_body = rotate_back(state.orientation, state.angular_velocity);
      EXPECT_NEAR(energy(), before, 4000 * kUnit * before) << thin;
      EXPECT_NEAR(in_body[odd], spin, 4000 * kUnit * spin / thin) << thin;
      EXPECT_LT(length(rotate(state.orientation, scale(inertia, in_body)) - momentum), 4000 * kUnit * length(momentum));
    }
  }
}

TEST(Math, TheOddAxisLeavesTwoThatHardlyDiffer) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 5000; ++i) {
    // Moments of any body: sums of two of three numbers.
    const double x = std::exp(real(random, -5, 5)), y = std::exp(real(random, -5, 5)),
                 z = std::exp(real(random, -5, 5));
    const Vec inertia = {static_cast<Real>(y + z), static_cast<Real>(x + z), static_cast<Real>(x + y)};
    const int odd = odd_axis(inertia);
    const Real a = inertia[(odd + 1) % 3], b = inertia[(odd + 2) % 3];
    EXPECT_LT(max(a, b) / min(a, b), Real(1.6181));
  }
  EXPECT_EQ(odd_axis({1, 2, 3}), 0);
  EXPECT_EQ(odd_axis({5, 6, 1}), 2);
  EXPECT_EQ(odd_axis({2, 3, 2}), 1);
}

TEST(Math, SymmetricMatricesAgreeWithEigen) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 5000; ++i) {
    const Quat q = unit(random);
    const Vec d = {static_cast<Real>(real(random, 0.1, 4)), static_cast<Real>(real(random, 0.1, 4)),
                   static_cast<Real>(real(random, 0.1, 4))};
    const Sym s = rotated_diagonal(to_matrix(q), d);
    const Eigen::Matrix3d r = wide(q).normalized().toRotationMatrix();
    EXPECT_NEAR((wide(s) - r * wide(d).asDiagonal() * r.transpose()).norm(), 0, 100 * kUnit);
    const Vec v = vec(random, 3);
    EXPECT_NEAR((wide(s * v) - wide(s) * wide(v)).norm(), 0, 100 * kUnit);
  }
}

TEST(Math, PositiveMatricesAreInverted) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 2000; ++i) {
    Eigen::Matrix4d factor;
    for (int k = 0; k < 16; ++k) factor(k / 4, k % 4) = real(random, -1, 1);
    const Eigen::Matrix4d matrix = factor * factor.transpose() + 0.3 * Eigen::Matrix4d::Identity();
    Real m[kManifoldPoints][kManifoldPoints];
    for (int k = 0; k < 16; ++k) m[k / 4][k % 4] = static_cast<Real>(matrix(k / 4, k % 4));
    invert(m);
    Eigen::Matrix4d inverse;
    for (int k = 0; k < 16; ++k) inverse(k / 4, k % 4) = static_cast<double>(m[k / 4][k % 4]);
    EXPECT_NEAR((inverse - matrix.inverse()).norm(), 0, 1000 * kUnit);
  }
}

TEST(Math, InfinityAndNanAreNotFinite) {
  const Real infinite = std::numeric_limits<Real>::infinity();
  EXPECT_FALSE(is_finite(infinite));
  EXPECT_FALSE(is_finite(-infinite));
  EXPECT_FALSE(is_finite(std::numeric_limits<Real>::quiet_NaN()));
  EXPECT_TRUE(is_finite(std::numeric_limits<Real>::max()));
  EXPECT_TRUE(is_finite(Real(0)));
}

/// Every operation on lanes, lane by lane the bits of the one on numbers.
TEST(Math, LanesHaveTheBitsOfNumbers) {
  std::mt19937_64 random(6);
  const Real odd[] = {0,
                      Real(-0.0),
                      1,
                      Real(1e-30),
                      Real(-3e30),
                      std::numeric_limits<Real>::infinity(),
                      std::numeric_limits<Real>::denorm_min(),
                      std::numeric_limits<Real>::quiet_NaN()};
  const auto number = [&] {
    return random() % 4 == 0 ? odd[random() % std::size(odd)] : static_cast<Real>(real(random, -9, 9));
  };
  const auto same = [](Real x, Real y) { return (x != x && y != y) || std::memcmp(&x, &y, sizeof x) == 0; };
  for (int round = 0; round < 20000; ++round) {
    Lanes a, b;
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      a.v[i] = number();
      b.v[i] = number();
    }
    const Lanes sum = a + b, difference = a - b, product = a * b, quotient = a / b, negative = -a, low = min(a, b),
                high = max(a, b), chosen = select(a < b, a, b), root = sqrt(a);
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      const Real x = a.v[i], y = b.v[i];
      EXPECT_TRUE(same(sum.v[i], x + y) && same(difference.v[i], x - y) && same(product.v[i], x * y) &&
                  same(quotient.v[i], x / y) && same(negative.v[i], -x) && same(low.v[i], min(x, y)) &&
                  same(high.v[i], max(x, y)) && same(chosen.v[i], select(x < y, x, y)) && same(root.v[i], sqrt(x)))
          << x << ' ' << y;
    }
  }
}

}  // namespace
}  // namespace plumb::impulse
