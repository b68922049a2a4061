#include "referee/hull.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "plumb/assert.hpp"
#include "plumb/physics_world.hpp"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace plumb::referee {

namespace {

/// Of the extent: what is thinner has no volume, and what lies so close to a plane is one face.
constexpr double flat = 1e-6;
constexpr const char* as_triangles = "qhull Qt Pp";
constexpr const char* as_faces = "qhull C1e-6 Pp";  // centrums are merged after the hull is made; of points of extent 1

using Loop = std::vector<std::uint32_t>;  ///< of places among the points

[[noreturn]] void refuse(const std::string& why) { throw Error(PLUMB_E_INVALID_ARGUMENT, "convex hull: " + why); }

/// What Qhull prints goes nowhere: its exit code says what matters.
class Silence {
 public:
  Silence() : file_(std::fopen("/dev/null", "w")) {
    if (file_ == nullptr) refuse("/dev/null cannot be opened");
  }
  ~Silence() { std::fclose(file_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  [[nodiscard]] std::FILE* file() const { return file_; }

 private:
  std::FILE* file_;
};

/// One run of Qhull.
class Run {
 public:
  Run(std::vector<double> coordinates, std::string options) : coordinates_(std::move(coordinates)) {
    qh_zero(&qhull_, silence_.file());
    succeeded_ = qh_new_qhull(&qhull_, 3, static_cast<int>(coordinates_.size() / 3), coordinates_.data(), False,
                              options.data(), nullptr, silence_.file()) == 0;
  }
  ~Run() {
    int blocks = 0, bytes = 0;
    qh_freeqhull(&qhull_, !qh_ALL);
    qh_memfreeshort(&qhull_, &blocks, &bytes);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  [[nodiscard]] bool succeeded() const { return succeeded_; }

  /// Counter-clockwise seen from outside; Qhull lists the corners of a facet the other way round.
  [[nodiscard]] std::vector<Loop> facets() {
    std::vector<Loop> loops;
    for (facetT* facet = qhull_.facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next) {
      setT* corners = qh_facet3vertex(&qhull_, facet);
      Loop& loop = loops.emplace_back();
      for (int i = qh_setsize(&qhull_, corners); i-- > 0;) {
        const auto* corner = static_cast<const vertexT*>(corners->e[i].p);
        loop.push_back(static_cast<std::uint32_t>(qh_pointid(&qhull_, corner->point)));
      }
      qh_settempfree(&qhull_, &corners);
    }
    return loops;
  }

 private:
  Silence silence_;
  std::vector<double> coordinates_;  // Qhull keeps pointing to them
  qhT qhull_{};
  bool succeeded_ = false;
};

double checked_extent(std::span<const Vec3> points) {
  if (points.size() < 4)
    refuse(std::to_string(points.size()) + " points; a hull needs at least 4 that are not in one plane");
  Vec3 low = points[0], high = points[0];
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) refuse("point " + std::to_string(i) + " is not finite");
    low = low.cwiseMin(points[i]);
    high = high.cwiseMax(points[i]);
  }
  const double extent = (high - low).maxCoeff();
  if (!(extent > 0) || !std::isfinite(extent)) refuse("all " + std::to_string(points.size()) + " points coincide");
  return extent;
}

/// Moved to the first point and scaled to an extent of 1, in which Qhull's tolerances are shares.
std::vector<double> scaled(std::span<const Vec3> points, double extent) {
  std::vector<double> coordinates;
  for (const Vec3& point : points) {
    const Vec3 moved = (point - points[0]) / extent;
    coordinates.insert(coordinates.end(), {moved.x(), moved.y(), moved.z()});
  }
  return coordinates;
}

/// Twice the area, along the normal of the plane that fits the loop best (Newell).
Vec3 area_vector(std::span<const Vec3> points, const Loop& loop) {
  Vec3 area = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    area += (points[loop[i]] - points[loop[0]]).cross(points[loop[i + 1]] - points[loop[0]]);
  return area;
}

/// Of a plate its thickness, of other bodies about a third of their width: twice the volume over the surface.
double thickness(std::span<const Vec3> points, const std::vector<Loop>& triangles) {
  double volume = 0, surface = 0;
  for (const Loop& triangle : triangles) {
    const Vec3 area = area_vector(points, triangle);
    surface += area.norm() / 2;
    volume += area.dot(points[triangle[0]] - points[0]) / 6;
  }
  return surface > 0 ? 2 * volume / surface : 0;
}

}  // namespace

Hull convex_hull(std::span<const Vec3> points) {
  const double extent = checked_extent(points);
  const std::vector<double> coordinates = scaled(points, extent);
  std::vector<Loop> triangles;
  if (Run run(coordinates, as_triangles); run.succeeded()) triangles = run.facets();
  if (!(thickness(points, triangles) > flat * extent))
    refuse("all " + std::to_string(points.size()) + " points lie in one plane; a hull needs volume");
  std::vector<Loop> faces = triangles;
  if (Run run(coordinates, as_faces); run.succeeded()) faces = run.facets();

  std::map<std::uint32_t, std::uint32_t> corner_of;  // by place among the points
  for (const std::vector<Loop>* loops : {&triangles, &faces}) {
    for (const Loop& loop : *loops) {
      for (const std::uint32_t point : loop) corner_of[point] = 0;
    }
  }
  PLUMB_ASSERT(triangles.size() >= 4 && faces.size() >= 4 && corner_of.rbegin()->first < points.size());
  Hull hull;
  for (auto& [point, corner] : corner_of) {
    corner = static_cast<std::uint32_t>(hull.corners.size());
    hull.corners.push_back(points[point]);
  }
  for (const Loop& t : triangles) hull.triangles.push_back({corner_of[t[0]], corner_of[t[1]], corner_of[t[2]]});
  for (const Loop& loop : faces) {
    PLUMB_ASSERT(loop.size() >= 3);
    Hull::Face face{{}, area_vector(points, loop).normalized()};
    for (const std::uint32_t point : loop) face.loop.push_back(corner_of[point]);
    hull.faces.push_back(std::move(face));
  }
  return hull;
}

}  // namespace plumb::referee
