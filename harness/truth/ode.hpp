// Reference solutions of ordinary differential equations, for truths without a closed form.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace plumb::truth {

using Derivative = std::function<Eigen::VectorXd(double t, const Eigen::VectorXd& y)>;

/// y at `end` from y at `begin` <= end, of y' = f(t, y), converged to about 1e-12 of |y| for smooth problems. The
/// modified midpoint rule with 2, 4, ... 16 steps a stride, extrapolated to none (Hairer, Norsett, Wanner, Solving ODEs
/// I, II.9). stride: s, short against the fastest motion.
[[nodiscard]] Eigen::VectorXd integrate(const Derivative& f, Eigen::VectorXd y, double begin, double end,
                                        double stride = 0.01);

}  // namespace plumb::truth
