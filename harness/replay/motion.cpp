#include "replay/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "replay/bytes.hpp"
#include "replay/planes.hpp"

namespace plumb::harness {

namespace {

constexpr double largest_steps = 1 << 28;  // predictions of twice and thrice as much still fit
constexpr std::int32_t unit = 8192;        // steps of a component
constexpr double large_enough = 0.45;      // of a component that was left out before and stays so

using Numbers = std::vector<std::int32_t>;

double coordinate(const PoseRow& row, std::size_t axis) {
  return std::array{row.position.x, row.position.y, row.position.z}[axis];
}

int cost(const Numbers& residuals) {
  int bits = 0;
  for (const std::int32_t residual : residuals) bits += bits_of(residual);
  return bits;
}

std::int32_t predicted(const Numbers& numbers, std::size_t frame, int order) {
  if (frame == 0) return 0;
  if (frame == 1 || order == 1) return numbers[frame - 1];
  return 2 * numbers[frame - 1] - numbers[frame - 2];
}

/// A prediction that is within a step of the truth stands: what rests does not flicker between two numbers.
Numbers residuals_of(const std::vector<double>& steps, int order) {
  Numbers numbers, residuals;
  for (std::size_t f = 0; f < steps.size(); ++f) {
    const std::int32_t guess = predicted(numbers, f, order);
    const bool stands = std::abs(steps[f] - guess) <= 1;
    numbers.push_back(stands ? guess : static_cast<std::int32_t>(std::round(steps[f])));
    residuals.push_back(numbers.back() - guess);
  }
  return residuals;
}

struct Quaternion {
  std::array<std::int32_t, 4> at{0, 0, 0, unit};

  [[nodiscard]] std::int32_t dot(const Quaternion& other) const {
    std::int32_t sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += at[i] * other.at[i];
    return sum;
  }
  void flip() {
    for (std::int32_t& part : at) part = -part;
  }
};

/// Follows one body's orientation; the viewer (harness/viewer/src/data/motion.js) does the same in whole numbers.
class Turning {
 public:
  explicit Turning(int order) : order_(order) {}

  /// Residuals of the three components that are kept, and which is left out.
  std::array<std::int32_t, 3> add(const PlumbQuat& orientation, std::uint8_t& left_out) {
    std::array<double, 4> q{orientation.x, orientation.y, orientation.z, orientation.w};
    const double norm = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!(norm > 0) || !std::isfinite(norm))
      q = {0, 0, 0, 1};
    else
      for (double& part : q) part /= norm;
    left_out = choose(q);
    if (q[left_out] < 0)
      for (double& part : q) part = -part;
    Quaternion guess = prediction();
    if (guess.at[left_out] < 0) guess.flip();
    bool stands = true;
    for (std::size_t i = 0; i < 4; ++i) stands = stands && (i == left_out || std::abs(q[i] * unit - guess.at[i]) <= 1);
    std::array<std::int32_t, 3> residuals{};
    Quaternion now;
    std::int32_t rest = unit * unit;
    for (std::size_t i = 0, k = 0; i < 4; ++i) {
      if (i == left_out) continue;
      now.at[i] = stands ? guess.at[i] : static_cast<std::int32_t>(std::round(q[i] * unit));
      residuals[k++] = now.at[i] - guess.at[i];
      rest -= now.at[i] * now.at[i];
    }
    now.at[left_out] = static_cast<std::int32_t>(std::floor(std::sqrt(std::max(rest, 0)) + 0.5));
    if (now.dot(last_) < 0) now.flip();
    before_ = last_;
    last_ = now;
    ++frames_;
    return residuals;
  }

 private:
  std::uint8_t choose(const std::array<double, 4>& q) {
    if (frames_ > 0 && std::abs(q[chosen_]) >= large_enough) return chosen_;
    const auto less = [](double a, double b) { return std::abs(a) < std::abs(b); };
    return chosen_ = static_cast<std::uint8_t>(std::max_element(q.begin(), q.end(), less) - q.begin());
  }
  [[nodiscard]] Quaternion prediction() const {
    if (frames_ < 2 || order_ == 1) return last_;
    Quaternion guess;
    for (std::size_t i = 0; i < 4; ++i) guess.at[i] = 2 * last_.at[i] - before_.at[i];
    return guess;
  }

  int order_;
  Quaternion last_, before_;
  std::uint8_t chosen_ = 0;
  std::size_t frames_ = 0;
};

struct Turns {
  std::string left_out;
  Numbers residuals;
};

Turns turns_of(const std::vector<std::vector<PoseRow>>& poses, std::size_t body, int order) {
  Turns turns;
  Turning turning(order);
  std::uint8_t before = 0;
  for (const std::vector<PoseRow>& frame : poses) {
    std::uint8_t left_out = 0;
    for (const std::int32_t residual : turning.add(frame[body].orientation, left_out))
      turns.residuals.push_back(residual);
    turns.left_out += static_cast<char>(left_out ^ before);
    before = left_out;
  }
  return turns;
}

std::size_t bodies_of(const std::vector<std::vector<PoseRow>>& poses) { return poses.empty() ? 0 : poses[0].size(); }

}  // namespace

BundleSection coded_positions(const std::vector<std::vector<PoseRow>>& poses, double step) {
  const std::size_t bodies = bodies_of(poses);
  std::vector<std::size_t> raw;
  std::string orders;
  std::array<Numbers, 3> residuals;
  for (std::size_t body = 0; body < bodies; ++body) {
    std::array<std::array<Numbers, 3>, 2> tried;
    bool fits = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double> steps;
      for (const std::vector<PoseRow>& frame : poses) steps.push_back(coordinate(frame[body], axis) / step);
      fits = fits && std::all_of(steps.begin(), steps.end(), [](double at) { return std::abs(at) < largest_steps; });
      if (!fits) break;
      for (const int order : {1, 2}) tried[static_cast<std::size_t>(order - 1)][axis] = residuals_of(steps, order);
    }
    if (!fits) {
      raw.push_back(body);
      orders += '\1';
      continue;
    }
    const auto sum = [](const std::array<Numbers, 3>& axes) { return cost(axes[0]) + cost(axes[1]) + cost(axes[2]); };
    const std::size_t better = sum(tried[1]) < sum(tried[0]) ? 1 : 0;
    orders += static_cast<char>(better + 1);
    for (std::size_t axis = 0; axis < 3; ++axis)
      residuals[axis].insert(residuals[axis].end(), tried[better][axis].begin(), tried[better][axis].end());
  }
  Numbers all;
  for (const Numbers& axis : residuals) all.insert(all.end(), axis.begin(), axis.end());
  const Planes planes = planes_of(all);
  std::string rest;
  for (const std::vector<PoseRow>& frame : poses)
    for (const std::size_t body : raw)
      for (std::size_t axis = 0; axis < 3; ++axis) put(rest, static_cast<float>(coordinate(frame[body], axis)));
  return {"f32",
          {poses.size(), bodies, 3},
          orders + planes.bytes + rest,
          {{"kind", "motion"}, {"step", step}, {"planes", planes.count}, {"raw", raw}}};
}

BundleSection coded_orientations(const std::vector<std::vector<PoseRow>>& poses) {
  const std::size_t bodies = bodies_of(poses);
  std::string orders, left_out;
  Numbers all;
  for (std::size_t body = 0; body < bodies; ++body) {
    const Turns first = turns_of(poses, body, 1), second = turns_of(poses, body, 2);
    const bool is_second = cost(second.residuals) < cost(first.residuals);
    const Turns& better = is_second ? second : first;
    orders += is_second ? '\2' : '\1';
    left_out += better.left_out;
    for (std::size_t part = 0; part < 3; ++part)
      for (std::size_t f = 0; f < poses.size(); ++f) all.push_back(better.residuals[3 * f + part]);
  }
  const Planes planes = planes_of(all);
  return {"i16",
          {poses.size(), bodies, 4},
          orders + left_out + planes.bytes,
          {{"kind", "turns"}, {"planes", planes.count}}};
}

}  // namespace plumb::harness
