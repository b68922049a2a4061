// Who overlaps whom, by DART's detector of ODE: the one of its four that has all of our shapes, in double precision and
// without memory of the step before.
#pragma once

#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionResult.hpp>
#include <functional>

#include "skeletons.hpp"

namespace plumb::dart6 {

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

 private:
  class Filter;

  std::shared_ptr<::dart::collision::CollisionDetector> detector_;
  std::unique_ptr<::dart::collision::CollisionGroup> group_;
  std::shared_ptr<Filter> filter_;
  ::dart::collision::CollisionResult result_;
};

}  // namespace plumb::dart6
