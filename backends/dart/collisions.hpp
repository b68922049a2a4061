// Who overlaps whom, by DART's detector of ODE: the one of its four that has all of our shapes, in double precision and
// without memory of the step before.
#pragma once

#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionResult.hpp>
#include <functional>

#include "skeletons.hpp"

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
  /// Where the skeletons are now; valid until the next call. Normals go from the second to the first.
  [[nodiscard]] std::vector<::dart::collision::Contact*> find();
  /// All that a ray along the unit vector meets within the length; of one shape several places, in any order.
  [[nodiscard]] std::vector<RayMeeting> meet_ray(const Skeletons& skeletons, const PlumbVec3& from,
                                                 const PlumbVec3& along, double length);

 private:
  class Filter;
  class Group;

  std::shared_ptr<::dart::collision::CollisionDetector> detector_;
  std::unique_ptr<Group> group_;
  std::shared_ptr<Filter> filter_;
  ::dart::collision::CollisionResult result_;
};

}  // namespace plumb::dart6
