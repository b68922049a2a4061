// Who overlaps whom, by the shapes of DART's detector of ODE: the one of its four that has all of ours, in double
// precision. The pairs are asked of its space here: asked by the detector, a pair of less than three points gets points
// of earlier steps as well, where they were then, out of one list of all worlds of the process, which two threads
// break.
#pragma once

#include <dart/collision/CollisionDetector.hpp>
#include <dart/collision/Contact.hpp>
#include <deque>
#include <functional>

#include "skeletons.hpp"

struct dxGeom;  // ODE's

namespace plumb::dart6 {

/// Where a ray comes upon a surface.
struct RayMeeting {
  const Geom* geom;
  double way;               ///< m from where it starts
  PlumbVec3 point, normal;  ///< world; the normal looks at the ray
  std::uint32_t triangle;   ///< of a mesh
};

class Collisions {
 public:
  /// Whether two geoms are looked at.
  using May = std::function<bool(const Geom& a, const Geom& b)>;

  Collisions();
  ~Collisions();
  Collisions(const Collisions&) = delete;
  Collisions& operator=(const Collisions&) = delete;

  /// Before skeletons are taken down.
  void forget();
  void take(const Skeletons& skeletons, May may);
  /// Where the skeletons are now, pair by pair; valid until the next call. Normals go from the second to the first.
  [[nodiscard]] std::vector<::dart::collision::Contact*> find();
  /// All that a ray along the unit vector meets within the length; of one shape several places, in any order.
  [[nodiscard]] std::vector<RayMeeting> meet_ray(const Skeletons& skeletons, const PlumbVec3& from,
                                                 const PlumbVec3& along, double length);

 private:
  class Group;

  void meet(dxGeom* one, dxGeom* two);

  std::shared_ptr<::dart::collision::CollisionDetector> detector_;
  std::unique_ptr<Group> group_;
  const Skeletons* skeletons_ = nullptr;
  May may_;
  std::deque<::dart::collision::Contact> found_;  ///< stay where they are while more are found
};

}  // namespace plumb::dart6
