#include "replay/parting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "replay/fineness.hpp"

namespace plumb::harness {
namespace {

double distance_between(const PlumbVec3& a, const PlumbVec3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

/// How far apart the poses have a point at this radius, at most; infinite where one is not finite.
double separation(const PoseRow& a, const PoseRow& b, double radius) {
  const PlumbQuat &p = a.orientation, &q = b.orientation;
  // Half the angle's cosine; orientations of opposite sign are the same.
  const double cosine = std::min(1.0, std::abs(p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w));
  const double apart = distance_between(a.position, b.position) + 2 * radius * std::sqrt(1 - cosine * cosine);
  return std::isfinite(apart) ? apart : std::numeric_limits<double>::infinity();
}

/// How far a body ever is from where it began.
double way_of(const Trajectory& trajectory, std::size_t body) {
  double way = 0;
  for (const TrajectoryFrame& frame : trajectory.frames) {
    const double far = distance_between(frame.poses[body].position, trajectory.frames.front().poses[body].position);
    if (std::isfinite(far)) way = std::max(way, far);
  }
  return way;
}

/// How far a body must be off to be seen to be; by moving bodies.
std::vector<double> visible_distances(const Trajectory& a, const Trajectory& b, const std::vector<double>& radii) {
  std::vector<double> distances;
  for (std::size_t body = 0; body < radii.size(); ++body) {
    distances.push_back(radii[body] > 0 ? visible_part_of_body * radii[body]
                                        : visible_part_of_way * std::max(way_of(a, body), way_of(b, body)));
  }
  return distances;
}

std::string body_name(const Trajectory& trajectory, std::size_t moving) {
  const std::size_t body = trajectory.moving[moving];
  const Json& bodies = trajectory.header.at("bodies");
  const std::string name = body < bodies.size() ? bodies[body].value("name", "") : "";
  return name.empty() ? fmt::format("body {}", body) : name;
}

bool comparable(const Trajectory& a, const Trajectory& b) {
  const double dt = a.header.value("dt", 0.0);
  return dt > 0 && dt == b.header.value("dt", 0.0) && !a.moving.empty() && a.moving == b.moving &&
         a.header.contains("bodies");
}

}  // namespace

std::optional<Parting> parting_of(const Trajectory& a, const Trajectory& b) {
  if (!comparable(a, b)) return std::nullopt;
  const std::vector<double> radii = radii_of_moving(a), visible = visible_distances(a, b, radii);
  const double dt = a.header.at("dt");
  std::optional<Parting> farthest;
  double most = -1;  // of what is visible
  auto theirs = b.frames.begin();
  for (const TrajectoryFrame& frame : a.frames) {
    while (theirs != b.frames.end() && theirs->step < frame.step) ++theirs;
    if (theirs == b.frames.end()) break;
    if (theirs->step != frame.step) continue;
    for (std::size_t body = 0; body < radii.size(); ++body) {
      const double apart = separation(frame.poses[body], theirs->poses[body], radii[body]);
      const double share = apart == 0 ? 0 : apart / visible[body];
      if (share <= most) continue;
      most = share;
      farthest = Parting{dt * frame.step, apart, body_name(a, body), share > 1};
    }
    if (farthest && farthest->visible) break;
  }
  return farthest;
}

}  // namespace plumb::harness
